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
#include "hal/mcu/nrf51/registers.hpp"

namespace fencepost::mcu::nrf51 {

/// `Registers`: read(offset), write(offset, value) of the master; restart(): off and on again, with the wires freed.
/// Chapter 28 of the manual; and anomaly 56 of the nRF51822 (PAN): the master locks up where a byte comes while the
/// last one is still unread. So it is suspended after each byte by itself, and one that is stuck for all that, or whose
/// device holds the clock, is switched off and on.
template <class Registers>
class TwiMaster {
 public:
  explicit TwiMaster(Registers registers = {}) : registers_(registers) {}

  /// A transfer of no bytes at all is none: kFull.
  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    if (out.size() > out_.size() || expected > in_.size() || (out.empty() && expected == 0)) return base::Error::kFull;
    if (state_.load(std::memory_order_relaxed) != State::kIdle) return base::Error::kFull;
    std::copy(out.begin(), out.end(), out_.begin());
    to_send_ = out.size();
    expected_ = expected;
    sent_ = received_ = 0;
    refused_ = false;
    left_ = kPatience;
    std::atomic_signal_fence(std::memory_order_release);
    state_.store(State::kBusy, std::memory_order_relaxed);
    registers_.write(kTwiAddress, address);
    registers_.write(kTwiInterruptsOn, kTwiAllInterrupts);
    if (to_send_ == 0) {
      start_reading();
    } else {
      registers_.write(kTwiShorts, 0);
      registers_.write(kTwiStartWriting, kTrigger);
      send_next();
    }
    return out.size();
  }

  base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    switch (state_.load(std::memory_order_relaxed)) {
      case State::kIdle: return base::Error::kNotReady;
      case State::kBusy:
        if (left_ != 0) return base::Error::kNotReady;
        registers_.write(kTwiInterruptsOff, kTwiAllInterrupts);
        registers_.restart();
        refused_ = true;
        break;
      case State::kDone: break;
    }
    std::atomic_signal_fence(std::memory_order_acquire);
    state_.store(State::kIdle, std::memory_order_relaxed);
    if (refused_) return base::Error::kRefused;
    const std::size_t count = std::min(in.size(), received_);
    std::copy_n(in_.begin(), count, in.begin());
    return count;
  }

  /// The master's interrupt.
  void on_interrupt() {
    if (take(kTwiError)) {
      registers_.write(kTwiErrorSource, kTwiErrors);
      refused_ = true;
      registers_.write(kTwiStop, kTrigger);
    }
    if (take(kTwiSent) && !refused_) on_sent();
    if (take(kTwiReceived) && !refused_) on_received();
    if (take(kTwiStopped)) {
      registers_.write(kTwiInterruptsOff, kTwiAllInterrupts);
      refused_ = refused_ || received_ < expected_;
      std::atomic_signal_fence(std::memory_order_release);
      state_.store(State::kDone, std::memory_order_relaxed);
    }
  }
  /// Once a millisecond, from an interrupt.
  void on_millisecond() {
    if (left_ != 0) left_ = left_ - 1;
  }

 private:
  /// ms: 64 bytes take 6 at 100 kHz; the rest is for devices that hold the clock to think.
  static constexpr std::uint32_t kPatience = 30;
  enum class State : std::uint8_t { kIdle, kBusy, kDone };

  // An event, once.
  bool take(std::uint32_t event) {
    if (registers_.read(event) == 0) return false;
    registers_.write(event, 0);
    return true;
  }
  void send_next() { registers_.write(kTwiTxd, out_[sent_++]); }
  void on_sent() {
    if (sent_ < to_send_) {
      send_next();
    } else if (expected_ > 0) {
      start_reading();
    } else {
      registers_.write(kTwiStop, kTrigger);
    }
  }
  // After the last byte the stop has to follow at once, without an acknowledge: the part does it by itself.
  void end_of_byte() {
    registers_.write(kTwiShorts, received_ + 1 == expected_ ? kTwiStopAfterByte : kTwiSuspendAfterByte);
  }
  void start_reading() {
    end_of_byte();
    registers_.write(kTwiStartReading, kTrigger);
  }
  void on_received() {
    const auto byte = static_cast<std::uint8_t>(registers_.read(kTwiRxd));
    if (received_ == expected_) return;
    in_[received_++] = byte;
    if (received_ == expected_) return;
    end_of_byte();
    registers_.write(kTwiResume, kTrigger);
  }

  Registers registers_;
  std::array<std::uint8_t, bus::kMaxI2cTransfer> out_{};
  std::array<std::uint8_t, bus::kMaxI2cTransfer> in_{};
  std::size_t to_send_ = 0;
  std::size_t expected_ = 0;
  std::size_t sent_ = 0;
  std::size_t received_ = 0;
  bool refused_ = false;
  volatile std::uint32_t left_ = 0;  ///< ms
  std::atomic<State> state_{State::kIdle};
};

}  // namespace fencepost::mcu::nrf51
