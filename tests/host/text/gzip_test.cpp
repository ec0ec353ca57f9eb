#include "host/text/gzip.hpp"

#include <gtest/gtest.h>

#include "host/text/gunzip.hpp"

namespace fencepost::host {
namespace {

std::string numbers() {
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += std::to_string(i * 7919) + "\n";
  return text;
}

TEST(Gzip, IsUnpackedToTheSame) {
  for (const std::string& text : {std::string(), std::string("a"), numbers(), std::string(300'000, '\0')}) {
    const std::string packed = gzip(text);
    EXPECT_TRUE(is_gzip(packed));
    EXPECT_EQ(gunzip(packed), text);
  }
  EXPECT_LT(gzip(numbers()).size(), numbers().size() / 2);
}

TEST(Gzip, InPortionsIsTheSame) {
  Gzip packer;
  for (const char c : numbers().substr(0, 5'000)) packer.feed({&c, 1});
  packer.finish();
  EXPECT_EQ(packer.packed(), gzip(numbers().substr(0, 5'000)));
  EXPECT_EQ(packer.packed().substr(4, 4), std::string(4, '\0')) << "no time: the same log gives the same report";
}

// A hundred megabytes of zeros are 100 KB packed.
TEST(Gunzip, StopsBehindItsLimit) {
  const std::string packed = gzip(std::string(3'000'000, '\0'));
  const auto cut = gunzip(packed, 1'000'000);
  ASSERT_TRUE(cut);
  EXPECT_GT(cut->size(), 1'000'000U) << "there is more";
  EXPECT_LT(cut->size(), 1'100'000U);
  EXPECT_EQ(gunzip(packed, 3'000'000)->size(), 3'000'000U);
}

}  // namespace
}  // namespace fencepost::host
