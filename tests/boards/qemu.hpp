// Starts QEMU so that its time is ours.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/boards/stepped.hpp"

namespace fencepost::test {

struct QemuBoard {
  std::string machine;            ///< as -M has it
  std::string image;              ///< an ELF file
  std::string started;            ///< the .bin that is started instead, if not empty
  std::string tick;               ///< its function that is called each millisecond
  unsigned shift;                 ///< an instruction takes 2^shift ns
  std::vector<std::string> more;  ///< arguments
};

/// The command's begin: all but the lines. `control`: the socket of the line that controls time.
std::vector<std::string> qemu_command(const QemuBoard& board, const std::string& control);
/// Makes the machine of it; `control`: which of its lines that is.
std::function<std::unique_ptr<Machine>(const BoardUnderTest&)> emulated_qemu(std::size_t control);

}  // namespace fencepost::test
