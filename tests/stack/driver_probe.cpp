// The pump of each driver, instantiated on a bus that may answer anything, for its worst-case stack.
#include <cstdint>
#include <span>

#include "drivers/can_wheels/odometry.hpp"
#include "drivers/cmucam/cmucam.hpp"
#include "drivers/cognachrome/cognachrome.hpp"
#include "drivers/create/create.hpp"
#include "drivers/huskylens/huskylens.hpp"
#include "drivers/jevois/jevois.hpp"
#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "drivers/nxtcam/v5_camera.hpp"
#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy1/usb.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/pixy2/chirp_link.hpp"
#include "drivers/segmenter/camera.hpp"
#include "drivers/wire/i2c_stream.hpp"
#include "drivers/xbc/xbc.hpp"

namespace fencepost::probe {

// What the optimiser cannot see through, or it would drop the driver's body. The bus's own stack is not the driver's.
[[gnu::noinline]] std::uint32_t unknown() {
  static volatile std::uint32_t value = 0;
  return value;
}
base::Result<std::size_t> some(std::span<std::uint8_t> in) {
  if (unknown() == 0) return unknown() == 1 ? base::Error::kGone : base::Error::kNotReady;
  for (std::uint8_t& byte : in) byte = static_cast<std::uint8_t>(unknown());
  return unknown() % (in.size() + 1);
}
base::Result<std::size_t> taken(std::span<const std::uint8_t> out) {
  if (unknown() == 0) return unknown() == 1 ? base::Error::kGone : base::Error::kFull;
  return unknown() % (out.size() + 1);
}

struct SomeBytes {
  static base::Result<std::size_t> read(std::span<std::uint8_t> in) { return some(in); }
  static base::Result<std::size_t> write(std::span<const std::uint8_t> out) { return taken(out); }
};
struct SomeI2c {
  static base::Result<std::size_t> begin(std::uint8_t /*address*/, std::span<const std::uint8_t> out, std::size_t) {
    return taken(out);
  }
  static base::Result<std::size_t> finish(std::span<std::uint8_t> in) { return some(in); }
};
struct SomePackets {
  static base::Result<std::size_t> send(std::span<const std::uint8_t> out) { return taken(out); }
  static base::Result<std::size_t> receive(std::span<std::uint8_t> in) { return some(in); }
};
struct SomeCan {
  static base::Result<bus::CanFrame> receive() {
    if (unknown() == 0) return unknown() == 1 ? base::Error::kGone : base::Error::kBadInput;
    bus::CanFrame frame;
    frame.id = unknown();
    frame.length = static_cast<std::uint8_t>(unknown() % 9);
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(unknown());
    return frame;
  }
};

struct SomePictures {
  static base::Result<bus::Picture> next() {
    if (unknown() == 0) return unknown() == 1 ? base::Error::kGone : base::Error::kBadInput;
    static constexpr std::uint8_t kBytes[64] = {};
    const auto layout = static_cast<bus::PixelLayout>(unknown() % 3);
    const auto width = static_cast<std::uint16_t>(unknown());
    return bus::Picture{layout, width, static_cast<std::uint16_t>(unknown()), unknown(), kBytes, {}};
  }
};

using UsbPixy2 = pixy2::Camera<pixy2::ChirpLink<SomeBytes>>;
using I2cPixy2 = pixy2::Camera<wire::I2cStream<SomeI2c>>;
using I2cPixy1 = pixy1::Camera<wire::I2cStream<SomeI2c>>;
using I2cHuskyLens = huskylens::Camera<wire::I2cStream<SomeI2c>>;
using NxtCamBehindBrick = nxtcam::Camera<nxt::SensorPort>;
using BluetoothBrick = nxt::Brick<nxt::FramedLink<SomeBytes>>;

template <class Driver, class Kept>
void keep_poll(Driver& driver, Kept& kept) {
  if (auto got = driver.poll(kept.t)) kept = *got;
}

}  // namespace fencepost::probe

// The roots that the stack check starts from.
extern "C" {
using namespace fencepost;
using Frame = sensor::BlobFrame;
using Pose = sensor::OdometrySample;
void stack_root_can_wheels(can_wheels::Odometry<probe::SomeCan>& wheels, Pose& pose) { probe::keep_poll(wheels, pose); }
void stack_root_cmucam(cmucam::CmuCam<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_cognachrome(cognachrome::Camera<probe::SomeBytes>& camera, Frame& frame) {
  probe::keep_poll(camera, frame);
}
void stack_root_huskylens_serial(huskylens::Camera<probe::SomeBytes>& camera, Frame& frame) {
  probe::keep_poll(camera, frame);
}
void stack_root_huskylens_i2c(probe::I2cHuskyLens& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_jevois(jevois::JeVois<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy1_serial(pixy1::Camera<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy1_i2c(probe::I2cPixy1& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy1_usb(pixy1::UsbCamera<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_create(create::Create<probe::SomeBytes>& base, Pose& pose) { probe::keep_poll(base, pose); }
void stack_root_nxt_usb(nxt::Brick<probe::SomePackets>& brick) { brick.poll({}); }
void stack_root_nxt_bluetooth(probe::BluetoothBrick& brick) { brick.poll({}); }
void stack_root_nxt_tacho(nxt::TachoOdometry& motors, Pose& pose) { probe::keep_poll(motors, pose); }
void stack_root_nxtcam_i2c(nxtcam::Camera<probe::SomeI2c>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_nxtcam_nxt(probe::NxtCamBehindBrick& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_nxtcam_serial(nxtcam::SerialCamera<probe::SomeBytes>& camera, Frame& frame) {
  probe::keep_poll(camera, frame);
}
void stack_root_nxtcam_v5(nxtcam::V5Camera<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy2_serial(pixy2::Camera<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy2_i2c(probe::I2cPixy2& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy2_usb(probe::UsbPixy2& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_segmenter(segmenter::Camera<probe::SomePictures>& camera, Frame& frame) {
  probe::keep_poll(camera, frame);
}
void stack_root_xbc(xbc::Xbc<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
}
