#include "tests/studies/storm/robot.hpp"

namespace fencepost::test {

std::unique_ptr<StormRobot> make_robot(std::size_t variant, const RobotParts& parts, console::Mode mode) {
  const std::string_view profile = kVariants[variant].profile;
  if (profile == "micro") return make_micro(variant, parts, mode);
  return profile == "small" ? make_small(variant, parts, mode) : make_full(variant, parts, mode);
}

}  // namespace fencepost::test
