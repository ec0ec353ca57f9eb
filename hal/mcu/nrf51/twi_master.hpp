// The state machine of the I2C master's transfers, driven by its interrupt. The registers are a template parameter, so
// that a test can simulate the part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/mcu/i2c_transfer.hpp"
#include "hal/mcu/nrf51/registers.hpp"

namespace fencepost::mcu::nrf51 {

/// `Registers`: read(offset), write(offset, value) of the master; restart(): off and on again, with the wires freed.
/// Source: chapter 28 of the manual. By anomaly 56 of the nRF51822 (PAN) the master locks up when a byte arrives while
/// the previous one is unread. So it is suspended after each byte. One that is stuck all the same, or whose device
/// holds the clock, is switched off and on.
template <class Registers>
class TwiMaster {
 public:
  explicit TwiMaster(Registers registers = {}) : registers_(registers) {}

  /// As bus::I2cBus has it; a transfer of no bytes at all is none: kFull.
  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    const base::Result<std::size_t> prepared = transfer_.prepare(out, expected);
    if (!prepared) return prepared;
    transfer_.begin();
    registers_.write(kTwiAddress, address);
    registers_.write(kTwiInterruptsOn, kTwiAllInterrupts);
    if (transfer_.reads_only()) {
      start_reading();
    } else {
      registers_.write(kTwiShorts, 0);
      registers_.write(kTwiStartWriting, kTrigger);
      send_next();
    }
    return prepared;
  }

  base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    const I2cTransfer::State state = transfer_.state();
    if (state == I2cTransfer::State::kIdle) return base::Error::kNotReady;
    if (state == I2cTransfer::State::kBusy) {
      if (!transfer_.late()) return base::Error::kNotReady;
      registers_.write(kTwiInterruptsOff, kTwiAllInterrupts);
      registers_.restart();
      transfer_.refuse();
    }
    return transfer_.end(in);
  }

  /// The master's interrupt.
  void on_interrupt() {
    if (take(kTwiError)) {
      registers_.write(kTwiErrorSource, kTwiErrors);
      transfer_.refuse();
      registers_.write(kTwiStop, kTrigger);
    }
    if (take(kTwiSent) && !transfer_.refused()) on_sent();
    if (take(kTwiReceived) && !transfer_.refused()) on_received();
    if (take(kTwiStopped)) {
      registers_.write(kTwiInterruptsOff, kTwiAllInterrupts);
      if (transfer_.missing() > 0) transfer_.refuse();
      transfer_.done();
    }
  }
  /// Once a millisecond, from an interrupt.
  void on_millisecond() { transfer_.on_millisecond(); }

  /// The transfer that is under way, if any, has never been: whoever began it is gone.
  void abandon() {
    registers_.write(kTwiInterruptsOff, kTwiAllInterrupts);
    transfer_.abandon();
  }

 private:
  // An event, once.
  bool take(std::uint32_t event) {
    if (registers_.read(event) == 0) return false;
    registers_.write(event, 0);
    return true;
  }
  void send_next() { registers_.write(kTwiTxd, transfer_.next()); }
  void on_sent() {
    if (!transfer_.all_sent()) {
      send_next();
    } else if (transfer_.expected() > 0) {
      start_reading();
    } else {
      registers_.write(kTwiStop, kTrigger);
    }
  }
  // After the last byte the stop has to follow at once, without an acknowledge: the part does it by itself.
  void end_of_byte() {
    registers_.write(kTwiShorts, transfer_.missing() == 1 ? kTwiStopAfterByte : kTwiSuspendAfterByte);
  }
  void start_reading() {
    end_of_byte();
    registers_.write(kTwiStartReading, kTrigger);
  }
  void on_received() {
    const auto byte = static_cast<std::uint8_t>(registers_.read(kTwiRxd));
    if (transfer_.missing() == 0) return;
    transfer_.take(byte);
    if (transfer_.missing() == 0) return;
    end_of_byte();
    registers_.write(kTwiResume, kTrigger);
  }

  Registers registers_;
  I2cTransfer transfer_;
};

}  // namespace fencepost::mcu::nrf51
