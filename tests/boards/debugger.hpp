// A debugger at QEMU's own door: it can do to a program what no line can.
#pragma once

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

/// GoogleTest expectations. The debugger sends the program to where there is no memory: a hard fault, a reset, and the
/// next run tells, once. `from`: how its sentence about that ends, for code of this board.
void expect_tells_of_a_fault(const BoardUnderTest& board, std::uint32_t caller);

}  // namespace fencepost::test
