#include "drivers/create/stream_decoder.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "tests/drivers/hex.hpp"

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

TEST(CreateStream, HeadersInTheDataMisleadNobody) {
  // Both counts are 0x1313, then 0x1306: 13 + 06 + 2B + 13 + 13 + 2C + 13 + 06 = AF, and 51 make 100.
  EXPECT_EQ(found(test::hex_text("13 13 06 13 06 2B 13 13 2C 13 06 51"), kEncoders), Found{"4883 4870 @3"});
}

TEST(CreateStream, OnlyWhatWasAskedFor) {
  EXPECT_TRUE(found(test::hex_text("13 05 1D 02 19 0D 00 B6"), kEncoders).empty());
  EXPECT_TRUE(found(test::hex_text("13 06 2C 03 E8 2B FF DC DD"), kEncoders).empty()) << "the other order";
}

}  // namespace
}  // namespace fencepost::create
