// As much of an Arduino as the example sketch uses, on a clock of the test's.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fencepost::host::arduino {

constexpr int OUTPUT = 1;

/// The board's: what its pins do, and what time it is.
struct Pins {
  unsigned long now = 0;  ///< ms
  std::map<int, int> modes;
  std::map<int, int> duty;
};
inline Pins pins;
inline unsigned long millis() { return pins.now; }
inline void pinMode(int pin, int mode) { pins.modes[pin] = mode; }
inline void analogWrite(int pin, int duty) { pins.duty[pin] = duty; }

class String {
 public:
  [[nodiscard]] unsigned length() const { return static_cast<unsigned>(text_.size()); }
  [[nodiscard]] bool startsWith(const char* text) const { return text_.starts_with(text); }
  [[nodiscard]] bool endsWith(const char* text) const { return text_.ends_with(text); }
  [[nodiscard]] int indexOf(const char* text) const {
    const std::size_t at = text_.find(text);
    return at == std::string::npos ? -1 : static_cast<int>(at);
  }
  String& operator+=(char c) {
    text_ += c;
    return *this;
  }

 private:
  std::string text_;
};

class Serial {
 public:
  void begin(long baud) { baud_ = baud; }
  [[nodiscard]] int available() const { return baud_ == 115'200 ? static_cast<int>(waiting.size()) : 0; }
  int read() {
    const char c = waiting.front();
    waiting.pop_front();
    return static_cast<unsigned char>(c);
  }
  void print(const char* text) { written.emplace_back(pins.now, text); }

  std::deque<char> waiting;
  std::vector<std::pair<unsigned long, std::string>> written;

 private:
  long baud_ = 0;
};
inline Serial Serial1;

}  // namespace fencepost::host::arduino
