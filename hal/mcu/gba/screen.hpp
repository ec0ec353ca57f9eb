// The screen, 240 x 160, in the mode with a palette and two pages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/screen.hpp"

namespace fencepost::mcu::gba {

class Screen {
 public:
  static constexpr std::size_t kWidth = 240;
  static constexpr std::size_t kHeight = 160;

  void start();
  /// From the clock's interrupt: pages change over while nothing is drawn.
  void tick();

  [[nodiscard]] bool ready() const { return !due_; }
  void put_row(std::size_t y, std::span<const std::uint8_t> pixels) const;
  static void set_colour(std::size_t n, bus::Colour colour);
  void show() { due_ = true; }

 private:
  volatile bool due_ = false;
  volatile bool second_ = false;  ///< the second page is shown
};

static_assert(bus::Screen<Screen>);

}  // namespace fencepost::mcu::gba
