#include "tests/studies/storm/profile_robot.hpp"

namespace fencepost::test {

std::unique_ptr<StormRobot> make_full(std::size_t variant, const RobotParts& parts, console::Mode mode) {
  switch (variant) {
    case 6: return make_variant<config::Full, 6>(parts, mode);
    case 7: return make_variant<config::Full, 7>(parts, mode);
    default: return make_variant<config::Full, 8>(parts, mode);
  }
}

}  // namespace fencepost::test
