#include "tests/drivers/bench/hostile_cases.hpp"

#include <array>

#include "tests/drivers/bench/can_rig.hpp"
#include "tests/drivers/bench/cmucam_rig.hpp"
#include "tests/drivers/bench/comeback.hpp"
#include "tests/drivers/bench/create_rig.hpp"
#include "tests/drivers/bench/hostile_hours.hpp"
#include "tests/drivers/bench/nxt_rig.hpp"
#include "tests/drivers/bench/nxtcam5_rig.hpp"
#include "tests/drivers/bench/nxtcam_rig.hpp"
#include "tests/drivers/bench/pixy2_rig.hpp"
#include "tests/drivers/bench/xbc_rig.hpp"

namespace fencepost::test {
namespace {

using create::Model;
using emulate::CmuCamModel;
using emulate::CreateModel;

// Steps of the loop in milliseconds, as coarse as the device allows.
template <class Rig, std::int64_t Step>
HostileCase hostile_case(std::string_view name, const HostileLimits& limits) {
  return {
      name,
      [](double hours, std::uint32_t seed) { return run_hostile_hours<Rig>(hours, seed, base::milliseconds(Step)); },
      [] { return spend_day<Rig>(base::milliseconds(Step)); }, limits};
}

// The share of undetected damage is that of the protocol: sums of one or two bytes, or none at all.
constexpr double kSum16 = 1e-4;
constexpr double kSum8 = 1e-3;
constexpr double kNoSum = 0.1;
constexpr base::Duration kSoon = base::milliseconds(10'000);
// A start of half a dozen waits of 200 ms, restarted when one of a hundred bytes was damaged.
constexpr base::Duration kLater = base::milliseconds(30'000);
// Through the brick a start takes dozens of telegrams, each damaged as often.
constexpr base::Duration kThroughBrick = base::milliseconds(60'000);

}  // namespace

std::span<const HostileCase> hostile_cases() {
  static const std::array kCases = {
      hostile_case<Pixy2Rig, 2>("pixy2:tty", {kSum16, 90'000, kSoon}),
      hostile_case<Pixy2UsbRig, 2>("pixy2:usb", {kNoSum, 30'000, kSoon}),
      hostile_case<NxtCamRig, 3>("nxtcam:i2c", {kNoSum, 60'000, kLater}),
      hostile_case<NxtCamSerialRig, 3>("nxtcam:tty", {kNoSum, 60'000, kSoon}),
      hostile_case<NxtCam5Rig, 3>("nxtcam5:tty", {kSum8, 60'000, kSoon}),
      hostile_case<HostileCmuCam<CmuCamModel::kOne, cmucam::kCmuCam1>, 4>("cmucam1:tty", {kNoSum, 20'000, kSoon}),
      hostile_case<HostileCmuCam<CmuCamModel::kTwo, cmucam::kCmuCam2>, 4>("cmucam2:tty", {kNoSum, 20'000, kSoon}),
      hostile_case<HostileCmuCam<CmuCamModel::kThree, cmucam::kCmuCam3>, 4>("cmucam3:tty", {kNoSum, 20'000, kSoon}),
      hostile_case<HostileCmuCam<CmuCamModel::kFour, cmucam::kCmuCam4>, 4>("cmucam4:tty", {kNoSum, 20'000, kSoon}),
      hostile_case<XbcRig, 5>("xbc:tty", {kSum8, 10'000, kSoon}),
      hostile_case<HostileCreate<Model::kCreate1, CreateModel::kOne>, 5>("create1:tty", {kSum8, 150'000, kSoon}),
      hostile_case<HostileCreate<Model::kCreate2, CreateModel::kTwo>, 5>("create2:tty", {kSum8, 150'000, kSoon}),
      hostile_case<NxtCameraRig<SerialBrick>, 2>("nxtcam:nxt (serial)", {kNoSum, 3'000, kThroughBrick}),
      hostile_case<NxtCameraRig<UsbBrick>, 2>("nxtcam:nxt (usb)", {kNoSum, 3'000, kThroughBrick}),
      hostile_case<NxtWheelsRig<SerialBrick>, 2>("nxt:tty", {kNoSum, 10'000, kThroughBrick}),
      hostile_case<NxtWheelsRig<UsbBrick>, 2>("nxt:usb", {kNoSum, 10'000, kThroughBrick}),
      hostile_case<CanRig, 2>("can", {0, 130'000, kSoon}),
  };
  return kCases;
}

}  // namespace fencepost::test
