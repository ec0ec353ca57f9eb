// Whatever a serial line may deliver: noise, damaged logs, damage with a matching CRC. 20,000 fixed inputs.
#include <gtest/gtest.h>

#include "tests/firmware/record/random_records.hpp"
#include "tests/firmware/record/stream_invariants.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fencepost::record {
namespace {

/// Sums over many inputs: a test that only ever saw foreign lines would prove nothing.
struct Seen {
  std::uint32_t records = 0;
  std::uint32_t foreign = 0;
  std::array<std::uint32_t, kRejectReasons> rejects{};

  void add(const Counts& counts) {
    records += counts.records;
    foreign += counts.foreign;
    for (std::size_t i = 0; i < kRejectReasons; ++i) rejects[i] += counts.rejects[i].lines;
  }
  [[nodiscard]] std::uint32_t rejected(Reject reason) const { return rejects[static_cast<std::size_t>(reason)]; }
};

std::string random_bytes(RandomRecords& random, std::string_view alphabet) {
  std::string bytes(random.below(400), '\0');
  for (char& c : bytes) {
    c = alphabet.empty() ? static_cast<char>(random.below(256)) : alphabet[random.below(alphabet.size())];
  }
  return bytes;
}

std::string good_log(RandomRecords& random) {
  std::string log;
  const std::size_t records = 1 + random.below(4);
  for (std::size_t i = 0; i < records; ++i) log += encoded(random.any());
  return log;
}

/// One deletion, insertion, overwriting, doubling or cut.
std::string damaged(std::string text, RandomRecords& random) {
  if (text.empty()) return text;
  static constexpr std::string_view kMeaningful = "$FP,*-+.0123456789\r\n%aEx \xFF";
  const std::size_t at = random.below(text.size());
  const char c =
      random.chance(4) ? static_cast<char>(random.below(256)) : kMeaningful[random.below(kMeaningful.size())];
  switch (random.below(5)) {
    case 0: text.erase(at, 1 + random.below(5)); break;
    case 1: text.insert(at, 1 + random.below(3), c); break;
    case 2: text[at] = c; break;
    case 3: text.insert(at, text.substr(at, random.below(100))); break;
    default: text.resize(at); break;
  }
  return text;
}

TEST(HostileBytes, NoiseIsCountedAndNothingElse) {
  RandomRecords random(10);
  Seen seen;
  for (int i = 0; i < 4'000; ++i) seen.add(check_stream_invariants(random_bytes(random, "")));
  for (int i = 0; i < 4'000; ++i)
    seen.add(check_stream_invariants("$FP" + random_bytes(random, "$FPODOFRM,*019.-\r\n")));
  EXPECT_EQ(seen.records, 0U);
  EXPECT_GT(seen.foreign, 1'000U);
  EXPECT_GT(seen.rejected(Reject::kCrc), 1'000U);
  EXPECT_GT(seen.rejected(Reject::kTruncated), 100U);
}

TEST(HostileBytes, DamagedLogsLoseDamagedLinesOnly) {
  RandomRecords random(11);
  Seen seen;
  for (int i = 0; i < 6'000; ++i) {
    // No text in these kinds, so a damaged line cannot pass for another one by chance of a few bits only.
    const std::string before = encoded(Header{}) + encoded(sensor::OdometrySample{{10'000}, {}, {}, {}});
    const std::string after = encoded(sensor::OdometrySample{{9'999'990'000}, {}, {}, {}});
    const Counts counts =
        check_stream_invariants(before + damaged(encoded(random.any(Kind::kAlert)), random) + "\r\n" + after);
    ASSERT_EQ(counts.records_of(Kind::kOdometry), 2U);
    ASSERT_EQ(counts.records_of(Kind::kHeader), 1U);
    seen.add(counts);
    seen.add(check_stream_invariants(damaged(good_log(random), random)));
  }
  EXPECT_GT(seen.records, 12'000U);
  EXPECT_GT(seen.rejected(Reject::kCrc), 1'000U);
}

/// With the CRC put right after the damage, the fields themselves are attacked.
TEST(HostileBytes, SealedDamageReachesEveryReason) {
  RandomRecords random(12);
  Seen seen;
  for (int i = 0; i < 6'000; ++i) {
    std::string log = encoded(random.any());
    const std::size_t lines = 1 + random.below(4);
    for (std::size_t line = 0; line < lines; ++line) {
      const std::string whole = encoded(random.any());
      std::string body = whole.substr(1, whole.find('*') - 1);
      for (std::size_t damage = random.below(3); damage > 0; --damage) body = damaged(body, random);
      if (random.chance(100)) body.insert(body.size() / 2, 1'000, '0');
      if (body.starts_with("FPHDR,1,") && random.chance(20)) body[6] = '2';  // one digit in a long line
      log += sealed(body) + "\r\n";
    }
    if (random.chance(4)) log.resize(random.below(log.size()));
    seen.add(check_stream_invariants(log));
  }
  for (std::uint8_t i = 0; i < kRejectReasons; ++i) {
    EXPECT_GT(seen.rejects[i], 0U) << name(static_cast<Reject>(i)) << " was never the reason";
  }
  EXPECT_GT(seen.records, 5'000U);
}

TEST(HostileBytes, TheFuzzersEntryRuns) {
  for (const std::string_view bytes : {std::string_view(""), std::string_view("$FPODO,1,2,3,4*\n\0\xFF", 18)}) {
    EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
  }
}

}  // namespace
}  // namespace fencepost::record
