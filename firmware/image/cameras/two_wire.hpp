// The common part of cameras on the two-wire bus whose driver needs a byte link.
#pragma once

#include <cstdint>

#include "drivers/wire/i2c_stream.hpp"
#include "firmware/image/opening.hpp"
#include "hal/sensor/sources.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

template <template <class> class Driver>
class TwoWireCamera {
 public:
  template <class... Options>
  explicit TwoWireCamera(const Opening& opening, const Options&... options)
      : stream_(board::i2c(), opening.camera_address()), camera_(stream_, options...) {}
  static void start(const Opening& /*opening*/) { board::start_i2c(); }

  base::Result<sensor::BlobFrame> poll(base::Time now) { return camera_.poll(now); }
  [[nodiscard]] sensor::LinkState link() const { return camera_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return camera_.dropped(); }

 private:
  wire::I2cStream<board::I2c> stream_;
  Driver<wire::I2cStream<board::I2c>> camera_;
};

}  // namespace fencepost::image
