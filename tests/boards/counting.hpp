// Instructions and stack of an image, counted by a plugin of the emulator.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace fencepost::test {

struct StageCount {
  std::uint64_t calls = 0;
  std::uint64_t sum = 0;    ///< instructions, interrupts in between included
  std::uint64_t worst = 0;  ///< of one call
};

/// By stage name; "all": everything the core did, "stack": sum is the high-water mark in bytes.
using Counts = std::map<std::string, StageCount>;

/// The emulator's arguments. `stages`: a name for the table and a part of the function's demangled name, each.
/// Throws std::runtime_error where a function is not in the image, or nothing calls it.
std::vector<std::string> counting_arguments(const std::string& elf,
                                            const std::vector<std::pair<std::string, std::string>>& stages,
                                            const std::string& out);
Counts read_counts(const std::string& file);
/// The row's number in firmware/image/sizes.csv.
std::uint64_t committed(const std::string& image, const std::string& column);
/// Prints the stages; expects more than `least` frames - calls of the stage `frame` - and what one of them sets in
/// motion (the stage "input") and the stack within the image's row.
void expect_counts_as_committed(const Counts& counts, const std::string& image, const std::string& frame, double least);

}  // namespace fencepost::test
