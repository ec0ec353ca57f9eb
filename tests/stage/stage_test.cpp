// On the stage itself: this program is started by it, and so is whatever it starts.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "tests/folder.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/process/child.hpp"

namespace fencepost::stage {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

steady_clock::duration duration_of(const std::function<void()>& what) {
  const auto before = steady_clock::now();
  what();
  return steady_clock::now() - before;
}

TEST(Stage, AnHourIsAnHourToTheNanosecond) {
  EXPECT_EQ(duration_of([] { std::this_thread::sleep_for(hours(1)); }), hours(1));
  EXPECT_EQ(duration_of([] { ::poll(nullptr, 0, 3'600'000); }), hours(1));
  timeval patience{3'600, 0};
  EXPECT_EQ(duration_of([&] { ::select(0, nullptr, nullptr, nullptr, &patience); }), hours(1));
  std::mutex mutex;
  std::condition_variable never;
  std::unique_lock lock(mutex);
  EXPECT_EQ(duration_of([&] { never.wait_for(lock, hours(1)); }), hours(1));
}

TEST(Stage, TimeStandsStillWhileAThreadWorks) {
  EXPECT_EQ(duration_of([] {
              for (std::atomic<int> i = 0; i < 10'000'000; ++i) {
              }
            }),
            milliseconds(0));
  std::atomic<bool> done = false;
  std::thread worker([&] {
    for (std::atomic<int> i = 0; i < 10'000'000; ++i) {
    }
    done = true;
  });
  std::this_thread::sleep_for(milliseconds(1));
  EXPECT_TRUE(done);
  worker.join();
}

TEST(Stage, AConditionComesBeforeItsDeadline) {
  std::mutex mutex;
  std::condition_variable changed;
  bool set = false;
  std::thread worker([&] {
    std::this_thread::sleep_for(milliseconds(7));
    const std::lock_guard lock(mutex);
    set = true;
    changed.notify_all();
  });
  std::unique_lock lock(mutex);
  EXPECT_EQ(duration_of([&] { changed.wait_for(lock, hours(1), [&] { return set; }); }), milliseconds(7));
  worker.join();
}

// The system brings them to the other end a little later; the clock waits for them.
TEST(Stage, BytesOnAPtyTakeNoTime) {
  constexpr int kBytes = 1'000;
  const test::Folder folder;
  const linux::FarEnd far(folder.file("port"));
  const linux::Descriptor near(::open(folder.file("port").c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK));
  const auto pass_on = [](int from, int to) {
    pollfd wait{from, POLLIN, 0};
    char byte = 0;
    const bool came = ::poll(&wait, 1, 1) == 1 && ::read(from, &byte, 1) == 1;
    return came && ::write(to, &byte, 1) == 1;
  };
  termios line{};
  ::tcgetattr(near.get(), &line);
  ::cfmakeraw(&line);
  ::tcsetattr(near.get(), TCSANOW, &line);
  std::thread echo([&] {
    for (int i = 0; i < kBytes; ++i) EXPECT_TRUE(pass_on(near.get(), near.get())) << i;
  });
  EXPECT_EQ(duration_of([&] {
              ASSERT_EQ(::write(far.descriptor(), "x", 1), 1);
              for (int i = 1; i < kBytes; ++i) ASSERT_TRUE(pass_on(far.descriptor(), far.descriptor())) << i;
            }),
            milliseconds(0));
  echo.join();
}

TEST(Stage, ProgramsShareItsClock) {
  test::Child child("sh", {"sh", "-c", "sleep 2; (sleep 3) & sleep 1; wait"});
  EXPECT_EQ(duration_of([&] { child.wait(); }), milliseconds(5'000));
}

// A child has its number before it is in its parent's list.
TEST(Stage, TimeStandsStillWhileAChildBegins) {
  constexpr int kChildren = 300;
  int late = 0;
  for (int i = 0; i < kChildren; ++i) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      for (std::atomic<int> turn = 0; turn < 30'000; ++turn) {
      }
      ::_exit(::write(ends[1], "x", 1) == 1 ? 0 : 1);
    }
    std::this_thread::sleep_for(milliseconds(1));
    pollfd told{ends[0], POLLIN, 0};
    late += ::poll(&told, 1, 0) == 1 ? 0 : 1;
    ::waitpid(child, nullptr, 0);
    ::close(ends[0]);
    ::close(ends[1]);
  }
  EXPECT_EQ(late, 0) << "children still worked when the clock went on";
}

TEST(Stage, AStoppedProgramHoldsNobodyUp) {
  test::Child child("sleep", {"sleep", "10"});
  std::this_thread::sleep_for(milliseconds(1'000));
  child.signal(SIGSTOP);
  std::this_thread::sleep_for(milliseconds(20'000));
  EXPECT_FALSE(child.ended());
  child.signal(SIGCONT);
  EXPECT_EQ(duration_of([&] { child.wait(); }), milliseconds(0));
}

TEST(Stage, EndsAsItsProgramDoes) {
  test::Child child(FENCEPOST_STAGE, {"stage", "sh", "-c", "sleep 100; exit 7"});
  child.wait();
  EXPECT_EQ(child.exit_code(), 7);
}

}  // namespace
}  // namespace fencepost::stage
