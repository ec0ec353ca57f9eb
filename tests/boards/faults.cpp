#include "tests/boards/faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "tests/boards/bench.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

constexpr double kWithin = 1.0;        // s of the board's clock: good data to the next alert
constexpr double kWatchdog = 270'000;  // us; the shortest time after which one of the boards bites
constexpr double kSpeed = 0.16;        // m/s, towards a post whose front is a metre ahead
constexpr double kApproach = 4;        // s

/// A robot that has driven up to a post and creeps on: alerts come all the time.
class Approach {
 public:
  explicit Approach(const BoardUnderTest& board) : bench(board), stamped_(board.camera < 0) {}

  void begin() {
    ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
    ASSERT_TRUE(bench.await_camera()) << bench.said();
    SceneStream stream;
    stream.calibration = {line_of(level_pixy2()), line_of(record::Signature{1, {0xd0, 0x20, 0x20}, "red"})};
    ASSERT_TRUE(bench.start_log(stream)) << bench.said();
    drive(kApproach);
    ASSERT_NE(bench.said().find("$FPALR,"), std::string::npos) << bench.said();
  }

  /// 50 samples and 25 frames a second, which the slowest board keeps up with; `spoil(line)` may change or drop what is
  /// sent.
  void drive(double seconds, bool frames = true, bool odometry = true) {
    for (int i = 0; i < static_cast<int>(seconds * 50); ++i) {
      const double x = std::min(kSpeed * t_, kSpeed * kApproach + 0.002 * (t_ - kApproach));
      if (odometry) say(stamped_ ? line_of(desk_odometry(t_, x)) : unstamped(desk_odometry(t_, x)));
      if (frames && i % 2 == 0) bench.give(desk_frame(t_, number_++, x));
      t_ += 0.02;
      next_ += 0.02;
      do bench.pump();
      while (bench.seconds() - started_ < next_);
    }
  }
  /// The fault is over: what comes from now on is good.
  void expect_recovery() {
    bench.clear();
    drive(2.0);
    const std::string& said = bench.said();
    for (int i = 0; i < 5 && said.find("$FPSTA,") == std::string::npos; ++i) drive(1.0);
    const auto good = first_time(said, "$FPODO,");
    const auto alert = first_time(said, "$FPALR,");
    ASSERT_TRUE(good && alert) << said.substr(0, 2000);
    EXPECT_LT(*alert - *good, kWithin);
    EXPECT_EQ(said.find("READY"), std::string::npos) << "it was reset";
    EXPECT_LT(longest_turn(said), kWatchdog);
    EXPECT_TRUE(bench.alive());
  }
  /// The last record of its link, in a while.
  void expect_link(std::string_view sensor, std::string_view state) {
    for (int i = 0; i < 50 && bench.last_link(sensor) != state; ++i) bench.run(0.1);
    EXPECT_EQ(bench.last_link(sensor), state) << bench.said();
  }
  void expect_status(std::string_view text) { EXPECT_TRUE(bench.obey("status", text)) << bench.said(); }
  void restart_pace() { started_ = bench.seconds() - next_; }

  Bench bench;
  double cut_share = 0;  ///< of lines that lose their end

 private:
  void say(std::string line) {
    if (std::uniform_real_distribution<>(0, 1)(random_) < cut_share) line.resize(1 + random_() % (line.size() - 1));
    bench.console().send(line);
  }
  static std::optional<double> first_time(const std::string& said, std::string_view kind) {
    const std::size_t at = said.find(kind);
    if (at == std::string::npos) return std::nullopt;
    return std::stod(said.substr(at + kind.size(), 16));
  }
  // The last field of FPSTA, us since boot; a second passes between two of them.
  static double longest_turn(const std::string& said) {
    const std::size_t at = said.rfind("$FPSTA,");
    if (at == std::string::npos) return kWatchdog;
    const std::string line = said.substr(at, said.find('*', at) - at);
    return std::stod(line.substr(line.rfind(',') + 1));
  }

