#include "tests/studies/storm/profile_robot.hpp"

namespace fencepost::test {

std::unique_ptr<StormRobot> make_small(std::size_t variant, const RobotParts& parts, console::Mode mode) {
  switch (variant) {
    case 3: return make_variant<config::Small, 3>(parts, mode);
    case 4: return make_variant<config::Small, 4>(parts, mode);
    default: return make_variant<config::Small, 5>(parts, mode);
  }
}

}  // namespace fencepost::test
