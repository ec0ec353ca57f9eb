// A Pixy2 that knows the box's colour as signature 1, two wheels with encoders, two motors: ahead, and a stop before the box.
// Needs the library Pixy2. Measure your robot, and put its numbers here.
#include <Fencepost.h>
#include <Pixy2.h>

const float kCountsPerMetre = 7050;  // of an encoder
const float kTrack = 0.13;           // m, between the wheels
const float kCameraHeight = 0.12;    // m, of the lens above the floor
const int kLeft = 2, kRight = 3;     // encoders, one edge a count
const int kMotors[] = {5, 6};

fencepost::MicroCore robot;
fencepost::WideClock wide;
Pixy2 pixy;
volatile long left_count = 0, right_count = 0;
unsigned long next = 0;

void left_edge() { left_count = left_count + 1; }
void right_edge() { right_count = right_count + 1; }
void say(void*, const fencepost::Alert& alert) { Serial.println(alert.sentence); }
// An input that is not taken changes nothing; this is why.
void check(fencepost::Answer answer) {
  if (answer != fencepost::Answer::kTaken) Serial.println(fencepost::text(answer));
}

void setup() {
  Serial.begin(115200);
  for (int pin : kMotors) pinMode(pin, OUTPUT);
  attachInterrupt(digitalPinToInterrupt(kLeft), left_edge, CHANGE);
  attachInterrupt(digitalPinToInterrupt(kRight), right_edge, CHANGE);
  pixy.init();
  fencepost::Camera camera = fencepost::delivered_camera("pixy2");
  camera.z = kCameraHeight;
  check(robot.set_camera(camera));
  check(robot.set("robot.width", 0.18F));
  check(robot.set_name(1, "red"));
  robot.on_alert(say);
}

// Both wheels turn ahead only, so counts need no sign.
fencepost::Pose wheels() {
  static fencepost::Pose pose = {0, 0, 0};
  static long left_before = 0, right_before = 0;
  noInterrupts();
  const long left_now = left_count, right_now = right_count;
  interrupts();
  const float left = (left_now - left_before) / kCountsPerMetre, right = (right_now - right_before) / kCountsPerMetre;
  left_before = left_now;
  right_before = right_now;
  const float way = (left + right) / 2, turn = (right - left) / kTrack;
  pose.x += way * cos(pose.heading + turn / 2);
  pose.y += way * sin(pose.heading + turn / 2);
  pose.heading += turn;
  return pose;
}

void look(int64_t now) {
  fencepost::Box boxes[fencepost::kMaxBoxes];
  if (pixy.ccc.getBlocks(false) < 0) return;  // no new picture
  size_t count = 0;
  for (; count < pixy.ccc.numBlocks && count < fencepost::kMaxBoxes; ++count) {
    const Block& block = pixy.ccc.blocks[count];  // its middle and its size
    const int x = block.m_x - block.m_width / 2, y = block.m_y - block.m_height / 2;
    fencepost::Box& box = boxes[count];
    box.signature = block.m_signature;
    box.left = constrain(x, 0, 315);
    box.top = constrain(y, 0, 207);
    box.right = constrain(x + block.m_width - 1, 0, 315);
    box.bottom = constrain(y + block.m_height - 1, 0, 207);
  }
  check(robot.boxes(now, boxes, count));
}

void loop() {
  const int64_t now = wide.at(micros());
  look(now);
  if (millis() >= next) {  // 50 times a second
    next = millis() + 20;
    check(robot.odometry(now, wheels()));
  }
  robot.step(now);
  for (int pin : kMotors) analogWrite(pin, robot.may_drive(now) ? 120 : 0);
}
