// The pages for settings where the machine has memory at the flash's place: nothing survives the machine.
#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/flash.hpp"

namespace fencepost::mcu::rp2 {
namespace {

std::uint32_t address_of(std::size_t n) { return Flash::kAddress + static_cast<std::uint32_t>(n * Flash::size()); }

}  // namespace

std::span<const std::uint8_t> Flash::page(std::size_t n) {
  return {reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(address_of(n))), size()};
}
bool Flash::program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
  std::uint32_t to = address_of(n) + static_cast<std::uint32_t>(offset);
  for (const std::uint8_t byte : bytes) reg8(to++) = byte;
  return true;
}
bool Flash::erase(std::size_t n) {
  for (std::uint32_t i = 0; i < size(); ++i) reg8(address_of(n) + i) = 0xFF;
  return true;
}

}  // namespace fencepost::mcu::rp2
