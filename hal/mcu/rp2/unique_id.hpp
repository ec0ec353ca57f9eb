// By what a computer knows one board from another.
#pragma once

#include <cstdint>

namespace fencepost::mcu::rp2 {

/// A number that no other board has, as the vendor's programs give it; 0 or all ones if there is none. Before anything
/// needs interrupts: they are held for 0.3 ms.
std::uint64_t read_unique_id();

}  // namespace fencepost::mcu::rp2
