// Users of the library's header may be older than its sources, and have macros in its way, as Arduino's cores do.
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))
#define radians(deg) ((deg)*0.017453292519943295)
#define bit(b) (1UL << (b))
#define DEFAULT 1
#define PI 3.1415926535897932384626433832795
#include <fencepost/fencepost.hpp>

static_assert(__cplusplus == 201103L, "as old as that");

fencepost::MicroCore& robot() {
  static fencepost::MicroCore core;
  return core;
}
fencepost::Answer take(const fencepost::Box* boxes, std::size_t count) {
  const fencepost::Answer answer = robot().odometry(0, {1.0F, 0.0F, 0.0F});
  return answer == fencepost::Answer::kTaken ? robot().boxes(0, boxes, count) : answer;
}
fencepost::Answer set_up(const fencepost::Camera& camera) {
  const fencepost::Answer answer = robot().set_camera(camera);
  return answer == fencepost::Answer::kTaken ? robot().set("robot.width", 0.18F) : answer;
}
fencepost::Answer start() { return set_up(fencepost::Camera::pinhole(640, 480, 62)); }
fencepost::Answer start_as_delivered() { return set_up(fencepost::delivered_camera("pixy2")); }
fencepost::Answer take_one() {
  const fencepost::Box both[] = {{1, 10, 10, 20, 20}, fencepost::Box::centred(2, 100, 80, 12, 30)};
  return take(both, 2);
}
const char* said(const fencepost::Alert& alert) {
  return alert.level == fencepost::Level::kStop ? alert.sentence : fencepost::text(alert.level);
}
