// An image's file as the memory that it will be in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.hpp"

namespace fencepost::host {

/// Erased memory from `begin` on, in which some bytes are known.
class ImageMemory {
 public:
  [[nodiscard]] std::uint32_t begin() const { return begin_; }
  [[nodiscard]] std::uint64_t end() const { return begin_ + std::uint64_t{bytes().size()}; }
  /// From begin(); erased bytes are 0xFF.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return std::span(bytes_).subspan(front_); }
  [[nodiscard]] bool known(std::uint64_t address) const {
    return address >= begin_ && address < end() && known_[front_ + static_cast<std::size_t>(address - begin_)];
  }
  [[nodiscard]] std::uint8_t at(std::uint64_t address) const {
    return bytes()[static_cast<std::size_t>(address - begin_)];
  }

  /// False: so far from the rest that it would be no microcontroller's memory; nothing changes then.
  [[nodiscard]] bool put(std::uint32_t address, std::span<const std::uint8_t> bytes);
  /// The same bytes elsewhere.
  void move_to(std::uint32_t begin) { begin_ = begin; }

 private:
  static constexpr std::uint64_t kMax = 32U << 20U;

  void grow_in_front(std::size_t count);

  std::uint32_t begin_ = 0;
  std::size_t front_ = 0;  ///< unused bytes in front of begin()
  std::vector<std::uint8_t> bytes_;
  std::vector<bool> known_;
};

enum class ImageFormat : std::uint8_t { kBin, kHex, kUf2, kDfu, kSave };

/// The format by the end of a file's name: .bin and .gba, .hex, .uf2, .dfu, .sav.
std::optional<ImageFormat> image_format(std::string_view name);

/// Recognises the format by the content. A .bin has no addresses: it begins at 0. errors: the fault, and the remedy
base::Result<ImageMemory, std::string> read_image(std::string_view file);
/// `memory` of the RP2040 alone as kUf2, of an STM32 alone as kDfu.
std::string write_image(const ImageMemory& memory, ImageFormat format);

/// The places of the first bytes of `mark`.
std::optional<std::size_t> find_mark(std::span<const std::uint8_t> bytes, std::string_view mark);

}  // namespace fencepost::host
