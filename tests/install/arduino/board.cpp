// A part that is nowhere: its registers are there so that nothing of a sketch is left out as useless.
#include <Arduino.h>
#include <Pixy2.h>

static volatile uint32_t registers[16];
static Block seen[1];

unsigned long millis() { return registers[0]; }
unsigned long micros() { return registers[1]; }
void pinMode(int pin, int mode) { registers[2] = static_cast<uint32_t>(pin + mode); }
void analogWrite(int pin, int value) { registers[3 + (pin & 1)] = static_cast<uint32_t>(value); }
int digitalPinToInterrupt(int pin) { return pin; }
void attachInterrupt(int, void (*function)(), int) {
  if (registers[5] != 0) function();
}
void noInterrupts() { registers[6] = 1; }
void interrupts() { registers[6] = 0; }
void SerialPort::begin(unsigned long baud) { registers[7] = baud; }
void SerialPort::println(const char* text) {
  for (; *text != 0; ++text) registers[8] = static_cast<uint32_t>(*text);
}
SerialPort Serial;
int8_t Pixy2::init() {
  ccc.blocks = seen;
  return 0;
}
int8_t PixyBlocks::getBlocks(bool) {
  seen[0].m_x = static_cast<uint16_t>(registers[9]);
  numBlocks = static_cast<uint8_t>(registers[10]);
  return static_cast<int8_t>(registers[11]);
}

int main() {
  setup();
  for (;;) loop();
}
