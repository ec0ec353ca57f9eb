// Nothing but a board: a pretended robot drives towards a pretended box, 10 cm wide and 15 cm high, and stops before it.
// Open the serial monitor at 115200 baud.
#include <Fencepost.h>

fencepost::MicroCore robot;
fencepost::Camera camera = fencepost::delivered_camera("pixy2");
const float kBox = 1.5;  // m, from where the robot starts to the box
float moved = 0, seen_from = 0;
unsigned long next = 0;
int64_t now = 0;  // us, of the pretended drive

void say(void*, const fencepost::Alert& alert) { Serial.println(alert.sentence); }
// An input that is not taken changes nothing; this is why.
void check(fencepost::Answer answer) {
  if (answer != fencepost::Answer::kTaken) Serial.println(fencepost::text(answer));
}

int16_t pixel(float place) { return constrain(place + 0.5F, 0.0F, 207.0F); }

fencepost::Box box_seen() {
  const float depth = kBox - seen_from;
  const float half = camera.fx * 0.05F / depth;
  return {1, pixel(camera.cx - half), pixel(camera.cy - camera.fy * 0.03F / depth), pixel(camera.cx + half),
          pixel(camera.cy + camera.fy * camera.z / depth)};
}

void setup() {
  Serial.begin(115200);
  camera.z = 0.12;  // m, of the lens above the floor
  camera.latency = 40000;
  check(robot.set_camera(camera));
  check(robot.set_name(1, "red"));
  robot.on_alert(say);
}

void loop() {
  if (millis() < next) return;
  next += 40;
  now += 40000;
  const bool may_drive = robot.may_drive(now);
  check(robot.odometry(now, {moved, 0, 0}));
  const fencepost::Box box = box_seen();  // of the picture before
  check(robot.boxes(now, &box, 1));
  robot.step(now);
  seen_from = moved;
  if (may_drive) moved += 0.01F;  // 0.25 m/s
}
