#include <fencepost/fencepost.h>
#include <stdalign.h>
#include <stdio.h>

fencepost_pose wheels(void);                                /* where your wheels say that the robot is */
fencepost_box camera_sees(const fencepost_camera *camera);  /* a box of your camera's latest picture */
void motors(bool run);                                      /* yours */
bool stands_before_the_box(void);

static void say(void *context, const fencepost_alert *alert) {
  (void)context;
  puts(alert->sentence);
}

static void check(fencepost_answer answer) {
  if (answer != FENCEPOST_TAKEN) puts(fencepost_answer_text(answer));
}

int main(void) {
  static alignas(8) unsigned char memory[27 * 1024];
  fencepost_core *robot = fencepost_init(memory, sizeof memory, fencepost_small());
  fencepost_camera camera = fencepost_pinhole(316, 208, 60);
  camera.z = 0.12F; /* m, of the lens above the floor */
  check(fencepost_set_camera(robot, &camera));
  check(fencepost_on_alert(robot, say, NULL));
  for (int64_t now = 0; now < 8000000; now += 20000) { /* microseconds: 50 times a second */
    check(fencepost_odometry(robot, now, wheels()));
    const fencepost_box box = camera_sees(&camera);
    check(fencepost_boxes(robot, now, &box, 1));
    check(fencepost_step(robot, now));
    motors(fencepost_may_drive(robot, now));
  }
  return stands_before_the_box() ? 0 : 1;
}
