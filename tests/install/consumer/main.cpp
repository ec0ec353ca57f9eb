#include <cstdio>
#include <fencepost/fencepost.hpp>

fencepost::Pose wheels();                                 // where your wheels say that the robot is
fencepost::Box camera_sees(const fencepost::Camera& of);  // a box of your camera's latest picture
void motors(bool run);                                    // yours
bool stands_before_the_box();

void check(fencepost::Answer answer) {
  if (answer != fencepost::Answer::kTaken) std::puts(fencepost::text(answer));
}

int main() {
  static fencepost::SmallCore robot;
  fencepost::Camera camera = fencepost::delivered_camera("pixy2");
  camera.z = 0.12F;  // of the lens above the floor; likewise x, y, yaw and pitch
  check(robot.set_camera(camera));
  robot.on_alert([](void*, const fencepost::Alert& alert) { std::puts(alert.sentence); });
  for (std::int64_t now = 0; now < 8000000; now += 20000) {  // microseconds: 50 times a second
    check(robot.odometry(now, wheels()));
    const fencepost::Box box = camera_sees(camera);
    check(robot.boxes(now, &box, 1));
    robot.step(now);
    motors(robot.may_drive(now));
  }
  return stands_before_the_box() ? 0 : 1;
}
