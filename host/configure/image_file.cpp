#include "host/configure/image_file.hpp"

#include <algorithm>

#include "host/configure/dfu_file.hpp"
#include "host/configure/hex_file.hpp"
#include "host/configure/uf2_file.hpp"

namespace fencepost::host {

bool ImageMemory::put(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return true;
  const bool first = bytes_.empty();
  const std::uint64_t low = first ? address : std::min(begin_, address);
  const std::uint64_t high = std::max(first ? 0 : end(), address + std::uint64_t{bytes.size()});
  if (high - low > kMax) return false;
  if (low < begin_ && !first) grow_in_front(static_cast<std::size_t>(begin_ - low));
  begin_ = static_cast<std::uint32_t>(low);
  bytes_.resize(std::max(bytes_.size(), front_ + static_cast<std::size_t>(high - low)), 0xFF);
  known_.resize(bytes_.size(), false);
  const auto at = static_cast<std::ptrdiff_t>(front_ + static_cast<std::size_t>(address - low));
  std::copy(bytes.begin(), bytes.end(), bytes_.begin() + at);
  std::fill_n(known_.begin() + at, bytes.size(), true);
  return true;
}

// Room for as many again, so that a file whose addresses fall costs no more than one whose addresses rise.
void ImageMemory::grow_in_front(std::size_t count) {
  if (count > front_) {
    const std::size_t more = std::max(count - front_, bytes_.size());
    bytes_.insert(bytes_.begin(), more, 0xFF);
    known_.insert(known_.begin(), more, false);
    front_ += more;
  }
  front_ -= count;
}

std::optional<ImageFormat> image_format(std::string_view name) {
  if (name.ends_with(".bin") || name.ends_with(".gba")) return ImageFormat::kBin;
  if (name.ends_with(".hex")) return ImageFormat::kHex;
  if (name.ends_with(".uf2")) return ImageFormat::kUf2;
  if (name.ends_with(".dfu")) return ImageFormat::kDfu;
  if (name.ends_with(".sav")) return ImageFormat::kSave;
  return std::nullopt;
}

base::Result<ImageMemory, std::string> read_image(std::string_view file) {
  if (file.empty()) return std::string("the file is empty");
  if (file.starts_with("\x7f"
                       "ELF")) {
    return std::string("this is an ELF file; give the .uf2, .hex or .bin that lies beside it");
  }
  if (looks_like_dfu(file)) return std::string("this is a DFU file; give the .hex or .bin that lies beside it");
  if (looks_like_uf2(file)) return read_uf2(file);
  if (file.starts_with(':')) return read_hex(file);
  ImageMemory memory;
  const std::vector<std::uint8_t> bytes(file.begin(), file.end());
  if (!memory.put(0, bytes)) return std::string("the file is longer than any part's memory");
  return memory;
}

std::string write_image(const ImageMemory& memory, ImageFormat format) {
  switch (format) {
    case ImageFormat::kHex: return write_hex(memory);
    case ImageFormat::kUf2: return write_uf2(memory);
    case ImageFormat::kDfu: return write_dfu(memory);
    case ImageFormat::kBin:
    case ImageFormat::kSave: break;
  }
  return {memory.bytes().begin(), memory.bytes().end()};
}

std::optional<std::size_t> find_mark(std::span<const std::uint8_t> bytes, std::string_view mark) {
  const auto found = std::search(bytes.begin(), bytes.end(), mark.begin(), mark.end(),
                                 [](std::uint8_t byte, char c) { return byte == static_cast<std::uint8_t>(c); });
  if (found == bytes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - bytes.begin());
}

}  // namespace fencepost::host
