// The state machine of the I2C master's transfers, driven by its interrupt. The registers are a template parameter, so
// that a test can simulate the part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/mcu/i2c_transfer.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// `Registers`: read(offset), write(offset, value) of the master; restart(): reset and set up again, the wires freed.
/// RM0090 27.3.3. Bytes are moved while the part stretches the clock with both its registers full or empty (BTF). So no
/// byte is late, however long another interrupt took. For the last two or three bytes acknowledge and stop have to be
/// set during that stretch, or one byte too many is read. A single byte has no stretch and is awaited by RXNE.
template <class Registers>
class I2cMaster {
 public:
  explicit I2cMaster(Registers registers = {}) : registers_(registers) {}

  /// As bus::I2cBus has it; a transfer of no bytes at all is none: kFull.
  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    const base::Result<std::size_t> prepared = transfer_.prepare(out, expected);
    if (!prepared) return prepared;
    // No transfer of ours is active: a device holds the data wire, or the part believes so (a known erratum).
    if ((registers_.read(kI2cStatus2) & kI2cBusy) != 0) registers_.restart();
    address_ = address;
    reading_ = transfer_.reads_only();
    addressed_ = false;
    transfer_.begin();
    set(kI2cControl2, kI2cEventInterrupt | kI2cErrorInterrupt);
    set(kI2cControl1, kI2cAcknowledge | kI2cStart);
    return prepared;
  }

  base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    const I2cTransfer::State state = transfer_.state();
    if (state == I2cTransfer::State::kIdle) return base::Error::kNotReady;
    // The registers may not be written before the stop is on the wires (27.6.1).
    const bool stopping = (registers_.read(kI2cControl1) & kI2cStop) != 0;
    if (state == I2cTransfer::State::kBusy || stopping) {
      if (!transfer_.late()) return base::Error::kNotReady;
      end_interrupts();
      registers_.restart();
      if (state == I2cTransfer::State::kBusy) transfer_.refuse();
    }
    return transfer_.end(in);
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
  /// The error interrupt: nobody acknowledged, or the bus is disturbed. A bus error alone is no error for a master,
  /// which goes on (errata ES0182, "spurious bus error detection in master mode"). A true one ends by the time limit.
  void on_error() {
    const std::uint32_t errors = registers_.read(kI2cStatus1) & kI2cErrors;
    registers_.write(kI2cStatus1, ~errors & 0xFFFFU);  // cleared by writing zero, the other bits do not mind
    if ((errors & ~kI2cBusError) == 0) return;
    transfer_.refuse();
    end();
  }
  /// Once a millisecond, from an interrupt.
  void on_millisecond() { transfer_.on_millisecond(); }

  /// The transfer that is under way, if any, has never been: whoever began it is gone.
  void abandon() {
    end_interrupts();
    transfer_.abandon();
  }

 protected:
  Registers& registers() { return registers_; }

 private:
  void set(std::uint32_t offset, std::uint32_t bits) { registers_.write(offset, registers_.read(offset) | bits); }
  void clear(std::uint32_t offset, std::uint32_t bits) { registers_.write(offset, registers_.read(offset) & ~bits); }
  void take_byte() { transfer_.take(static_cast<std::uint8_t>(registers_.read(kI2cData))); }
  void end_interrupts() { clear(kI2cControl2, kI2cEventInterrupt | kI2cBufferInterrupt | kI2cErrorInterrupt); }

  // Reading the second status behind the first lets the bus go on (27.6.7).
  void go_on() { static_cast<void>(registers_.read(kI2cStatus2)); }

  void begin_writing() {
    go_on();
    registers_.write(kI2cData, transfer_.next());
  }
  void write_on() {
    if (!transfer_.all_sent()) {
      registers_.write(kI2cData, transfer_.next());
    } else if (transfer_.expected() > 0) {
      reading_ = true;
      set(kI2cControl1, kI2cStart);
    } else {
      end();
    }
  }

  void begin_reading() {
    addressed_ = true;
    if (transfer_.expected() == 1) {
      clear(kI2cControl1, kI2cAcknowledge);
      go_on();
      set(kI2cControl1, kI2cStop);
      set(kI2cControl2, kI2cBufferInterrupt);
    } else if (transfer_.expected() == 2) {  // the acknowledge that is now cleared is the next byte's
      set(kI2cControl1, kI2cPosition);
      clear(kI2cControl1, kI2cAcknowledge);
      go_on();
    } else {
      go_on();
    }
  }
  void read_on(std::uint32_t status) {
    if (transfer_.expected() == 1) {
      if ((status & kI2cReceived) == 0) return;
      take_byte();
      finish_transfer();
      return;
    }
    if ((status & kI2cByteFinished) == 0) return;
    const std::size_t missing = transfer_.missing();
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
    transfer_.done();
  }

  Registers registers_;
  I2cTransfer transfer_;
  std::uint8_t address_ = 0;
  bool reading_ = false;
  bool addressed_ = false;  ///< for reading
};

}  // namespace fencepost::mcu::stm32f4
