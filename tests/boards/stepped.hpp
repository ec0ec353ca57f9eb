// An emulator as a child process whose time passes only on command, over a line of its own.
#pragma once

#include <string>

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

class SteppedEmulator : public Emulator {
 public:
  /// `control`: which of the lines is its own.
  SteppedEmulator(const BoardUnderTest& board, std::size_t control);

  [[nodiscard]] double seconds() const override { return seconds_ + stood_; }

 protected:
  void tell(const std::string& text);
  /// Its next line of text; empty if there is none within `patience`. Throws std::runtime_error if it has ended.
  std::string answer(std::chrono::milliseconds patience);
  /// `at MICROSECONDS`. Throws std::runtime_error if it says anything else.
  void set_time(const std::string& answer);
  /// So many seconds in which it stood still.
  void stand(double seconds) { stood_ += seconds; }
  void move_lines();
  [[nodiscard]] Line& control() { return line(control_); }

 private:
  void move_control();

  std::size_t control_;
  std::string heard_;
  double seconds_ = 0;  ///< as it says
  double stood_ = 0;
};

/// QEMU with the plugin virtual_time, which says what a step is: a millisecond.
class EmulatedQemu : public SteppedEmulator {
 public:
  EmulatedQemu(const BoardUnderTest& board, std::size_t control)
      : SteppedEmulator(board, control), may_stop_(board.may_stop) {}

  void pump() override;
  void stop() override;

 private:
  [[nodiscard]] bool bytes_wait();
  [[nodiscard]] bool may_stand();

  bool may_stop_;
  bool running_ = true;  // its first answer comes by itself
};

}  // namespace fencepost::test
