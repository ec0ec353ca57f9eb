#include "firmware/console/input_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace fencepost::test {
namespace {

// Puts `bytes` in, at most `chunk` at a time, and takes every line out as soon as it is whole.
std::vector<std::string> lines_of(std::string bytes, std::size_t chunk, console::InputLines& input) {
  std::vector<std::string> lines;
  while (!bytes.empty()) {
    const auto room = input.room();
    const std::size_t count = std::min({room.size(), chunk, bytes.size()});
    std::copy_n(bytes.begin(), count, room.begin());
    input.filled(count);
    bytes.erase(0, count);
    while (const auto line = input.front()) {
      lines.push_back((line->too_long ? "TOO LONG " : "") + std::string(line->text.data(), line->text.size()));
      input.pop_front();
    }
  }
  return lines;
}
std::vector<std::string> lines_of(const std::string& bytes, std::size_t chunk) {
  console::InputLines input;
  return lines_of(bytes, chunk, input);
}

using Lines = std::vector<std::string>;

TEST(InputLines, EndWithReturnOrNewlineOrBoth) {
  for (std::size_t chunk = 1; chunk <= 20; ++chunk) {
    EXPECT_EQ(lines_of("a\rb\nc\r\nd\n", chunk), (Lines{"a", "b", "c", "d"})) << chunk;
    EXPECT_EQ(lines_of("a\r\n\r\nb\n\nc\r\r", chunk), (Lines{"a", "", "b", "", "c", ""})) << chunk;
    EXPECT_EQ(lines_of("\na\n\r", chunk), (Lines{"", "a", ""})) << chunk;
  }
}

TEST(InputLines, AnUnfinishedLineWaits) {
  console::InputLines input;
  EXPECT_EQ(lines_of("sta", 1024, input), Lines{});
  EXPECT_EQ(lines_of("tus\r", 1024, input), Lines{"status"});
}

TEST(InputLines, TheLongestLineFitsExactly) {
  const std::string longest(record::kMaxLine - 1, 'x');
  for (const std::size_t chunk : {1U, 7U, 1023U, 1024U}) {
    EXPECT_EQ(lines_of(longest + "\n" + longest + "\r\nok\n", chunk), (Lines{longest, longest, "ok"})) << chunk;
  }
}

TEST(InputLines, ATooLongLineIsDiscardedToItsEndAndKeepsItsBeginning) {
  for (const std::size_t size : {1024U, 1025U, 2047U, 2048U, 5000U}) {
    for (const std::size_t chunk : {1U, 7U, 1023U, 1024U}) {
      const Lines lines = lines_of("$FPODO," + std::string(size - 7, 'x') + "\nok\n", chunk);
      ASSERT_EQ(lines.size(), 2U) << size << " " << chunk;
      EXPECT_EQ(lines[0].rfind("TOO LONG $FPODO,", 0), 0U) << lines[0];
      EXPECT_EQ(lines[1], "ok");
    }
  }
}

TEST(InputLines, ALineThatWaitsHoldsTheRest) {
  console::InputLines input;
  const std::string bytes = "first\nsecond\n" + std::string(2000, 'x');
  std::size_t taken = 0;
  while (true) {
    const auto room = input.room();
    if (room.empty()) break;
    const std::size_t count = std::min(room.size(), bytes.size() - taken);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(taken), count, room.begin());
    input.filled(count);
    taken += count;
    ASSERT_TRUE(input.front());
  }
  EXPECT_EQ(taken, 1024U);
  EXPECT_EQ(std::string(input.front()->text.data(), input.front()->text.size()), "first");
  input.pop_front();
  EXPECT_EQ(std::string(input.front()->text.data(), input.front()->text.size()), "second");
}

}  // namespace
}  // namespace fencepost::test
