// FENCEPOST_CAMERA=pixy2_i2c: a Pixy2 on the two-wire bus; in PixyMon: interface I2C, address 0x54.
#pragma once

#include "drivers/pixy2/camera.hpp"
#include "drivers/wire/i2c_stream.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

class Camera {
 public:
  explicit Camera(const console::Counters& /*counters*/) {}
  static void start() { board::start_i2c(); }
  static sensor::CameraIntrinsics calibration() { return pixy2::kPixy2Profile; }

  base::Result<sensor::BlobFrame> poll(base::Time now) { return camera_.poll(now); }
  [[nodiscard]] sensor::LinkState link() const { return camera_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return camera_.dropped(); }

 private:
  static constexpr std::uint8_t kAddress = 0x54;

  wire::I2cStream<board::I2c> stream_{board::i2c(), kAddress};
  pixy2::Camera<wire::I2cStream<board::I2c>> camera_{stream_};
};
static_assert(sensor::BlobCamera<Camera>);

}  // namespace fencepost::image
