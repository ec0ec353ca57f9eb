// Pixy, the CMUcam5: what it sends unasked over UART and I2C. Source: the vendor's firmware and Arduino library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/serial/outbox.hpp"
#include "drivers/serial/pump.hpp"
#include "drivers/wire/scanner.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::pixy1 {

inline constexpr std::uint16_t kWidth = 320;
inline constexpr std::uint16_t kHeight = 200;
inline constexpr std::uint8_t kAddress = 0x54;  ///< on I2C, seven bits

/// The vendor's lens data: 75 degrees across, fx = 160 / tan 37.5 deg, and square pixels; calibrate. The latency: two
/// images of 50 /s.
inline constexpr sensor::CameraIntrinsics kProfile = {"pixy1",  kWidth,  kHeight, {20'852}, {20'852},
                                                      {15'950}, {9'950}, {0},     {},       base::milliseconds(40)};

/// Words of 16 bits, low byte first: `AA55` begins an image, `AA55 <sum> <signature> <x> <y> <width> <height>` is a
/// block, `AA56 ... <angle>` a colour code, `0000` stands where there is nothing. The sum is that of the words behind
/// it.
inline constexpr std::size_t kWord = 2;         ///< bytes of a mark or an idle word
inline constexpr std::size_t kBlock = 14;       ///< bytes
inline constexpr std::size_t kColourCode = 16;  ///< bytes

/// For wire::Scanner: a message is a mark or an idle word (2 bytes), a block (14), a colour code (16). All else is
/// damage.
wire::Verdict examine(std::span<const std::uint8_t> bytes);

/// A block's box in our convention. The camera reports its middle (rounded down) and size. Its columns end one past the
/// last pixel (run lengths), its rows with the last one: x2 = left + width - 1 and y2 = top + height. A colour code's
/// signature is its octal number. Cut at the last row.
/// errors: empty if the box is not in the image, or the signature 0 or above 255
std::optional<sensor::Blob> blob_of(std::span<const std::uint8_t> block);

struct Options {
  /// Zeros alone for so long are an image without blocks: three images, since the camera may be slow in the dark.
  base::Duration empty_after = base::milliseconds(60);
};

struct Counts {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;  ///< beyond sixteen, the smallest; colour codes above 255
  std::uint32_t broken = 0;         ///< images with damage
};

/// Puts blocks together to images.
class Images {
 public:
  explicit Images(const Options& options) : options_(options) {}

  /// A message that `examine` found. True: frame() is complete, until the next message.
  bool take(std::span<const std::uint8_t> message, base::Time first_byte);
  /// Bytes that fit nothing: the image that is arriving is not whole.
  void take_damage();
  void reset();

  [[nodiscard]] const sensor::BlobFrame& frame() const { return frame_; }
  /// Whether the last one had blobs.
  [[nodiscard]] bool saw() const { return saw_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  void begin(base::Time first_byte);
  bool end();
  bool take_idle(base::Time now);
  void take_block(std::span<const std::uint8_t> block);
  bool give();

  Options options_;
  bool building_ = false;
  bool damaged_ = false;
  bool given_ = false;  ///< frame_ was, and is not yet that of the image that has begun since
  bool saw_ = false;
  bool any_ = false;                ///< blocks in the image that is arriving
  std::optional<base::Time> last_;  ///< since then zeros have come alone
  base::Time mark_;
  sensor::BlobFrame frame_;
  Counts counts_;
};

class Session {
 public:
  using Sample = sensor::BlobFrame;

  explicit Session(const Options& options) : images_(options) {}

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return images_.frame(); }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] std::uint32_t dropped() const { return images_.counts().blobs_dropped; }
  [[nodiscard]] const Counts& counts() const { return images_.counts(); }

 private:
  wire::Scanner<kColourCode, examine> scanner_;
  Images images_;
  serial::Outbox<1> outbox_;  ///< always empty
  std::optional<base::Time> byte_at_;
  std::optional<base::Time> frame_at_;
};

/// 19200 baud as delivered. A frame's t is when the first byte of its mark arrived.
template <bus::ByteLink Link>
class Camera : public serial::Pump<Link, Session> {
 public:
  explicit Camera(Link& link, const Options& options = {}) : serial::Pump<Link, Session>(link, options) {}
};

static_assert(sensor::BlobCamera<Camera<serial::LinkArchetype>>);

}  // namespace fencepost::pixy1
