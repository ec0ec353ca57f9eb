#include "host/text/suggest.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

const std::vector<std::string> kWords = {"replay", "report", "record", "run"};

TEST(Suggest, CountsTypingErrors) {
  EXPECT_EQ(nearest_word("repaly", kWords), "replay") << "a swap is one error";
  EXPECT_EQ(nearest_word("reprt", kWords), "report");
  EXPECT_EQ(nearest_word("recrod", kWords), "record");
  EXPECT_EQ(nearest_word("rn", kWords), "run");
}

TEST(Suggest, TakesABeginning) { EXPECT_EQ(nearest_word("rec", kWords), "record"); }

TEST(Suggest, SaysNothingRatherThanNoise) {
  EXPECT_EQ(nearest_word("frobnicate", kWords), "");
  EXPECT_EQ(nearest_word("a", {"can"}), "") << "another letter, and one more";
  EXPECT_EQ(nearest_word("run", {}), "");
  EXPECT_EQ(did_you_mean("frobnicate", kWords), "");
  EXPECT_EQ(did_you_mean("repaly", kWords), " did you mean replay?");
}

}  // namespace
}  // namespace fencepost::host
