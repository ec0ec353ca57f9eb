// An NXTCam v5 on the serial line of its camera (115200 baud).
#pragma once

#include <cstdint>
#include <span>

#include "drivers/nxtcam/v5_session.hpp"
#include "drivers/wire/flush.hpp"
#include "drivers/wire/receive.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::nxtcam {

/// The lens is documented nowhere: 70.8 degrees across, that of the OpenMV it is built on, gives fx = 120 / tan 35.4
/// deg; calibrate. The latency: one frame of 30 /s to track, one to send.
inline constexpr sensor::CameraIntrinsics kV5Profile = {"nxtcam5", 240,     160, {16'886}, {16'886},
                                                        {11'950},  {7'950}, {0}, {},       base::milliseconds(66)};

/// See V5Options for what is uncertain of this camera. Over I2C it is taken to have the registers of the v4: Camera.
template <bus::ByteLink Link>
class V5Camera {
 public:
  explicit V5Camera(Link& link, const V5Options& options = {}) : link_(link), session_(options) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    receive(now);
    session_.step(now);
    if (!wire::flush(session_.outbox(), link_)) session_.lose_link();
    if (const sensor::BlobFrame* frame = session_.take_frame()) return *frame;
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return session_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return session_.counts().blobs_dropped; }
  [[nodiscard]] const V5Session& session() const { return session_; }

 private:
  static constexpr int kReads = 16;  ///< 512 bytes: 44 ms of the line

  void receive(base::Time now) {
    const bool found = wire::receive(link_, kReads, [&](std::span<const std::uint8_t> bytes) {
      for (const std::uint8_t byte : bytes) session_.take(byte, now);
    });
    found ? session_.find_link() : session_.lose_link();
  }

  Link& link_;
  V5Session session_;
};

}  // namespace fencepost::nxtcam
