// The image's only function of its own. Board and profile were chosen when it was configured, and which devices
// it begins with.
#include "firmware/image/robot.hpp"

namespace {

// Made at start-up, not by the compiler: as a constant its tens of kilobytes would lie in flash, too.
[[gnu::noinline]] fencepost::image::Robot make_robot() { return {}; }
fencepost::image::Robot robot = make_robot();  // NOLINT(cert-err58-cpp): nothing in there throws

}  // namespace

extern "C" {
[[noreturn]] void image_main();
}
void image_main() {
  robot.start();
  for (;;) robot.turn();
}
