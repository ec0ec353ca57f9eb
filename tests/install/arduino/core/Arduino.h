// In the place of a board's Arduino core: what the examples need of one, and the macros that such headers have.
#pragma once

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define abs(x) ((x) > 0 ? (x) : -(x))
#define constrain(x, low, high) ((x) < (low) ? (low) : ((x) > (high) ? (high) : (x)))
#define radians(deg) ((deg)*DEG_TO_RAD)
#define DEG_TO_RAD 0.017453292519943295769236907684886
#define PI 3.1415926535897932384626433832795
#define bit(b) (1UL << (b))
#define DEFAULT 1
#define CHANGE 2
#define OUTPUT 1
#define F(text) (text)

void setup();
void loop();

unsigned long millis();
unsigned long micros();
void pinMode(int pin, int mode);
void analogWrite(int pin, int value);
int digitalPinToInterrupt(int pin);
void attachInterrupt(int interrupt, void (*function)(), int mode);
void noInterrupts();
void interrupts();

struct SerialPort {
  void begin(unsigned long baud);
  void println(const char* text);
};
extern SerialPort Serial;
