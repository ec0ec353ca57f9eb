/* In the place of a robot: its wheels do 0.25 m/s while they may. A box is 1.5 m ahead, 10 cm wide and 15 cm high. */
#include <fencepost/fencepost.h>
#include <stdio.h>

fencepost_pose wheels(void);
fencepost_box camera_sees(const fencepost_camera *camera);
void motors(bool run);
bool stands_before_the_box(void);

static const float front = 1.5F;   /* m, of the box */
static const float a_step = 0.005F; /* m, in 20 ms */
static float moved = 0;            /* m */

fencepost_pose wheels(void) {
  const fencepost_pose pose = {moved, 0, 0};
  return pose;
}

void motors(bool run) { moved += run ? a_step : 0; }

/* By the pinhole: so far to the right of the axis or below it, over the depth. */
fencepost_box camera_sees(const fencepost_camera *camera) {
  const float depth = front - moved, last_row = (float)(camera->height - 1);
  const float foot = camera->cy + camera->fy * camera->z / depth, shown = foot < last_row ? foot : last_row;
  const float top = camera->cy + camera->fy * (camera->z - 0.15F) / depth;
  return fencepost_box_centred(1, camera->cx, 0.5F * (top + shown), camera->fx * 0.1F / depth + 1, shown - top + 1);
}

bool stands_before_the_box(void) {
  printf("%.2f m before the box\n", (double)(front - moved));
  return front - moved > 0.15F && front - moved < 0.35F;
}
