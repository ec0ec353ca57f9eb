// A Pixy2 on a byte link: UART, SPI, I2C through wire::I2cStream, USB through ChirpLink.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/pixy2/protocol.hpp"
#include "drivers/pixy2/session.hpp"
#include "drivers/wire/flush.hpp"
#include "drivers/wire/receive.hpp"
#include "drivers/wire/scanner.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::pixy2 {

/// The vendor's lens data: 60 x 40 degrees; calibrate for more accuracy. Mount and latency are the robot's.
/// fx = 158 / tan 30 deg.
inline constexpr sensor::CameraIntrinsics kPixy2Profile = {"pixy2",  316,      208, {27'366}, {27'366},
                                                           {15'750}, {10'350}, {0}, {},       base::milliseconds(33)};
/// 80 degrees across: fx = 158 / tan 40 deg.
inline constexpr sensor::CameraIntrinsics kPixy21Profile = {"pixy2.1", 316,      208, {18'830}, {18'830},
                                                            {15'750},  {10'350}, {0}, {},       base::milliseconds(33)};

template <bus::ByteLink Link>
class Camera {
 public:
  explicit Camera(Link& link, const Options& options = {}) : link_(link), session_(options) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    receive(now);
    send(now);
    if (const sensor::BlobFrame* frame = session_.take_frame()) return *frame;
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return session_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return session_.counters().blobs_dropped; }
  [[nodiscard]] const Session& session() const { return session_; }
  /// Packets with a wrong checksum.
  [[nodiscard]] std::uint32_t damaged() const { return scanner_.damaged(); }

 private:
  // Bounded: an SPI link always has bytes. 256 per poll is a whole packet.
  static constexpr int kReads = 8;

  void receive(base::Time now) {
    const bool found = wire::receive(link_, kReads, [&](std::span<const std::uint8_t> bytes) {
      session_.find_link();
      for (const std::uint8_t byte : bytes) feed(byte, now);
    });
    if (!found) lose_link(now);
  }

  void feed(std::uint8_t byte, base::Time now) {
    const std::uint32_t damaged = scanner_.damaged();
    scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
      session_.take(packet_of(message), first_byte, now);
    });
    if (scanner_.damaged() != damaged) session_.take_damage(now);
    if (!scanner_.pending().empty()) session_.extend(now);
  }

  void send(base::Time now) {
    if (const std::optional<Request> request = session_.due(now)) {
      // A partly received packet belongs to no reply that is still awaited.
      scanner_.reset();
      wire::replace(outbox_, request->view());
    }
    if (outbox_.waiting().empty()) return;
    if (!wire::flush(outbox_, link_)) {
      lose_link(now);
    } else if (outbox_.waiting().empty()) {
      session_.find_link();
    }
  }

  void lose_link(base::Time now) {
    session_.lose_link(now);
    scanner_.reset();
    outbox_.clear();
  }

  Link& link_;
  Session session_;
  wire::Scanner<kLongestPacket, examine> scanner_;
  serial::Outbox<kLongestRequest> outbox_;
};

}  // namespace fencepost::pixy2