  bool stamped_;  ///< where frames come over the console with their times, odometry does, too
  std::mt19937 random_{1};
  double t_ = 0;
  std::uint32_t number_ = 0;
  double next_ = 0;
  double started_ = bench.seconds();
};

std::string garbage(std::size_t size) {
  std::mt19937 random(7);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

}  // namespace

// As fast as the emulator takes it, which is two or three times a line's pace.
void expect_takes_garbage(Bench& bench, std::vector<Line*> lines, std::size_t bytes) {
  for (Line* line : lines) {
    line->set_pace(2e6);
    line->send(garbage(bytes));
  }
  const auto unread = [&lines] {
    std::size_t sum = 0;
    for (const Line* line : lines) sum += line->waiting() + line->unread();
    return sum;
  };
  for (int i = 0; i < 120'000 && unread() > 0; ++i) bench.pump();
  EXPECT_EQ(unread(), 0U);
  for (Line* line : lines) line->set_pace(11'520);
  bench.console().send("\r");
  bench.run(0.3);
}

void expect_survives_camera_loss(const BoardUnderTest& board) {
  Approach robot(board);
  ASSERT_NO_FATAL_FAILURE(robot.begin());
  robot.bench.unplug_camera(true);
  robot.drive(4.0, board.camera >= 0);
  robot.expect_link("camera", "silent");
  robot.expect_status("camera link silent");
  robot.bench.unplug_camera(false);
  ASSERT_TRUE(robot.bench.await_camera());
  robot.restart_pace();
  robot.expect_recovery();
  robot.expect_link("camera", "ok");
  robot.expect_status("camera link ok");
}

void expect_survives_garbage(const BoardUnderTest& board, std::size_t bytes) {
  Approach robot(board);
  ASSERT_NO_FATAL_FAILURE(robot.begin());
  robot.bench.unplug_camera(true);
  std::vector<Line*> lines = {&robot.bench.console()};
  if (board.camera >= 0) lines.push_back(&robot.bench.camera_line());
  expect_takes_garbage(robot.bench, lines, bytes);
  robot.expect_status("odometry link silent");
  robot.bench.unplug_camera(false);
  ASSERT_TRUE(robot.bench.await_camera());
  robot.restart_pace();
  robot.expect_recovery();
}

void expect_survives_odometry_loss(const BoardUnderTest& board) {
  Approach robot(board);
  ASSERT_NO_FATAL_FAILURE(robot.begin());
  robot.drive(4.0, true, false);
  robot.expect_link("odometry", "silent");
  robot.expect_status("odometry link silent");
  robot.restart_pace();
  robot.expect_recovery();
  robot.expect_link("odometry", "ok");
  robot.expect_status("odometry link ok");
}

void expect_survives_blocked_console(const BoardUnderTest& board) {
  Approach robot(board);
  ASSERT_NO_FATAL_FAILURE(robot.begin());
  robot.bench.console().block(true);
  robot.drive(2.0);
  const std::size_t held = robot.bench.console().held();
  robot.drive(1.0);
  EXPECT_EQ(robot.bench.console().held(), held) << "it was not blocked at all";
  robot.bench.console().block(false);
  robot.bench.run(0.5);
  robot.restart_pace();
  robot.expect_recovery();
}

void expect_survives_cut_lines(const BoardUnderTest& board) {
  Approach robot(board);
  ASSERT_NO_FATAL_FAILURE(robot.begin());
  robot.cut_share = 0.3;
  robot.drive(3.0);
  EXPECT_NE(robot.bench.said().find("$FPALR,"), std::string::npos);  // it goes on meanwhile, too
  robot.cut_share = 0;
  robot.bench.console().send("\r\n");
  robot.expect_recovery();
}

void expect_survives_hung_camera_bus(const BoardUnderTest& board) {
  Bench bench(board);
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_TRUE(bench.await("camera is silent: ")) << bench.said();
  EXPECT_TRUE(bench.obey("selftest", "selftest pass")) << bench.said();
  EXPECT_TRUE(bench.obey("status", "camera link silent")) << bench.said();
  EXPECT_EQ(bench.said().find("READY"), std::string::npos) << "it was reset";
}

}  // namespace fencepost::test
