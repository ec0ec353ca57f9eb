// A Pixy on USB: the blocks that its program pushes through Chirp, after an introduction. For hosts: a message may be
// long.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/chirp/chirp.hpp"
#include "drivers/pixy1/pixy1.hpp"

namespace fencepost::pixy1 {

/// The longest message that is read: a hundred blocks. Pictures are passed over.
inline constexpr std::size_t kLongestMessage = 1'280;

/// For wire::Scanner, as chirp::examine is, and longer.
wire::Verdict examine_message(std::span<const std::uint8_t> bytes);

/// Contents of `CCB1` and `CCB2`: blocks by their edges, colour codes with an angle behind. The columns end one past
/// the last pixel.
/// errors: empty if the message is another, does not hold what it promises, or a box is not in the image
struct Pushed {
  sensor::BlobFrame frame;  ///< its blobs alone
  std::uint32_t dropped = 0;
};
std::optional<Pushed> blocks_in(std::span<const std::uint8_t> message);

/// Introduces itself, has the program run, and listens. Each answer is awaited for 300 ms, a message of blocks for 500
/// ms; then the session begins anew. Every image is pushed, those without blocks too.
class UsbSession {
 public:
  using Sample = sensor::BlobFrame;

  explicit UsbSession(const Options& /*options*/) {}

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return frame_; }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// kUnready: it answers and sends no blocks.
  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] std::uint32_t dropped() const { return counts_.blobs_dropped; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  enum class Phase : std::uint8_t { kClosed, kInitialised, kRunning };

  bool take_message(std::span<const std::uint8_t> message, base::Time first_byte, base::Time now);
  void take_answer(std::span<const std::uint8_t> message, base::Time now);
  void send(const chirp::Transfer& transfer, base::Time until);

  wire::Scanner<kLongestMessage, examine_message> scanner_;
  serial::Outbox<chirp::kTransfer> outbox_;
  Phase phase_ = Phase::kClosed;
  std::optional<base::Time> deadline_;  ///< of the answer, or of the next message of blocks
  std::optional<base::Time> message_at_;
  std::optional<base::Time> frame_at_;
  std::optional<base::Time> last_t_;
  sensor::BlobFrame frame_;
  Counts counts_;
};

template <bus::ByteLink Usb>
class UsbCamera : public serial::Pump<Usb, UsbSession> {
 public:
  explicit UsbCamera(Usb& usb, const Options& options = {}) : serial::Pump<Usb, UsbSession>(usb, options) {}
};

static_assert(sensor::BlobCamera<UsbCamera<serial::LinkArchetype>>);

}  // namespace fencepost::pixy1
