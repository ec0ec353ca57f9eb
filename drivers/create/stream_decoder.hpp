// The sensor stream of iRobot's Open Interface, byte by byte.
#pragma once

#include <array>
#include <cstdint>

#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"

namespace fencepost::create {

/// A sensor packet by its number, and how many bytes it has: 1 or 2.
struct StreamField {
  std::uint8_t id = 0;
  std::uint8_t size = 2;
};

inline constexpr std::size_t kMaxFields = 4;
using StreamLayout = base::FixedVector<StreamField, kMaxFields>;

/// Which bytes sum to 0 modulo 256, the checksum included.
enum class ChecksumRule : std::uint8_t {
  kUnknown,
  kWithoutHeader,  ///< Create 1's manual
  kWithHeader,     ///< the specification of Roomba 500/600 and Create 2
};

/// A frame is 0x13, a length, then id and value (big-endian) of each packet, and a checksum. The decoder knows which
/// packets were requested and checks every window of that many bytes: damage in one frame never costs another one.
/// The manuals disagree about the checksum, and real Create 1s are uncertain. Either rule is accepted until one has
/// matched twice in a row, from then on only that one.
class StreamDecoder {
 public:
  explicit StreamDecoder(const StreamLayout& layout);

  /// True: a frame is complete.
  bool feed(std::uint8_t byte, base::Time now);

  /// Of the last frame, in the order of the layout.
  [[nodiscard]] std::uint16_t value(std::size_t field) const { return values_[field]; }
  /// When its first byte arrived.
  [[nodiscard]] base::Time t() const { return t_; }
  [[nodiscard]] ChecksumRule rule() const { return agreed_ >= kAgreement ? rule_ : ChecksumRule::kUnknown; }
  /// Forgets a frame that has begun.
  void reset() { filled_ = 0; }
  /// Forgets the checksum rule: it may be another robot.
  void forget_rule() { agreed_ = 0; }
  /// Complete frames whose checksum matches neither rule, or not the known one.
  [[nodiscard]] std::uint32_t bad_checksums() const { return bad_checksums_; }

 private:
  [[nodiscard]] bool has_shape() const;
  [[nodiscard]] bool check_sum();
  void read_values();

  static constexpr std::uint8_t kHeader = 0x13;
  static constexpr std::uint8_t kAgreement = 2;
  static constexpr std::size_t kMaxFrame = 3 + 3 * kMaxFields;

  StreamLayout layout_;
  std::uint8_t length_;  ///< of a whole frame
  std::uint8_t filled_ = 0;
  std::array<std::uint8_t, kMaxFrame> window_{};
  std::array<base::Time, kMaxFrame> arrived_{};
  std::array<std::uint16_t, kMaxFields> values_{};
  base::Time t_;
  ChecksumRule rule_ = ChecksumRule::kUnknown;
  std::uint8_t agreed_ = 0;
  std::uint32_t bad_checksums_ = 0;
};

}  // namespace fencepost::create
