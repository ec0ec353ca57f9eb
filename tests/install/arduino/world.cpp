// The examples' world on the desk: time that passes with each loop(), and wheels that turn when the motors have power.
// A Pixy2 sees a box 1.5 m ahead, 10 cm wide and 15 cm high. Ends after 12 s; fails if the robot touched the box or
// stands far from it.
#include <Arduino.h>
#include <Pixy2.h>
#include <stdio.h>

static const float kBox = 1.5F, kFocal = 273.66F, kLens = 0.12F, kCountsPerMetre = 7050;
static const int kDelay = 50;  // ms, of a picture
static unsigned long now = 0;  // ms
static float moved = 0, before[kDelay + 1];
static bool power[2];
static long counted = 0;
static void (*edges[2])();
static Block seen[1];
static bool drives = false;

unsigned long millis() { return now; }
unsigned long micros() { return 0xFFF00000UL + 1000UL * now; }  // wraps after a second
void pinMode(int, int) { drives = true; }
void analogWrite(int pin, int value) { power[pin & 1] = value > 0; }
int digitalPinToInterrupt(int pin) { return pin; }
void attachInterrupt(int interrupt, void (*function)(), int) { edges[interrupt & 1] = function; }
void noInterrupts() {}
void interrupts() {}
void SerialPort::begin(unsigned long) {}
void SerialPort::println(const char* text) { puts(text); }
SerialPort Serial;

int8_t Pixy2::init() {
  ccc.blocks = seen;
  return 0;
}
int8_t PixyBlocks::getBlocks(bool) {
  numBlocks = 0;
  if (now % 20 != 0) return -2;
  const float depth = kBox - before[0];
  const float top = 103.5F - kFocal * 0.03F / depth;
  float bottom = 103.5F + kFocal * kLens / depth;
  if (bottom > 207) bottom = 207;
  seen[0].m_signature = 1;
  seen[0].m_x = 158;
  seen[0].m_y = static_cast<uint16_t>((top + bottom) / 2);
  seen[0].m_width = static_cast<uint16_t>(kFocal * 0.1F / depth);
  seen[0].m_height = static_cast<uint16_t>(bottom - top);
  numBlocks = 1;
  return 1;
}

static void a_millisecond() {
  ++now;
  for (int i = 0; i < kDelay; ++i) before[i] = before[i + 1];
  if (power[0] && power[1]) moved += 0.00025F;
  before[kDelay] = moved;
  for (; counted < static_cast<long>(moved * kCountsPerMetre); ++counted) {
    for (int i = 0; i < 2; ++i) edges[i]();
  }
}

int main() {
  setup();
  for (int i = 0; i < 12000; ++i) {
    loop();
    a_millisecond();
  }
  if (!drives) return 0;  // a sketch that moves nothing
  printf("%.2f m before the box\n", static_cast<double>(kBox - moved));
  return kBox - moved > 0.15F && kBox - moved < 0.35F ? 0 : 1;
}
