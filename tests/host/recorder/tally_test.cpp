#include "host/recorder/tally.hpp"

#include <gtest/gtest.h>

#include "tests/host/recorder/stream.hpp"

namespace fencepost::host {
namespace {

using testing::frame_line;

constexpr base::Time moment(double seconds) { return base::Time::nearest(seconds); }

TEST(Tally, CountsAsReplayDoes) {
  Tally tally(moment(0));
  std::string bad = frame_line(1, 1);
  bad[8] = '9';
  tally.take(frame_line(0.5, 0) + bad + "hello\n\xff\n" + frame_line(2, 4), moment(3));
  tally.take("$FPFRM,3.0", moment(4));
  EXPECT_EQ(tally.lines(), 5U);
  EXPECT_EQ(tally.last_line(), moment(3));
  tally.finish();
  EXPECT_EQ(tally.counts().records_of(record::Kind::kFrame), 2U);
  EXPECT_EQ(tally.counts().foreign, 2U);
  EXPECT_EQ(tally.counts().rejected(record::Reject::kCrc).lines, 1U);
  EXPECT_EQ(tally.counts().rejected(record::Reject::kTruncated).lines, 1U);
  EXPECT_EQ(tally.losses().frames_missing(), 3U);  // 1 was damaged, 2 and 3 did not come
}

TEST(Tally, RatesAreOfTheTimeSinceTheLastMeasurement) {
  Tally tally(moment(0));
  tally.take("one\ntwo\n", moment(0.1));
  tally.measure(moment(2));
  EXPECT_DOUBLE_EQ(tally.rates().lines, 1);
  EXPECT_DOUBLE_EQ(tally.rates().bytes, 4);
  tally.take("three\n", moment(2.1));
  tally.measure(moment(2.5));
  EXPECT_DOUBLE_EQ(tally.rates().lines, 2);
  EXPECT_DOUBLE_EQ(tally.rates().bytes, 12);
  tally.measure(moment(2.5));
  EXPECT_DOUBLE_EQ(tally.rates().lines, 2);
}

}  // namespace
}  // namespace fencepost::host
