#include "tests/boards/counting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace fencepost::test {
namespace {

std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe.get())) > 0;) text.append(part.data(), n);
  return text;
}

std::string symbol_address(const std::string& symbols, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(symbols, match, std::regex("([0-9a-f]+) . " + name + "\n"))) {
    throw std::runtime_error("no symbol " + name);
  }
  return match[1];
}

}  // namespace

std::vector<std::string> counting_arguments(const std::string& elf,
                                            const std::vector<std::pair<std::string, std::string>>& stages,
                                            const std::string& out) {
  const std::string symbols = output_of("arm-none-eabi-nm " + elf);
  std::istringstream code(output_of("arm-none-eabi-objdump -d -C --no-show-raw-insn " + elf));
  std::vector<std::string> entries(stages.size());
  std::vector<std::string> returns(stages.size());
  const std::regex head("([0-9a-f]{8}) <(.*)>:");
  const std::regex call(" *([0-9a-f]+):\tbl\t([0-9a-f]+) <(.*)>");
  std::smatch match;
  for (std::string line; std::getline(code, line);) {
    const bool is_head = std::regex_match(line, match, head);
    const bool is_call = !is_head && std::regex_match(line, match, call);
    if (!is_head && !is_call) continue;
    const std::string name = match[is_head ? 2 : 3];
    if (name.find("+0x") != std::string::npos)
      continue;  // a far jump within a function, which Armv6-M has no other for
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (name.find(stages[i].second) == std::string::npos) continue;
      if (is_head) entries[i] = match[1];
      std::array<char, 24> behind{};
      std::snprintf(behind.data(), behind.size(), ";%llx", std::stoull(match[1], nullptr, 16) + 4);
      if (is_call) returns[i] += behind.data();
    }
  }
  std::string plugin = FENCEPOST_COUNT_PLUGIN ",out=" + out + ",low=" + symbol_address(symbols, "image_stack_bottom") +
                       ",high=" + symbol_address(symbols, "image_stack_top");
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (entries[i].empty() || returns[i].empty()) throw std::runtime_error("no calls of " + stages[i].second);
    plugin += ",stage=" + stages[i].first + ";" + entries[i] + returns[i];
  }
  return {"-plugin", plugin};
}

Counts read_counts(const std::string& file) {
  std::ifstream in(file);
  Counts counts;
  std::string name;
  StageCount count;
  while (in >> name >> count.calls >> count.sum >> count.worst) counts[name] = count;
  return counts;
}

std::uint64_t committed(const std::string& image, const std::string& column) {
  std::ifstream in(FENCEPOST_SOURCE_DIR "/firmware/image/sizes.csv");
  std::string line;
  std::getline(in, line);
  std::vector<std::string> head;
  for (std::istringstream words(line); std::getline(words, line, ',');) head.push_back(line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::map<std::string, std::string> row;
    for (const std::string& name : head) std::getline(words, row[name], ',');
    if (row["image"] == image) return std::stoull(row.at(column));
  }
  throw std::runtime_error("no row of " + image);
}

void expect_counts_as_committed(const Counts& counts, const std::string& image, const std::string& frame,
                                double least) {
  for (const auto& [name, count] : counts) {
    const double each = static_cast<double>(count.sum) / static_cast<double>(std::max<std::uint64_t>(count.calls, 1));
    std::printf("%-8s %8.0f instructions, worst %8.0f, %.0f calls\n", name.c_str(), each,
                static_cast<double>(count.worst), static_cast<double>(count.calls));
  }
  const double frames = static_cast<double>(counts.at(frame).calls);
  EXPECT_GT(frames, least);
  EXPECT_LE(static_cast<double>(counts.at("input").sum) / frames, static_cast<double>(committed(image, "frame")));
  EXPECT_LE(counts.at("input").worst, committed(image, "worst_frame"));
  EXPECT_GT(counts.at("stack").sum, 1000U);
  EXPECT_LE(counts.at("stack").sum, committed(image, "stack"));
}

}  // namespace fencepost::test
