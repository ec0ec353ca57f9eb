#include "drivers/wire/scanner.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace fencepost::wire {
namespace {

// 7, a length, as many bytes, 9.
Verdict sevens(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != 7) return {Front::kNoise, skip_to(bytes, 7)};
  if (bytes.size() < 2 || bytes.size() < 3U + bytes[1]) return {};
  if (bytes[2U + bytes[1]] != 9) return {Front::kDamaged, skip_to(bytes, 7)};
  return {Front::kMessage, 3U + bytes[1]};
}

std::vector<std::int64_t> heard(const std::vector<std::uint8_t>& bytes) {
  Scanner<8, sevens> scanner;
  std::vector<std::int64_t> times;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    scanner.feed(bytes[i], base::Time{static_cast<std::int64_t>(i)},
                 [&](std::span<const std::uint8_t>, base::Time t) { times.push_back(t.raw); });
  }
  return times;
}

TEST(Scanner, ScansDamageAgain) {
  // The first 7 claims five bytes; there is no 9 behind them, but a message among them.
  EXPECT_EQ(heard({7, 5, 7, 0, 9, 1, 1, 1}).size(), 1U);
  EXPECT_EQ(heard({7, 5, 7, 0, 9, 7, 0, 9}).size(), 1U);  // the last 9 ends the outer one
  EXPECT_EQ(heard({7, 5, 7, 0, 9, 7, 0, 8, 7, 0, 9}).size(), 2U);
}

// Longer than there is room: not waited for.
TEST(Scanner, DropsWhatCannotFit) {
  EXPECT_EQ(heard({7, 200, 1, 1, 1, 1, 1, 1, 1, 7, 0, 9}), (std::vector<std::int64_t>{9}));
}

TEST(Scanner, ForgetsAMessageBegun) {
  Scanner<8, sevens> scanner;
  int count = 0;
  const auto sink = [&](std::span<const std::uint8_t>, base::Time) { ++count; };
  scanner.feed(7, {}, sink);
  scanner.feed(5, {}, sink);
  scanner.reset();
  for (const std::uint8_t byte : std::array<std::uint8_t, 3>{7, 0, 9}) scanner.feed(byte, {}, sink);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(scanner.messages(), 1U);
}

}  // namespace
}  // namespace fencepost::wire
