// Plain CDR, little-endian, as ROS 2 writes its messages (OMG CDR, XCDR1).
#pragma once

#include <cstdint>
#include <string_view>

namespace fencepost::host {

class CdrReader {
 public:
  /// With its encapsulation header of four bytes.
  explicit CdrReader(std::string_view bytes);

  double real();  ///< float64
  std::uint32_t whole();
  std::string_view string();
  void pass_reals(std::size_t count);
  /// Something was missing, or the encoding is another one.
  [[nodiscard]] bool failed() const { return failed_; }
  /// All was read, but for padding.
  [[nodiscard]] bool at_end() const { return !failed_ && bytes_.size() - at_ < 4; }

 private:
  std::uint64_t raw(std::size_t size);

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace fencepost::host
