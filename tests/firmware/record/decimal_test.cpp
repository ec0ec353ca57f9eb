// Text to scaled integers and back: rounding, limits, and texts that are no number.
#include "firmware/record/decimal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace fencepost::record {
namespace {

constexpr NumberField kFourDecimals{-10'000'000, 10'000'000, 4};
constexpr NumberField kWhole{0, 4'294'967'295, 0};

TEST(ReadDecimal, RoundsHalfAwayFromZero) {
  struct Case {
    std::string_view text;
    std::int64_t raw;
  };
  for (const Case& c : {
           Case{"0", 0},
           {"1", 10'000},
           {"1.5", 15'000},
           {"0.1234", 1'234},
           {"007.0", 70'000},
           {"0.00004", 0},
           {"0.00005", 1},
           {"0.000049999999999999999999", 0},
           {"0.00015", 2},
           {"0.00025", 3},
           {"-0.00004", 0},
           {"-0.00005", -1},
           {"-0.00014999", -1},
           {"-0.00015", -2},
           {"-0.0000", 0},
           {"-0", 0},
           {"0.99995", 10'000},
           {"-0.99995", -10'000},
           {"1000", 10'000'000},
           {"-1000.0000", -10'000'000},
           {"1000.00004999", 10'000'000},
           {"0000000000000000000000000000000000000000000000001.0000000000000000000000000000000000000000000", 10'000},
       }) {
    const auto raw = read_decimal(c.text, kFourDecimals);
    ASSERT_TRUE(raw.ok()) << c.text;
    EXPECT_EQ(*raw, c.raw) << c.text;
  }
}

TEST(ReadDecimal, RoundsToWholeNumbersToo) {
  for (const auto& [text, raw] : {std::pair<std::string_view, std::int64_t>{"617", 617},
                                  {"617.4", 617},
                                  {"617.5", 618},
                                  {"-0.4", 0},
                                  {"4294967295", 4'294'967'295}}) {
    const auto read = read_decimal(text, kWhole);
    ASSERT_TRUE(read.ok()) << text;
    EXPECT_EQ(*read, raw) << text;
  }
}

TEST(ReadDecimal, RejectsWhatIsOutOfRangeAfterRounding) {
  for (const std::string_view text :
       {"1000.0001", "1000.00005", "-1000.0001", "-1000.00005", "9999999999999999999999999999999999999999",
        "-18446744073709551616", "18446744073709551617", "922337203685477.5808", "1844674407370955.1616"}) {
    const auto raw = read_decimal(text, kFourDecimals);
    ASSERT_FALSE(raw.ok()) << text;
    EXPECT_EQ(raw.error(), Reject::kRange) << text;
  }
  EXPECT_EQ(read_decimal("4294967296", kWhole).error(), Reject::kRange);
  EXPECT_EQ(read_decimal("4294967295.5", kWhole).error(), Reject::kRange);
  EXPECT_EQ(read_decimal("-1", kWhole).error(), Reject::kRange);
  EXPECT_EQ(read_decimal("-0.5", kWhole).error(), Reject::kRange);
}

TEST(ReadDecimal, RejectsWhatIsNoPlainDecimal) {
  for (const std::string_view text :
       {"",        "-",   ".",    "-.",    "+1",    "--1", "1-",       "1e3",  "1E3",
        "nan",     "NaN", "inf",  "-inf",  " 1",    "1 ",  "1.2.3",    "1..2", ".5",
        "5.",      "-.5", "0x10", "1_000", "1'000", "abc", "\xC2\xBD", "1\r",  "12345678901234567890x",
        "1.00000x"}) {
    const auto raw = read_decimal(text, kFourDecimals);
    ASSERT_FALSE(raw.ok()) << text;
    EXPECT_EQ(raw.error(), Reject::kNumber) << text;
  }
  EXPECT_EQ(read_decimal(std::string_view("1\0", 2), kFourDecimals).error(), Reject::kNumber);
}

// Whatever it reads is what read_decimal() reads of that field, and it reads all that writers write.
TEST(ReadPlain, AgreesWithReadDecimal) {
  constexpr std::string_view kFields[] = {"0",
                                          "-0",
                                          "7",
                                          "-7",
                                          "007",
                                          "1.5",
                                          "-1.25",
                                          "0.1234",
                                          "999.9999",
                                          "1000",
                                          "1000.1",
                                          "-1000",
                                          "0.0001",
                                          "12.34567",
                                          "1.",
                                          ".5",
                                          "-",
                                          "",
                                          "--1",
                                          "1.2.3",
                                          "+1",
                                          "1e3",
                                          "1\r",
                                          "x",
                                          "123456789",
                                          "1234567890123",
                                          "99999999999999",
                                          "100000000000000",
                                          "0000000000001.0000",
                                          "12345678901234567890",
                                          "999999999999999999999999999999"};
  for (const NumberField& field : {kFourDecimals, kWhole, NumberField{-5, 9'999'999'999'999'999, 1}}) {
    for (const std::string_view text : kFields) {
      for (const std::string_view tail : {"", ",", ",2", ",,"}) {
        const std::string line = std::string(text) + std::string(tail);
        std::string_view rest = line;
        const std::optional<std::int64_t> plain = read_plain(rest, field);
        const auto whole = read_decimal(text, field);
        if (!plain) {
          EXPECT_EQ(rest, line) << line;
          continue;
        }
        ASSERT_TRUE(whole.ok()) << line;
        EXPECT_EQ(*plain, *whole) << line;
        EXPECT_EQ(rest, tail.substr(tail.empty() ? 0 : 1)) << line;
      }
    }
    for (const std::int64_t raw : {field.min, std::int64_t{0}, std::int64_t{1}, std::int64_t{12'345}, field.max}) {
      if (raw < field.min || raw > field.max) continue;
      char text[kMaxDecimal];
      std::string_view rest(text, write_decimal(raw, field.decimals, text));
      EXPECT_EQ(read_plain(rest, field), raw);
    }
  }
}

TEST(WriteDecimal, WritesExactlyTheDecimals) {
  struct Case {
    std::int64_t raw;
    unsigned decimals;
    std::string_view text;
  };
  for (const Case& c : {Case{0, 4, "0.0000"},
                        {-10, 4, "-0.0010"},
                        {9, 1, "0.9"},
                        {-9, 1, "-0.9"},
                        {10, 1, "1.0"},
                        {27'360, 2, "273.60"},
                        {-32'768, 0, "-32768"},
                        {0, 0, "0"},
                        {-1, 4, "-0.0001"},
                        {9'999'990'000, 4, "999999.0000"},
                        {4'294'967'295, 0, "4294967295"},
                        {std::numeric_limits<std::int64_t>::max(), 4, "922337203685477.5807"},
                        {-std::numeric_limits<std::int64_t>::max(), 1, "-922337203685477580.7"}}) {
    char text[kMaxDecimal];
    EXPECT_EQ(std::string_view(text, write_decimal(c.raw, c.decimals, text)), c.text);
  }
}

}  // namespace
}  // namespace fencepost::record
