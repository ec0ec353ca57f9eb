// The pump of each driver that is no camera of a board's image, on a bus that may answer anything, for its worst-case
// stack. The images' cameras are found by CMakeLists.txt.
#include "drivers/can_wheels/odometry.hpp"
#include "drivers/create/create.hpp"
#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/nxtcam/camera.hpp"
#include "drivers/nxtcam/v5_camera.hpp"
#include "drivers/pixy1/usb.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/pixy2/chirp_link.hpp"
#include "drivers/segmenter/camera.hpp"
#include "tests/stack/some_board.hpp"

namespace fencepost::probe {

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
using NxtCamBehindBrick = nxtcam::Camera<nxt::SensorPort>;
using BluetoothBrick = nxt::Brick<nxt::FramedLink<SomeBytes>>;

}  // namespace fencepost::probe

// The roots that the stack check starts from.
extern "C" {
using namespace fencepost;
using Frame = sensor::BlobFrame;
using Pose = sensor::OdometrySample;
void stack_root_can_wheels(can_wheels::Odometry<probe::SomeCan>& wheels, Pose& pose) { probe::keep_poll(wheels, pose); }
void stack_root_pixy1_usb(pixy1::UsbCamera<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_create(create::Create<probe::SomeBytes>& base, Pose& pose) { probe::keep_poll(base, pose); }
void stack_root_nxt_usb(nxt::Brick<probe::SomePackets>& brick) { brick.poll({}); }
void stack_root_nxt_bluetooth(probe::BluetoothBrick& brick) { brick.poll({}); }
void stack_root_nxt_tacho(nxt::TachoOdometry& motors, Pose& pose) { probe::keep_poll(motors, pose); }
void stack_root_nxtcam_nxt(probe::NxtCamBehindBrick& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_nxtcam_v5(nxtcam::V5Camera<probe::SomeBytes>& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_pixy2_usb(probe::UsbPixy2& camera, Frame& frame) { probe::keep_poll(camera, frame); }
void stack_root_segmenter(segmenter::Camera<probe::SomePictures>& camera, Frame& frame) {
  probe::keep_poll(camera, frame);
}
}
