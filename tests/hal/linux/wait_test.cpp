#include "hal/linux/wait.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>

#include "hal/linux/descriptor.hpp"
#include "hal/linux/signal_flag.hpp"

namespace fencepost::linux {
namespace {

using base::milliseconds;

constexpr base::Duration kLong = milliseconds(60'000);

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    out = Descriptor(ends[0]);
    in = Descriptor(ends[1]);
  }
  Descriptor out;
  Descriptor in;
};

TEST(WaitSet, SleepsUntilItsDeadline) {
  const MonotonicClock clock;
  const Pipe pipe;
  WaitSet set;
  set.add_readable(pipe.out.get());
  const base::Time deadline = clock.now() + milliseconds(15);
  EXPECT_FALSE(set.wait_until(clock, deadline));
  EXPECT_GE(clock.now() + base::Duration{1}, deadline);
}

TEST(WaitSet, DoesNotSleepPastADeadlineThatWas) {
  const MonotonicClock clock;
  WaitSet set;
  EXPECT_FALSE(set.wait_until(clock, clock.now() - kLong));
  EXPECT_LT(clock.now(), base::Time{} + kLong);
}

TEST(WaitSet, WakesOnBytesOfAnyOne) {
  const MonotonicClock clock;
  const Pipe quiet;
  const Pipe loud;
  WaitSet set;
  set.add_readable(-1);  // an unplugged one
  set.add_readable(quiet.out.get());
  set.add_readable(loud.out.get());
  ASSERT_EQ(::write(loud.in.get(), "x", 1), 1);
  EXPECT_TRUE(set.wait_until(clock, clock.now() + kLong));
  EXPECT_LT(clock.now(), base::Time{} + kLong);
}

TEST(WaitSet, WakesWhenTheOtherEndGoes) {
  const MonotonicClock clock;
  Pipe pipe;
  pipe.in.close();
  WaitSet set;
  set.add_readable(pipe.out.get());
  EXPECT_TRUE(set.wait_until(clock, clock.now() + kLong));
}

TEST(WaitSet, WakesWhenThereIsRoomToWrite) {
  const MonotonicClock clock;
  const Pipe pipe;
  WaitSet set;
  set.add_writable(pipe.in.get());
  EXPECT_TRUE(set.wait_until(clock, clock.now() + kLong));
}

TEST(WaitSet, ForgetsWhatItWatched) {
  const MonotonicClock clock;
  const Pipe pipe;
  ASSERT_EQ(::write(pipe.in.get(), "x", 1), 1);
  WaitSet set;
  set.add_readable(pipe.out.get());
  set.clear();
  EXPECT_FALSE(set.wait_until(clock, clock.now()));
}

TEST(WaitSet, EndsOnASignal) {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  struct sigaction before {};
  ASSERT_EQ(::sigaction(SIGALRM, &action, &before), 0);
  // It repeats, in case the first one comes before the sleep.
  const itimerval every{{0, 10'000}, {0, 10'000}};
  ASSERT_EQ(::setitimer(ITIMER_REAL, &every, nullptr), 0);
  const MonotonicClock clock;
  const Pipe pipe;
  WaitSet set;
  set.add_readable(pipe.out.get());
  EXPECT_FALSE(set.wait_until(clock, clock.now() + kLong));
  EXPECT_LT(clock.now(), base::Time{} + kLong);
  const itimerval never{};
  ::setitimer(ITIMER_REAL, &never, nullptr);
  ::sigaction(SIGALRM, &before, nullptr);
}

TEST(SignalFlag, IsReadableWhileRaised) {
  const MonotonicClock clock;
  Opened<SignalFlag> flag = SignalFlag::open();
  ASSERT_TRUE(flag) << flag.problem();
  WaitSet set;
  set.add_readable(flag->descriptor());
  EXPECT_FALSE(set.wait_until(clock, clock.now()));
  flag->raise();
  flag->raise();
  EXPECT_TRUE(set.wait_until(clock, clock.now()));
  flag->clear();
  EXPECT_FALSE(set.wait_until(clock, clock.now()));
}

}  // namespace
}  // namespace fencepost::linux
