// FENCEPOST_CAMERA=huskylens_i2c: a HuskyLens on the two-wire bus; in its settings: protocol type I2C.
#pragma once

#include "drivers/huskylens/huskylens.hpp"
#include "drivers/wire/i2c_stream.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

class Camera {
 public:
  explicit Camera(const console::Counters& /*counters*/) {}
  static void start() { board::start_i2c(); }
  static sensor::CameraIntrinsics calibration() { return huskylens::kProfile; }

  base::Result<sensor::BlobFrame> poll(base::Time now) { return camera_.poll(now); }
  [[nodiscard]] sensor::LinkState link() const { return camera_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return camera_.dropped(); }

 private:
  wire::I2cStream<board::I2c> stream_{board::i2c(), huskylens::kAddress};
  huskylens::Camera<wire::I2cStream<board::I2c>> camera_{stream_};
};
static_assert(sensor::BlobCamera<Camera>);

}  // namespace fencepost::image
