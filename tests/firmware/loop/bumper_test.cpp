// When a board's own motors go ahead, and what ends it.
#include "firmware/loop/bumper.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace fencepost::loop {
namespace {

constexpr base::Time at_ms(std::int64_t ms) { return base::Time{} + base::milliseconds(ms); }
// Metres and degrees.
recon::MapPose at(double x, double y = 0, double heading = 0) {
  return {{static_cast<std::int32_t>(x * 1e5), static_cast<std::int32_t>(y * 1e5)},
          static_cast<std::int32_t>(heading * 17'453.3)};
}

struct GoingBumper : ::testing::Test {
  Bumper bumper;
  void SetUp() override { ASSERT_TRUE(bumper.judge(true, true, at(0), at_ms(0))); }
};

TEST(Bumper, NeedsWishPermitAndOdometry) {
  Bumper bumper;
  EXPECT_FALSE(bumper.judge(false, true, at(0), at_ms(0)));
  EXPECT_FALSE(bumper.judge(true, false, at(0), at_ms(0)));
  EXPECT_FALSE(bumper.judge(true, true, std::nullopt, at_ms(0)));
  EXPECT_FALSE(bumper.take_standstill()) << "it never went";
  EXPECT_TRUE(bumper.judge(true, true, at(0), at_ms(0)));
}

TEST_F(GoingBumper, StandsAtAnAlertAndSaysSoOnce) {
  EXPECT_TRUE(bumper.judge(true, true, at(0.01), at_ms(100)));
  EXPECT_FALSE(bumper.judge(true, false, at(0.02), at_ms(105)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kAlert);
  EXPECT_FALSE(bumper.take_standstill());
}

TEST_F(GoingBumper, StandsWhenTheWishIsWithdrawn) {
  EXPECT_FALSE(bumper.judge(false, true, at(0), at_ms(5)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kLine);
}

TEST_F(GoingBumper, StandsForAReasonOfItsOwnersAndSaysSoOnce) {
  bumper.stand(Standstill::kPort);
  EXPECT_FALSE(bumper.judge(false, true, at(0), at_ms(5)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kPort);
  bumper.stand(Standstill::kPort);
  EXPECT_FALSE(bumper.take_standstill()) << "it stood already";
}

TEST_F(GoingBumper, StandsWhenOdometryIsForgotten) {
  EXPECT_FALSE(bumper.judge(true, true, std::nullopt, at_ms(5)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kAlert);
}

TEST_F(GoingBumper, StandsAfterASecondWithoutWay) {
  EXPECT_TRUE(bumper.judge(true, true, at(0.004), at_ms(900))) << "not 5 mm yet";
  EXPECT_TRUE(bumper.judge(true, true, at(0.006), at_ms(990)));
  EXPECT_TRUE(bumper.judge(true, true, at(0.009), at_ms(1'990)));
  EXPECT_FALSE(bumper.judge(true, true, at(0.009), at_ms(1'995)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kBlocked);
}

TEST_F(GoingBumper, StandsWhenItTurnsOrGoesBackwards) {
  EXPECT_TRUE(bumper.judge(true, true, at(0.01, 0, 44), at_ms(100)));
  EXPECT_TRUE(bumper.judge(true, true, recon::MapPose{{1'000, 0}, 785'000}, at_ms(102)));
  EXPECT_TRUE(bumper.judge(true, true, recon::MapPose{{1'000, 0}, -785'000}, at_ms(104)));
  EXPECT_FALSE(bumper.judge(true, true, recon::MapPose{{1'000, 0}, -785'001}, at_ms(105)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kTurned);
  EXPECT_TRUE(bumper.judge(true, true, at(1, 1, 90), at_ms(200)));
  EXPECT_TRUE(bumper.judge(true, true, at(1, 0.98, 90), at_ms(300))) << "a gear's play";
  EXPECT_FALSE(bumper.judge(true, true, at(1, 0.96, 90), at_ms(400)));
  EXPECT_EQ(bumper.take_standstill(), Standstill::kBackwards);
}

TEST(Bumper, EveryReasonIsSaid) {
  for (const Standstill one :
       {Standstill::kAlert, Standstill::kLine, Standstill::kBlocked, Standstill::kTurned, Standstill::kBackwards})
    EXPECT_FALSE(reason(one).empty());
}

}  // namespace
}  // namespace fencepost::loop
