// The conversation with a JeVois: the session configures its output, then reads it.
#pragma once

#include <cstdint>

#include "drivers/jevois/decoder.hpp"
#include "drivers/serial/hearing.hpp"
#include "drivers/serial/outbox.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::jevois {

struct Config {
  Names names;  ///< of the things that its module tells of
};

/// JeVois forgets style, decimals, stamps and marks whenever it loads a module. They are sent again until frames come
/// as configured. Other frames that can be read are used, too.
class Session {
 public:
  using Sample = sensor::BlobFrame;

  explicit Session(const Config& config) : decoder_(config.names) {}

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return decoder_.frame(); }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// kUnready: it talks, but for half a second no frame came: no module streams, or it tells no boxes.
  [[nodiscard]] sensor::LinkState link() const { return hearing_.link(decoder_.frame()); }
  [[nodiscard]] std::uint32_t dropped() const { return decoder_.counts().dropped; }
  [[nodiscard]] const Counts& counts() const { return decoder_.counts(); }

 private:
  Decoder decoder_;
  serial::Outbox<128> outbox_;
  bool begun_ = false;
  serial::Hearing hearing_;
  bool as_told_ = false;
  base::Time next_telling_;
};

/// The standard lens, 60 degrees across (JeVois's manual; 65 was published, too), and two frames of 30 /s as latency: a
/// guess, so calibrate.
sensor::CameraIntrinsics nominal_intrinsics(const sensor::CameraMount& mount);

}  // namespace fencepost::jevois
