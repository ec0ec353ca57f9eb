// Properties over random records of every kind.
#include <gtest/gtest.h>

#include <regex>

#include "firmware/record/decode.hpp"
#include "tests/firmware/record/random_records.hpp"

namespace fencepost::record {
namespace {

constexpr std::size_t kRecordsPerKind = 1'000;

std::string_view without_line_end(const std::string& line) { return std::string_view(line).substr(0, line.size() - 2); }

TEST(RoundTrip, EveryKindComesBackEqualAndToTheSameBytes) {
  RandomRecords random(1);
  for (std::uint8_t kind = 0; kind < kKinds; ++kind) {
    for (std::size_t i = 0; i < kRecordsPerKind; ++i) {
      const AnyRecord record = random.any(static_cast<Kind>(kind));
      const std::string line = encoded(record);
      ASSERT_TRUE(line.ends_with("\r\n")) << name(static_cast<Kind>(kind)) << " was not written";
      Recorder sink;
      const base::Result<Kind, Reject> result = decode(without_line_end(line), {}, sink);
      ASSERT_TRUE(result.ok()) << line << name(result.error());
      ASSERT_EQ(static_cast<std::uint8_t>(*result), kind);
      ASSERT_EQ(sink.records.size(), 1U);
      ASSERT_EQ(sink.records[0], record) << line;
      ASSERT_EQ(encoded(sink.records[0]), line);
    }
  }
}

TEST(RoundTrip, LinesArePrintableAsciiAndShortEnough) {
  RandomRecords random(2);
  for (std::size_t i = 0; i < kRecordsPerKind; ++i) {
    const std::string line = encoded(random.any());
    ASSERT_LE(line.size(), kMaxLine);
    for (const char c : without_line_end(line)) ASSERT_TRUE(c >= ' ' && c <= '~') << line;
  }
}

TEST(RoundTrip, ZeroIsNeverNegative) {
  RandomRecords random(3);
  const std::regex negative_zero(",-0(\\.0*)?[,*]");
  ASSERT_TRUE(std::regex_search("$FPODO,-0.0000,1*", negative_zero));
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < kRecordsPerKind; ++i) {
    const std::string line = encoded(random.any(Kind::kPosition));
    ASSERT_FALSE(std::regex_search(line, negative_zero)) << line;
    zeros += line.find(",0.0000") != std::string::npos ? 1U : 0U;
  }
  EXPECT_GT(zeros, 100U);
}

/// CRC-16 detects every single flipped bit, so no such line may pass as a record - not even as the same one.
TEST(RoundTrip, NoSingleFlippedBitIsAccepted) {
  RandomRecords random(4);
  std::size_t flips = 0;
  for (std::uint8_t kind = 0; kind < kKinds; ++kind) {
    for (int i = 0; i < 8; ++i) {
      const std::string line(without_line_end(encoded(random.any(static_cast<Kind>(kind)))));
      for (std::size_t bit = 0; bit < line.size() * 8; ++bit) {
        std::string flipped = line;
        flipped[bit / 8] = static_cast<char>(static_cast<unsigned char>(flipped[bit / 8]) ^ (1U << (bit % 8)));
        Recorder sink;
        ASSERT_FALSE(decode(flipped, {}, sink).ok()) << flipped;
        ASSERT_TRUE(sink.records.empty());
        ++flips;
      }
    }
  }
  EXPECT_GT(flips, 10'000U);
}

}  // namespace
}  // namespace fencepost::record
