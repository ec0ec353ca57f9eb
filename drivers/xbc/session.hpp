// The protocol state machine of a KIPR XBC that runs fencepost_xbc.ic: it sends, we request its version.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/serial/hearing.hpp"
#include "drivers/serial/outbox.hpp"
#include "drivers/xbc/decoder.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::xbc {

/// The colours of the three channels are trained on the XBC itself, in its menu.
struct Config {
  std::array<std::uint8_t, kChannels> signatures = {1, 2, 3};
};

/// Frames are accepted before the version is known, and rejected if it is not 1.
class Session {
 public:
  using Sample = sensor::BlobFrame;

  explicit Session(const Config& config) : decoder_(config.signatures) {}

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return decoder_.frame(); }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// kUnready: it answers, but for a second no frame has come, or it speaks another version.
  [[nodiscard]] sensor::LinkState link() const { return hearing_.link(decoder_.frame()); }
  [[nodiscard]] std::uint32_t dropped() const { return decoder_.counts().dropped; }
  [[nodiscard]] const Counts& counts() const { return decoder_.counts(); }
  /// 0 until received.
  [[nodiscard]] std::int32_t version() const { return version_; }

 private:
  Decoder decoder_;
  serial::Outbox<8> outbox_;
  bool begun_ = false;
  serial::Hearing hearing_;
  std::int32_t version_ = 0;
  base::Time next_question_;
};

/// Nominal calibration. No source states the XBC's field of view: 45 deg across and square pixels are assumed. Latency:
/// two frames of 15 /s. Calibrate.
sensor::CameraIntrinsics nominal_intrinsics(const sensor::CameraMount& mount);

}  // namespace fencepost::xbc
