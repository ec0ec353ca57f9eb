// A line of a GPIO chip (the kernel's character device, by libgpiod 1) as an output.
#pragma once

#include <memory>
#include <string>

#include "hal/linux/opened.hpp"
#include "hal/linux/output_line.hpp"

namespace fencepost::linux {

struct GpioSettings {
  std::string chip;   ///< its name (gpiochip0), number, path or label
  std::string line;   ///< its number on the chip, or the name that the chip has for it
  bool high = false;  ///< from the first moment on
};

/// The kernel gives the line back when it is closed, or when its program ends in any way. Then the chip keeps its level
/// or makes an input of it, and a pull resistor decides.
/// errors: a sentence: no such chip or line, it is in use, it may not be opened, a program built without libgpiod.
Opened<std::unique_ptr<OutputLine>> open_gpio_line(const GpioSettings& settings);

}  // namespace fencepost::linux
