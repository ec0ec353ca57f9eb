// Bytes between an interrupt and the loop.
#include "hal/mcu/rings.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace fencepost::mcu {
namespace {

TEST(ByteRing, KeepsOrderWhileItsIndicesWrap) {
  ByteRing<8> ring;
  std::uint8_t out = 0;
  EXPECT_FALSE(ring.get(out));
  std::uint32_t written = 0;
  std::uint32_t read = 0;
  while (read < 200'000) {  // 2^16 thrice
    for (std::uint32_t i = 0; i < 1 + written % 8; ++i)
      written += ring.put(static_cast<std::uint8_t>(written)) ? 1U : 0U;
    EXPECT_EQ(ring.size(), written - read);
    for (std::uint32_t i = 0; i < 1 + read % 5 && ring.get(out); ++i) {
      ASSERT_EQ(out, static_cast<std::uint8_t>(read));
      ++read;
    }
  }
}

TEST(ByteRing, FullRefusesAndKeepsWhatItHas) {
  ByteRing<2> ring;
  EXPECT_TRUE(ring.put(1) && ring.put(2));
  EXPECT_FALSE(ring.put(3));
  std::uint8_t out = 0;
  EXPECT_TRUE(ring.get(out) && out == 1);
  EXPECT_TRUE(ring.put(4));
  EXPECT_TRUE(ring.get(out) && out == 2);
  EXPECT_TRUE(ring.get(out) && out == 4);
  EXPECT_TRUE(ring.empty());
}

TEST(Rings, TellALossOnceAndThenWhatTheyHave) {
  Rings<4, 4> rings;
  std::vector<std::uint8_t> bytes(8);
  EXPECT_EQ(rings.read(bytes).error(), base::Error::kNotReady);
  for (std::uint8_t byte = 0; byte < 6; ++byte) rings.received(byte);
  EXPECT_TRUE(rings.waiting());
  EXPECT_EQ(rings.read(bytes).error(), base::Error::kBadInput);
  ASSERT_EQ(rings.read(bytes).value(), 4U);
  EXPECT_EQ(bytes[3], 3);
  EXPECT_FALSE(rings.waiting());
  EXPECT_EQ(rings.read(bytes).error(), base::Error::kNotReady);
}

TEST(Rings, TakeWhatFits) {
  Rings<4, 4> rings;
  const std::vector<std::uint8_t> bytes = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(rings.write(bytes).value(), 4U);
  EXPECT_EQ(rings.write(bytes).error(), base::Error::kFull);
  std::uint8_t out = 0;
  EXPECT_TRUE(rings.next(out) && out == 1);
  EXPECT_EQ(rings.write(bytes).value(), 1U);
  EXPECT_EQ(rings.write({}).value(), 0U);
}

}  // namespace
}  // namespace fencepost::mcu
