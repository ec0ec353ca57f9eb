// Unpacks gzip.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct z_stream_s;

namespace fencepost::host {

/// Decides by the first two bytes.
bool is_gzip(std::string_view bytes);

/// Maximum bytes, unpacked, of a file that is read as a whole: an hour of driving has 9 MB. A few KB of gzip can become
/// many GB.
inline constexpr std::size_t kMaxWhole = 64'000'000;

/// All of its members one behind the other; nothing where it is damaged or cut off. Stops behind `most` bytes: the
/// result is longer than `most` then.
std::optional<std::string> gunzip(std::string_view bytes, std::size_t most = kMaxWhole);

/// The same in portions, in memory that does not grow with it.
class Gunzip {
 public:
  Gunzip();
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;
  ~Gunzip();

  /// The packed bytes that follow, at most 4 GB, when `next` has none left. They have to hold as long as they are used.
  void feed(std::string_view packed);
  /// Unpacked bytes, which hold until the next call; none: it wants more, or is damaged.
  std::string_view next();
  [[nodiscard]] bool damaged() const { return damaged_; }
  /// Nothing more is due: the stream may end here.
  [[nodiscard]] bool complete() const { return between_members_; }

 private:
  std::unique_ptr<z_stream_s> stream_;
  std::array<char, 1U << 16U> chunk_{};
  bool damaged_ = false;
  bool between_members_ = true;
};

}  // namespace fencepost::host
