// Holds bytes until it is known whether they are wanted: a little in memory, more in a nameless temporary file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace fencepost::host::cli {

class Spool {
 public:
  static constexpr std::size_t kInMemory = 1U << 20U;

  Spool() = default;
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;
  ~Spool();

  /// errors: Failure (kDevice): no room in the folder for temporary files
  void append(std::string_view bytes);
  void clear();
  [[nodiscard]] std::uint64_t size() const { return filed_ + memory_.size(); }
  /// Reads all bytes in order. If all appends were of one size that divides kInMemory, portions are whole multiples of
  /// it.
  void read(const std::function<void(std::string_view)>& portion) const;

 private:
  void move_to_file();

  std::string memory_;
  std::uint64_t filed_ = 0;
  int file_ = -1;
};

}  // namespace fencepost::host::cli
