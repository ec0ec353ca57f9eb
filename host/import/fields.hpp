// Reads the little-endian fields of binary records that others wrote.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fencepost::host {

/// Little-endian fields of a record; what is beyond its end is an end, not an error.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  template <class Integer>
  Integer integer() {
    Integer value = 0;
    const std::string_view part = take(sizeof(Integer));
    for (std::size_t i = 0; i < part.size(); ++i) {
      value = static_cast<Integer>(
          value | static_cast<Integer>(static_cast<Integer>(static_cast<std::uint8_t>(part[i])) << (8 * i)));
    }
    return value;
  }
  double real() { return std::bit_cast<double>(integer<std::uint64_t>()); }
  std::string_view string() { return take(integer<std::uint32_t>()); }
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) {
      short_ = true;
      bytes_ = {};
      return {};
    }
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  [[nodiscard]] std::string_view rest() const { return bytes_; }
  [[nodiscard]] bool ended_early() const { return short_; }

 private:
  std::string_view bytes_;
  bool short_ = false;
};

}  // namespace fencepost::host
