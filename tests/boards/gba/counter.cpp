#include "tests/boards/gba/counter.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tests/process/child.hpp"

namespace fencepost::test {
namespace {

constexpr std::uint32_t kFastMemory = 0x0300'0000;

std::uint32_t find(const std::string& symbols, const std::string& part) {
  std::istringstream lines(symbols);
  for (std::string line; std::getline(lines, line);) {
    const bool veneer = line.find("_veneer") != std::string::npos || line.find("_from_") != std::string::npos;
    if (!veneer && line.find(part) != std::string::npos) {
      return static_cast<std::uint32_t>(std::stoul(line, nullptr, 16));
    }
  }
  throw std::runtime_error("no function " + part);
}

}  // namespace

InstructionCounter::InstructionCounter(Handheld& machine, const std::string& elf, const Stages& stages)
    : machine_(machine) {
  const std::string symbols = output_of("arm-none-eabi-nm -C " + elf);
  for (const auto& [name, part] : stages) stages_.push_back({name, find(symbols, part) & ~1U, 0, 0, {}});
  stack_bottom_ = find(symbols, " image_stack_bottom");
  stack_top_ = find(symbols, " image_stack_top");
  machine_.watch([this](std::uint32_t next, std::uint32_t returns_to) { see(next, returns_to); });
}

InstructionCounter::~InstructionCounter() { machine_.watch({}); }

void InstructionCounter::see(std::uint32_t next, std::uint32_t returns_to) {
  ++instructions_;
  for (Stage& stage : stages_) {
    if (stage.back == 0 && next == stage.entry) {
      stage.back = returns_to;
      stage.began = instructions_;
    } else if (stage.back != 0 && next == stage.back) {
      const std::uint64_t took = instructions_ - stage.began;
      stage.back = 0;
      ++stage.count.calls;
      stage.count.sum += took;
      stage.count.worst = std::max(stage.count.worst, took);
    }
  }
}

std::size_t InstructionCounter::stack_used() const {
  const std::span<std::uint8_t> memory = machine_.fast_memory();
  const auto* bottom = memory.data() + (stack_bottom_ - kFastMemory);
  const auto* top = memory.data() + (stack_top_ - kFastMemory);
  const auto* used = std::find_if(bottom, top, [](std::uint8_t byte) { return byte != Handheld::kPaint; });
  return static_cast<std::size_t>(top - used);
}

Counts InstructionCounter::counts() const {
  Counts counts;
  for (const Stage& stage : stages_) counts[stage.name] = stage.count;
  counts["all"].sum = instructions_;
  counts["stack"].sum = stack_used();
  return counts;
}

}  // namespace fencepost::test
