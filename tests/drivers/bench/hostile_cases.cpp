#include "tests/drivers/bench/hostile_cases.hpp"

#include <vector>

#include "tests/drivers/bench/can_rig.hpp"
#include "tests/drivers/bench/cmucam_rig.hpp"
#include "tests/drivers/bench/create_rig.hpp"
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

// The share of undetected damage that a protocol with sums of two bytes may have.
constexpr double kSum16 = 1e-4;
// A conversation that is begun anew.
constexpr base::Duration kSoon = base::milliseconds(10'000);
// A start of half a dozen waits of 200 ms, or of two seconds, restarted when one of a hundred bytes was damaged.
constexpr base::Duration kLater = base::milliseconds(30'000);
// Through the brick a start takes dozens of telegrams, each damaged as often.
constexpr base::Duration kThroughBrick = base::milliseconds(60'000);

std::vector<HostileCase>& registered() {
  static std::vector<HostileCase> cases;
  return cases;
}

}  // namespace

RegisteredCase::RegisteredCase(const HostileCase& hostile_case) { registered().push_back(hostile_case); }

std::span<const HostileCase> hostile_cases() {
  static const std::vector<HostileCase> kCases = [] {
    std::vector<HostileCase> cases = {
        hostile_case<Pixy2Rig, 2>("pixy2:tty", {kSum16, 90'000, kSoon, base::milliseconds(1'500)}),
        hostile_case<Pixy2UsbRig, 2>("pixy2:usb", {kNoSum, 30'000, kSoon, base::milliseconds(1'500)}),
        hostile_case<NxtCamRig, 3>("nxtcam:i2c", {kNoSum, 60'000, kLater, base::milliseconds(1'000)}),
        hostile_case<NxtCamSerialRig, 3>("nxtcam:tty", {kNoSum, 60'000, kSoon, base::milliseconds(1'000)}),
        hostile_case<NxtCam5Rig, 3>("nxtcam5:tty", {kSum8, 60'000, kSoon, base::milliseconds(1'500), false, true}),
        hostile_case<HostileCmuCam<CmuCamModel::kOne, cmucam::kCmuCam1>, 4>(
            "cmucam1:tty", {kNoSum, 20'000, kSoon, base::milliseconds(2'000)}),
        hostile_case<HostileCmuCam<CmuCamModel::kTwo, cmucam::kCmuCam2>, 4>(
            "cmucam2:tty", {kNoSum, 20'000, kSoon, base::milliseconds(2'000)}),
        hostile_case<HostileCmuCam<CmuCamModel::kThree, cmucam::kCmuCam3>, 4>(
            "cmucam3:tty", {kNoSum, 20'000, kSoon, base::milliseconds(2'000)}),
        hostile_case<HostileCmuCam<CmuCamModel::kFour, cmucam::kCmuCam4>, 4>(
            "cmucam4:tty", {kNoSum, 20'000, kLater, base::milliseconds(2'000), true}),
        hostile_case<XbcRig, 5>("xbc:tty", {kSum8, 10'000, kSoon}),
        hostile_case<HostileCreate<Model::kCreate1, CreateModel::kOne>, 5>(
            "create1:tty", {kSum8, 150'000, kSoon, base::milliseconds(1'000)}),
        hostile_case<HostileCreate<Model::kCreate2, CreateModel::kTwo>, 5>(
            "create2:tty", {kSum8, 150'000, kSoon, base::milliseconds(1'000)}),
        hostile_case<NxtCameraRig<SerialBrick>, 2>("nxtcam:nxt (serial)",
                                                   {kNoSum, 3'000, kThroughBrick, base::milliseconds(3'000)}),
        hostile_case<NxtCameraRig<UsbBrick>, 2>("nxtcam:nxt (usb)",
                                                {kNoSum, 3'000, kThroughBrick, base::milliseconds(3'000)}),
        hostile_case<NxtWheelsRig<SerialBrick>, 2>("nxt:tty",
                                                   {kNoSum, 10'000, kThroughBrick, base::milliseconds(3'000)}),
        hostile_case<NxtWheelsRig<UsbBrick>, 2>("nxt:usb", {kNoSum, 10'000, kThroughBrick, base::milliseconds(3'000)}),
        hostile_case<CanRig, 2>("can", {0, 130'000, kSoon, base::milliseconds(400)}),
    };
    cases.insert(cases.end(), registered().begin(), registered().end());
    return cases;
  }();
  return kCases;
}

}  // namespace fencepost::test
