// The transfers of the two-wire master, as its interrupt carries them on. What they are carried on with, the registers,
// is a type, so that the desk can play the part.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// `Registers`: read(offset), write(offset, value) of the master; restart(): reset and set up again, the wires freed.
/// RM0090 27.3.3. Bytes are moved when the part holds the clock with both its registers full or empty (BTF): then no
/// byte can be late, however long another interrupt took. Of the last two or three bytes acknowledge and stop have to
/// be set in that hold, or one byte too many comes; a single byte has no such hold and is awaited by RXNE.
template <class Registers>
class I2cMaster {
 public:
  explicit I2cMaster(Registers registers = {}) : registers_(registers) {}

  /// A transfer of no bytes at all is none: kFull.
  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    if (out.size() > out_.size() || expected > in_.size() || (out.empty() && expected == 0)) return base::Error::kFull;
    if (state_.load(std::memory_order_relaxed) != State::kIdle) return base::Error::kFull;
    // Nothing of ours is under way: a device holds the data wire, or the part believes so (a known fault of it).
    if ((registers_.read(kI2cStatus2) & kI2cBusy) != 0) registers_.restart();
    std::copy(out.begin(), out.end(), out_.begin());
    address_ = address;
    to_send_ = out.size();
    expected_ = expected;
    sent_ = received_ = 0;
    refused_ = false;
    reading_ = out.empty();
    addressed_ = false;
    left_ = kPatience;
    std::atomic_signal_fence(std::memory_order_release);
    state_.store(State::kBusy, std::memory_order_relaxed);
    set(kI2cControl2, kI2cEventInterrupt | kI2cErrorInterrupt);
    set(kI2cControl1, kI2cAcknowledge | kI2cStart);
    return out.size();
  }

  base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    const State state = state_.load(std::memory_order_relaxed);
    if (state == State::kIdle) return base::Error::kNotReady;
    // The registers may not be written before the stop is on the wires (27.6.1).
    const bool stopping = (registers_.read(kI2cControl1) & kI2cStop) != 0;
    if (state == State::kBusy || stopping) {
      if (left_ != 0) return base::Error::kNotReady;
      end_interrupts();
      registers_.restart();
      refused_ = refused_ || state == State::kBusy;
    }
    std::atomic_signal_fence(std::memory_order_acquire);
    state_.store(State::kIdle, std::memory_order_relaxed);
    if (refused_) return base::Error::kRefused;
    const std::size_t count = std::min(in.size(), received_);
    std::copy_n(in_.begin(), count, in.begin());
    return count;
  }

  /// The event interrupt.
  void on_event() {
    const std::uint32_t status = registers_.read(kI2cStatus1);
    if ((status & kI2cStarted) != 0) {
      registers_.write(kI2cData, (std::uint32_t{address_} << 1) | (reading_ ? 1U : 0U));
    } else if ((status & kI2cAddressed) != 0) {
      reading_ ? begin_reading() : begin_writing();
    } else if (reading_) {
      // Until the repeated start is on the wires, the last written byte is still finished.
      if (addressed_) read_on(status);
    } else if ((status & kI2cByteFinished) != 0) {
      write_on();
    }
  }
  /// The error interrupt: nobody acknowledged, or the bus is disturbed.
  void on_error() {
    registers_.write(kI2cStatus1, ~kI2cErrors & 0xFFFFU);  // cleared by writing zero, the other bits do not mind
    refused_ = true;
    end();
  }
  /// Once a millisecond, from an interrupt.
  void on_millisecond() {
    if (left_ != 0) left_ = left_ - 1;
  }

 protected:
  Registers& registers() { return registers_; }

 private:
  /// ms: 65 bytes take 6 at 100 kHz; the rest is for devices that hold the clock to think.
  static constexpr std::uint32_t kPatience = 30;
  enum class State : std::uint8_t { kIdle, kBusy, kDone };

  void set(std::uint32_t offset, std::uint32_t bits) { registers_.write(offset, registers_.read(offset) | bits); }
  void clear(std::uint32_t offset, std::uint32_t bits) { registers_.write(offset, registers_.read(offset) & ~bits); }
  void take_byte() { in_[received_++] = static_cast<std::uint8_t>(registers_.read(kI2cData)); }
  void end_interrupts() { clear(kI2cControl2, kI2cEventInterrupt | kI2cBufferInterrupt | kI2cErrorInterrupt); }

  // Reading the second status behind the first lets the bus go on (27.6.7).
  void go_on() { static_cast<void>(registers_.read(kI2cStatus2)); }

  void begin_writing() {
    go_on();
    registers_.write(kI2cData, out_[sent_++]);
  }
  void write_on() {
    if (sent_ < to_send_) {
      registers_.write(kI2cData, out_[sent_++]);
    } else if (expected_ > 0) {
      reading_ = true;
      set(kI2cControl1, kI2cStart);
    } else {
      end();
    }
  }

  void begin_reading() {
    addressed_ = true;
    if (expected_ == 1) {
      clear(kI2cControl1, kI2cAcknowledge);
      go_on();
      set(kI2cControl1, kI2cStop);
      set(kI2cControl2, kI2cBufferInterrupt);
    } else if (expected_ == 2) {  // the acknowledge that is now cleared is the next byte's
      set(kI2cControl1, kI2cPosition);
      clear(kI2cControl1, kI2cAcknowledge);
      go_on();
    } else {
      go_on();
    }
  }
  void read_on(std::uint32_t status) {
    if (expected_ == 1) {
      if ((status & kI2cReceived) == 0) return;
      take_byte();
      finish_transfer();
      return;
    }
    if ((status & kI2cByteFinished) == 0) return;
    const std::size_t missing = expected_ - received_;
    if (missing == 3) clear(kI2cControl1, kI2cAcknowledge);
    if (missing > 2) {
      take_byte();
      return;
    }
    set(kI2cControl1, kI2cStop);
    take_byte();
    take_byte();
    finish_transfer();
  }

  void end() {
    set(kI2cControl1, kI2cStop);
    finish_transfer();
  }
  void finish_transfer() {
    end_interrupts();
    clear(kI2cControl1, kI2cPosition);
    std::atomic_signal_fence(std::memory_order_release);
    state_.store(State::kDone, std::memory_order_relaxed);
  }

  Registers registers_;
  std::array<std::uint8_t, bus::kMaxI2cTransfer> out_{};
  std::array<std::uint8_t, bus::kMaxI2cTransfer> in_{};
  std::uint8_t address_ = 0;
  std::size_t to_send_ = 0;
  std::size_t expected_ = 0;
  std::size_t sent_ = 0;
  std::size_t received_ = 0;
  bool reading_ = false;
  bool addressed_ = false;  ///< for reading
  bool refused_ = false;
  volatile std::uint32_t left_ = 0;  ///< ms
  std::atomic<State> state_{State::kIdle};
};

}  // namespace fencepost::mcu::stm32f4
