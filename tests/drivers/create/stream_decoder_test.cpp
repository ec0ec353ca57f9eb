#include "drivers/create/stream_decoder.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "tests/drivers/hex.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fencepost::create {
namespace {

StreamLayout layout(std::initializer_list<StreamField> fields) {
  StreamLayout layout;
  for (const StreamField& field : fields) (void)layout.push_back(field);
  return layout;
}

const StreamLayout kEncoders = layout({{43, 2}, {44, 2}});

/// The values of each frame found, and where it began: "1000 65500 @0". Byte i arrives at i.
std::vector<std::string> found(std::string_view bytes, StreamDecoder& decoder, std::size_t fields) {
  std::vector<std::string> frames;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (!decoder.feed(test::octet(bytes[i]), {static_cast<std::int64_t>(i)})) continue;
    std::string frame;
    for (std::size_t f = 0; f < fields; ++f) frame += std::to_string(decoder.value(f)) + " ";
    frames.push_back(frame + "@" + std::to_string(decoder.t().raw));
  }
  return frames;
}
std::vector<std::string> found(std::string_view bytes, const StreamLayout& layout) {
  StreamDecoder decoder(layout);
  return found(bytes, decoder, layout.size());
}

using Found = std::vector<std::string>;

// The worked examples, under both rules.
TEST(CreateStream, WorkedExamples) {
  const StreamLayout cliff_and_wall = layout({{29, 2}, {13, 1}});
  for (const std::string_view sum : {"B6", "A3"}) {
    EXPECT_EQ(found(test::hex_text("13 05 1D 02 19 0D 00 " + std::string(sum)), cliff_and_wall), Found{"537 0 @0"})
        << sum;
  }
  for (const std::string_view sum : {"DD", "CA"}) {
    EXPECT_EQ(found(test::hex_text("13 06 2B 03 E8 2C FF DC " + std::string(sum)), kEncoders), Found{"1000 65500 @0"})
        << sum;
  }
  for (const std::string_view sum : {"BE", "AB"}) {
    EXPECT_EQ(found(test::hex_text("13 06 13 00 19 14 FF FD " + std::string(sum)), layout({{19, 2}, {20, 2}})),
              Found{"25 65533 @0"})
        << sum;
  }
}

const std::string kWithout = test::hex_text("13 06 2B 03 E8 2C FF DC DD");
const std::string kWith = test::hex_text("13 06 2B 03 E8 2C FF DC CA");

TEST(CreateStream, RemembersTheRuleOnceItHasMatchedTwice) {
  StreamDecoder decoder(kEncoders);
  EXPECT_EQ(decoder.rule(), ChecksumRule::kUnknown);
  EXPECT_EQ(found(kWithout, decoder, 2).size(), 1U);
  EXPECT_EQ(decoder.rule(), ChecksumRule::kUnknown);
  EXPECT_EQ(found(kWith, decoder, 2).size(), 1U) << "still open";
  EXPECT_EQ(found(kWith, decoder, 2).size(), 1U);
  EXPECT_EQ(decoder.rule(), ChecksumRule::kWithHeader);
  EXPECT_EQ(found(kWithout + kWithout, decoder, 2).size(), 0U);
  EXPECT_EQ(decoder.bad_checksums(), 2U);
  EXPECT_EQ(found(kWith, decoder, 2).size(), 1U);
  decoder.forget_rule();
  EXPECT_EQ(found(kWithout + kWithout, decoder, 2).size(), 2U);
  EXPECT_EQ(decoder.rule(), ChecksumRule::kWithoutHeader);
}

TEST(CreateStream, CutInAtAnyByteTheNextFrameIsFound) {
  for (std::size_t cut = 1; cut <= kWith.size(); ++cut) {
    EXPECT_EQ(found(kWith.substr(cut) + kWith, kEncoders), Found{"1000 65500 @" + std::to_string(kWith.size() - cut)});
    EXPECT_EQ(found(kWith.substr(0, cut - 1) + kWith, kEncoders), Found{"1000 65500 @" + std::to_string(cut - 1)});
  }
}

TEST(CreateStream, OneDamagedByteCostsItsFrameAndNoOther) {
  for (std::size_t at = 0; at < kWith.size(); ++at) {
    for (int flip = 1; flip < 256; ++flip) {
      std::string bytes = kWith + kWith + kWith + kWith;
      const std::size_t damaged = 2 * kWith.size() + at;
      bytes[damaged] = static_cast<char>(bytes[damaged] ^ flip);
      EXPECT_EQ(found(bytes, kEncoders).size(), 3U) << at << ' ' << flip;
    }
  }
}

TEST(CreateStream, HeadersInTheDataMisleadNobody) {
  // Both counts are 0x1313, then 0x1306: 13 + 06 + 2B + 13 + 13 + 2C + 13 + 06 = AF, and 51 make 100.
  EXPECT_EQ(found(test::hex_text("13 13 06 13 06 2B 13 13 2C 13 06 51"), kEncoders), Found{"4883 4870 @3"});
}

TEST(CreateStream, OnlyWhatWasAskedFor) {
  EXPECT_TRUE(found(test::hex_text("13 05 1D 02 19 0D 00 B6"), kEncoders).empty());
  EXPECT_TRUE(found(test::hex_text("13 06 2C 03 E8 2B FF DC DD"), kEncoders).empty()) << "the other order";
}

TEST(CreateStream, TheFuzzersEntryRuns) {
  std::uint32_t state = 9;
  for (int round = 0; round < 2'000; ++round) {
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < 200; ++i) {
      state = state * 1'664'525 + 1'013'904'223;
      constexpr std::string_view kMeaningful = "\x13\x06\x2B\x2C";
      const std::uint32_t r = state >> 16;
      bytes.push_back(r % 2 == 0 ? test::octet(kMeaningful[r / 2 % kMeaningful.size()])
                                 : static_cast<std::uint8_t>(r / 2));
    }
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

}  // namespace
}  // namespace fencepost::create
