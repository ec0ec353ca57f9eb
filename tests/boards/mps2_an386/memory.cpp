// The pages for settings where the machine has memory at the flash's place: nothing survives the machine.
#include "hal/mcu/nrf51/flash.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {

std::span<const std::uint8_t> bytes_at(std::uint32_t address, std::size_t size) {
  return {reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(address)), size};
}
bool program_words(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) reg8(address++) = byte;
  return true;
}
bool erase_page(std::uint32_t address, std::size_t size) {
  for (std::uint32_t i = 0; i < size; ++i) reg8(address + i) = 0xFF;
  return true;
}

}  // namespace fencepost::mcu::nrf51
