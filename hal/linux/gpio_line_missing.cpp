// In a program that was built where there is no libgpiod.
#include "hal/linux/gpio_line.hpp"

namespace fencepost::linux {

Opened<std::unique_ptr<OutputLine>> open_gpio_line(const GpioSettings& settings) {
  return Problem{"cannot drive the GPIO line " + settings.chip + ":" + settings.line +
                 ": this program was built without libgpiod; 'sudo apt install libgpiod-dev pkg-config', and build it "
                 "again in a fresh folder"};
}

}  // namespace fencepost::linux
