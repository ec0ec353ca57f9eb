#include "hal/mcu/gba/screen.hpp"

#include "hal/mcu/gba/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::gba {

void Screen::start() { reg16(kDisplayControl) = kDisplayMode4 | kDisplayBackground; }

void Screen::tick() {
  if (!due_ || reg16(kDisplayLine) < kHeight) return;
  second_ = !second_;
  reg16(kDisplayControl) =
      static_cast<std::uint16_t>(kDisplayMode4 | kDisplayBackground | (second_ ? kDisplaySecondPage : 0));
  due_ = false;
}

void Screen::put_row(std::size_t y, std::span<const std::uint8_t> pixels) const {
  auto address = static_cast<std::uint32_t>(kVideoMemory + (second_ ? 0 : kVideoPage) + y * kWidth);
  for (std::size_t x = 0; x + 1 < pixels.size() && x + 1 < kWidth; x += 2, address += 2) {
    reg16(address) = static_cast<std::uint16_t>(pixels[x] | (pixels[x + 1] << 8));
  }
}

void Screen::set_colour(std::size_t n, bus::Colour colour) {
  const auto five = [](std::uint8_t value) { return static_cast<std::uint32_t>(value >> 3); };
  reg16(static_cast<std::uint32_t>(kPalette + 2 * n)) =
      static_cast<std::uint16_t>(five(colour.red) | (five(colour.green) << 5) | (five(colour.blue) << 10));
}

}  // namespace fencepost::mcu::gba
