// Instructions of an image by function, and its stack, counted while the emulator runs instruction by instruction.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/boards/counting.hpp"
#include "tests/boards/gba/handheld.hpp"

namespace fencepost::test {

class InstructionCounter {
 public:
  /// `stages`: a name for the table and a part of the function's demangled name, each. Throws std::runtime_error where
  /// a function is not in the image. From now on until the counter ends.
  InstructionCounter(Handheld& machine, const std::string& elf, const Stages& stages);
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  /// As counting.hpp has it.
  [[nodiscard]] Counts counts() const;

 private:
  struct Stage {
    std::string name;
    std::uint32_t entry = 0;
    std::uint32_t back = 0;  ///< where it returns to; 0: it is not running
    std::uint64_t began = 0;
    StageCount count;
  };

  void see(std::uint32_t next, std::uint32_t returns_to);
  [[nodiscard]] std::size_t stack_used() const;

  Handheld& machine_;
  std::vector<Stage> stages_;
  std::uint32_t stack_bottom_ = 0;
  std::uint32_t stack_top_ = 0;
  std::uint64_t instructions_ = 0;
};

}  // namespace fencepost::test
