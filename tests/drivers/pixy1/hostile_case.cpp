// A Pixy on a serial line, and on USB, through hostile hours.
#include "drivers/pixy1/pixy1.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/pixy1/rig.hpp"

namespace fencepost::test {
namespace {

// Two wrong of three and a half million samples in a day: damage made zeros of a mark, or the sum right.
constexpr double kPixy1Sum = 1e-5;

const RegisteredCase kPixy1Serial{hostile_case<Pixy1Rig, 2>(
    "pixy1:tty", {kPixy1Sum, 100'000, base::milliseconds(1'500), base::milliseconds(1'000), false, true})};

// USB has its own checksum, Chirp none.
constexpr double kPixy1UsbSum = 0.1;

const RegisteredCase kPixy1Usb{hostile_case<Pixy1UsbRig, 2>(
    "pixy1:usb", {kPixy1UsbSum, 30'000, base::milliseconds(10'000), base::milliseconds(1'000)})};

}  // namespace
}  // namespace fencepost::test
