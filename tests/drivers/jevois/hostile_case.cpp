// A JeVois through hostile hours.
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/jevois/rig.hpp"

namespace fencepost::test {
namespace {

// Nothing is sealed: of a frame's 60 bytes a dozen are a box's digits, and one in 100 bytes is damaged.
constexpr double kJeVoisNoSum = 0.1;

const RegisteredCase kJeVois{hostile_case<JeVoisRig, 2>(
    "jevois:tty", {kJeVoisNoSum, 30'000, base::milliseconds(10'000), base::milliseconds(3'000)})};

}  // namespace
}  // namespace fencepost::test
