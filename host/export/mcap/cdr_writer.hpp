// Plain CDR, little-endian, as ROS 2 writes its messages (OMG CDR, XCDR1).
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace fencepost::host::exports {

class CdrWriter {
 public:
  CdrWriter& real(double value) { return number(std::bit_cast<std::uint64_t>(value), 8); }
  CdrWriter& single(float value) { return number(std::bit_cast<std::uint32_t>(value), 4); }
  CdrWriter& whole(std::uint32_t value) { return number(value, 4); }
  CdrWriter& signed_whole(std::int32_t value) { return whole(static_cast<std::uint32_t>(value)); }
  CdrWriter& byte(std::uint8_t value) { return number(value, 1); }
  CdrWriter& string(std::string_view text) {
    whole(static_cast<std::uint32_t>(text.size() + 1));
    bytes_ += text;
    bytes_ += '\0';
    return *this;
  }
  CdrWriter& zeros(int reals) {
    for (int i = 0; i < reals; ++i) real(0);
    return *this;
  }
  /// With the encapsulation header.
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHeader = 4;

  /// Aligned to its own size, counted from behind the header.
  CdrWriter& number(std::uint64_t value, std::size_t size) {
    while ((bytes_.size() - kHeader) % size != 0) bytes_ += '\0';
    for (std::size_t i = 0; i < size; ++i) bytes_ += static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
  }

  std::string bytes_ = std::string("\0\1\0\0", kHeader);
};

}  // namespace fencepost::host::exports
