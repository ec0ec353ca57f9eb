#include "tests/studies/storm/profile_robot.hpp"

namespace fencepost::test {

std::unique_ptr<StormRobot> make_micro(std::size_t variant, const RobotParts& parts, console::Mode mode) {
  switch (variant) {
    case 0: return make_variant<config::Micro, 0>(parts, mode);
    case 1: return make_variant<config::Micro, 1>(parts, mode);
    default: return make_variant<config::Micro, 2>(parts, mode);
  }
}

}  // namespace fencepost::test
