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
  robot().odometry(0, {1.0F, 0.0F, 0.0F});
  return robot().boxes(0, boxes, count);
}
