#include "host/import/mcap/cdr.hpp"

#include <bit>

namespace fencepost::host {

CdrReader::CdrReader(std::string_view bytes) {
  constexpr std::size_t kHeader = 4;
  failed_ = bytes.size() < kHeader || bytes[0] != 0 || bytes[1] != 1;
  if (!failed_) bytes_ = bytes.substr(kHeader);
}

/// Aligned to its own size, counted from behind the header.
std::uint64_t CdrReader::raw(std::size_t size) {
  at_ = (at_ + size - 1) / size * size;
  if (failed_ || at_ + size > bytes_.size()) {
    failed_ = true;
    at_ = bytes_.size();
    return 0;
  }
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(bytes_[at_ + i])) << (8 * i);
  }
  at_ += size;
  return value;
}

double CdrReader::real() { return std::bit_cast<double>(raw(8)); }
std::uint32_t CdrReader::whole() { return static_cast<std::uint32_t>(raw(4)); }

std::string_view CdrReader::string() {
  const std::uint32_t size = whole();
  if (failed_ || size > bytes_.size() - at_) {
    failed_ = true;
    return {};
  }
  const std::string_view text = bytes_.substr(at_, size);
  at_ += size;
  return text.ends_with('\0') ? text.substr(0, text.size() - 1) : text;
}

void CdrReader::pass_reals(std::size_t count) {
  for (std::size_t i = 0; i < count && !failed_; ++i) static_cast<void>(real());
}

}  // namespace fencepost::host
