// In the place of a robot: wheels that do 0.25 m/s while they may, and a box 1.5 m ahead. The box is 10 cm wide and
// 15 cm high.
#include <cstdio>
#include <fencepost/fencepost.hpp>

fencepost::Pose wheels();
fencepost::Box camera_sees(const fencepost::Camera& of);
void motors(bool run);
bool stands_before_the_box();

namespace {

const float kFront = 1.5F;       // m, of the box
const float kAStep = 0.005F;     // m, in 20 ms
float moved_to = 0;              // m
float seen_from[3] = {0, 0, 0};  // the last places: a picture is 50 ms old when it comes

std::int16_t pixel(float place) { return static_cast<std::int16_t>(place + 0.5F); }

}  // namespace

fencepost::Pose wheels() {
  seen_from[0] = seen_from[1];
  seen_from[1] = seen_from[2];
  seen_from[2] = moved_to;
  return {moved_to, 0, 0};
}

void motors(bool run) { moved_to += run ? kAStep : 0; }

// By the pinhole: the distance to the right of the axis or below it, over the depth.
fencepost::Box camera_sees(const fencepost::Camera& of) {
  const float depth = kFront - 0.5F * (seen_from[0] + seen_from[1]);
  const float foot = of.cy + of.fy * of.z / depth;
  const float last_row = static_cast<float>(of.height - 1);
  fencepost::Box box;
  box.signature = 1;
  box.left = pixel(of.cx - of.fx * 0.05F / depth);
  box.right = pixel(of.cx + of.fx * 0.05F / depth);
  box.top = pixel(of.cy + of.fy * (of.z - 0.15F) / depth);
  box.bottom = pixel(foot < last_row ? foot : last_row);
  return box;
}

bool stands_before_the_box() {
  const float left = kFront - moved_to;
  std::printf("%.2f m before the box\n", static_cast<double>(left));
  return left > 0.15F && left < 0.35F;
}
