// The part's second serial line: 8N1, both ways through rings that its interrupt fills and empties. It reads and writes
// memory by itself, here a byte at a time.
#pragma once

#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/nrf52/pin.hpp"
#include "hal/mcu/nrf52/registers.hpp"
#include "hal/mcu/rings.hpp"

namespace fencepost::mcu::nrf52 {

/// The value of the line's baud register: of those that the manual has for these cameras and bases the next one.
constexpr std::uint32_t line_setting(std::uint32_t baud) {
  struct Speed {
    std::uint32_t baud;
    std::uint32_t setting;
  };
  constexpr Speed kSpeeds[] = {{9'600, kLineBaud9600},   {19'200, kLineBaud19200},   {38'400, kLineBaud38400},
                               {57'600, kLineBaud57600}, {115'200, kLineBaud115200}, {921'600, kLineBaud921600}};
  Speed best = kSpeeds[0];
  for (const Speed& speed : kSpeeds) {
    const auto apart = [baud](std::uint32_t other) { return other > baud ? other - baud : baud - other; };
    if (apart(speed.baud) < apart(best.baud)) best = speed;
  }
  return best.setting;
}

/// Before a program sets the line up: what was under way ends, within a few bytes' time. It writes to memory otherwise.
void stop_line();

class Uart {
 public:
  /// Before anything else here; again, for another device: what was under way ends.
  void start(Pin transmit, Pin receive, std::uint32_t baud);

  base::Result<std::size_t> read(std::span<std::uint8_t> in) { return rings_.read(in); }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

  /// The line's interrupt. The part holds six bytes, 0.5 ms of 115200 baud: nobody may hold it off longer.
  void on_interrupt();

  [[nodiscard]] bool waiting() const { return rings_.waiting(); }

 private:
  [[nodiscard]] bool send_one();

  bool started_ = false;
  volatile bool sending_ = false;  ///< a byte is being sent; an event reports its end
  // One byte each way: what the part reads and writes by itself.
  volatile std::uint8_t arrived_ = 0;
  volatile std::uint8_t leaving_ = 0;
  /// A page of the flash is erased in 85 ms, in which the camera's bytes are lost; the longest frame is worked on in 5.
  Rings<512, 128> rings_;
};

static_assert(bus::ByteLink<Uart>);

}  // namespace fencepost::mcu::nrf52
