// A Cognachrome on a serial line through hostile hours.
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/cognachrome/rig.hpp"

namespace fencepost::test {
namespace {

// There is no checksum at all; a start is five prompts, begun anew when a byte of theirs was damaged.
constexpr double kCognachromeSum = 0.1;
const RegisteredCase kCognachrome{hostile_case<CognachromeRig, 2>(
    "cognachrome:tty", {kCognachromeSum, 100'000, base::milliseconds(30'000), base::milliseconds(1'000)})};

}  // namespace
}  // namespace fencepost::test
