// Whatever a robot had to refuse or drop, the log that it wrote is the whole truth. Robots have random profiles,
// buffers, names, rates, blobs, links, console modes and commands. Each log replays to the robot's digest, refusing
// nothing.
#include <gtest/gtest.h>

#include <random>

#include "host/replay/replay.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::Mode;

/// A profile with other buffers: what the log may hold must not depend on them.
template <class Base, std::size_t kOutput, std::size_t kJournal>
struct Buffered : Base {
  static constexpr std::size_t kOutputBytes = kOutput;
  static constexpr std::size_t kJournalBytes = kJournal;
};

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  /// From low to high, both included.
  std::int64_t from(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(int n) { return from(1, n) == 1; }
  template <std::size_t N, class T>
  T of(const T (&choices)[N]) {
    return choices[from(0, static_cast<std::int64_t>(N) - 1)];
  }

 private:
  std::mt19937 engine_;
};

sensor::Text random_name(Dice& dice) {
  constexpr std::string_view kCharacters[] = {"a", "\xc3\xa4", ",",
                                              "*"};  // the latter take three bytes each in a record
  const std::string_view character = dice.of(kCharacters);
  std::string name;
  const std::size_t size = dice.one_in(2) ? sensor::kMaxText : static_cast<std::size_t>(dice.from(0, 8));
  while (name.size() + character.size() <= size) name += character;
  return sensor::Text(std::string_view(name));
}

/// Boxes beside each other, growing as the robot comes nearer.
sensor::BlobFrame random_frame(Dice& dice, double t, std::uint32_t number, std::int64_t most, std::int64_t signatures) {
  sensor::BlobFrame frame{base::Time::nearest(t), number, {}};
  const std::int64_t count = dice.from(most / 2, most);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t left = 18 * i + dice.from(0, 2);
    const std::int64_t foot = 120 + 4 * i + static_cast<std::int64_t>(t) + dice.from(0, 1);
    sensor::Blob blob;
    blob.signature = static_cast<std::uint8_t>(1 + i % signatures);
    blob.x1 = static_cast<std::int16_t>(left);
    blob.x2 = static_cast<std::int16_t>(left + 12);
    blob.y1 = 90;
    blob.y2 = static_cast<std::int16_t>(foot);
    blob.cx = base::Pixels1{static_cast<std::int32_t>(10 * left + 60)};
    blob.cy = base::Pixels1{static_cast<std::int32_t>(5 * (90 + foot))};
    blob.pixels = 12 * static_cast<std::uint32_t>(foot - 90);
    static_cast<void>(frame.blobs.push_back(blob));
  }
  return frame;
}

struct Plan {
  Mode mode = Mode::kLog;
  std::size_t link_bytes = 0;  ///< a turn of a millisecond
  bool commands = false;
  Script script;
  std::vector<record::Signature> signatures;
};

Plan random_plan(Dice& dice, bool journal, std::size_t capacity) {
  constexpr Mode kModes[] = {Mode::kQuiet, Mode::kText, Mode::kPlot, Mode::kLog};
  constexpr std::size_t kLinks[] = {2, 12, 100, 5'000, 1'000'000};
  Plan plan;
  plan.mode = journal ? dice.of(kModes) : Mode::kLog;
  plan.link_bytes = dice.of(kLinks);
  plan.commands = dice.one_in(3);
  const std::int64_t known = dice.from(1, static_cast<std::int64_t>(std::min<std::size_t>(capacity, 8)));
  for (std::int64_t i = 1; i <= known; ++i) {
    plan.signatures.push_back({static_cast<std::uint8_t>(i), {0xd0, 0x20, 0x20}, random_name(dice)});
  }
  const double seconds = dice.one_in(2) ? 23 : 12;  // the calibration is repeated every 10 s
  const auto odometry_rate = static_cast<double>(dice.from(5, 60));
  const auto frame_rate = static_cast<double>(dice.from(5, 60));
  constexpr std::int64_t kMax = sensor::kMaxBlobs;
  const std::int64_t blobs = dice.one_in(2) ? dice.from(11, kMax) : dice.from(0, kMax);
  for (double t = 0; t < seconds; t += 1 / odometry_rate) {
    plan.script.odometry.push_back({base::Time::nearest(t), desk_odometry(t, 0.03 * t)});
  }
  std::uint32_t number = 0;
  for (double t = 0.1; t < seconds; t += 1 / frame_rate) {
    plan.script.camera.push_back({base::Time::nearest(t), random_frame(dice, t, number++, blobs, known)});
  }
  return plan;
}

/// The log that the robot wrote, and its state at the end.
struct Driven {
  std::string log;
  std::uint64_t digest = 0;
  std::uint32_t frames = 0;
};

template <class Profile>
Driven drive(Dice& dice, const Plan& plan) {
  constexpr const char* kCommands[] = {"status",
                                       "help",
                                       "get",
                                       "set alert.stop 0.3",
                                       "set confirm.k 2",
                                       "map",
                                       "objects",
                                       "reset",
                                       "set confirm.k 3",
                                       "selftest",
                                       "version",
                                       "no such command",
                                       "$FPSIG,1,d02020,x",
                                       "set alert.rate 9"};
  constexpr bool kJournal = Profile::kJournalBytes > 0;
  Desk<Profile> desk(plan.mode, plan.script);
  desk.link.bytes_a_turn = plan.link_bytes;
  if constexpr (kJournal) desk.memory().journal.start();
  for (const record::Signature& signature : plan.signatures) desk.pipeline().set_signature(signature);
  Driven driven;
  const auto turn = [&] {
    desk.turn();
    if constexpr (kJournal) {
      const std::span<const char> lines = desk.memory().journal.waiting();
      driven.log.append(lines.begin(), lines.end());
      desk.memory().journal.taken(lines.size());
    }
  };
  const auto turns = plan.script.odometry.back().at.raw / 10 + 1'000;
  for (std::int64_t i = 0; i < turns; ++i) {
    if (plan.commands && dice.one_in(700)) desk.link.type(std::string(dice.of(kCommands)) + "\r");
    turn();
  }
  desk.link.bytes_a_turn = 1'000'000;                                                // the rest of what waits
  for (int i = 0; i < 200 || (desk.pipeline().testing() && i < 1'000); ++i) turn();  // a self-test ends, too
  if constexpr (!kJournal) driven.log = desk.link.take_said();
  driven.digest = desk.memory().map.digest();
  driven.frames = desk.memory().counters.frames;
  return driven;
}

std::uint64_t lines_of(std::string_view log, std::string_view kind) {
  std::uint64_t count = 0;
  for (std::size_t at = log.find(kind); at != std::string_view::npos; at = log.find(kind, at + 1)) ++count;
  return count;
}

template <class Profile>
class AnyLog : public testing::Test {};

using Robots = testing::Types<
    Buffered<config::Micro, 1024, 0>, Buffered<config::Micro, 1024, 256 * 1024>, Buffered<config::Micro, 2048, 4096>,
    Buffered<config::Small, 4096, 0>, Buffered<config::Small, 1024, 0>, Buffered<config::Small, 4096, 256 * 1024>,
    Buffered<config::Full, 16384, 0>, Buffered<config::Full, 1024, 0>, Buffered<config::Full, 16384, 256 * 1024>>;
TYPED_TEST_SUITE(AnyLog, Robots);

TYPED_TEST(AnyLog, ReplaysToTheDigestOfTheRobotAndRefusesNothing) {
  constexpr std::uint32_t kRobots = TypeParam::kObjects > 8 ? 8 : 24;  // the largest table takes the most time
  std::uint64_t compared = 0;
  std::uint64_t frames = 0;
  for (std::uint32_t seed = 1; seed <= kRobots; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const Plan plan = random_plan(dice, TypeParam::kJournalBytes > 0, TypeParam::kSignatures);
    const Driven driven = drive<TypeParam>(dice, plan);
    if (driven.frames == 0) continue;  // nothing came through the link

    host::ReplayOptions options;
    options.check = true;
    const host::ReplayOutcome outcome = host::replay(driven.log, "any.log", options);
    ASSERT_FALSE(outcome.unreadable.has_value()) << outcome.unreadable->message;
    EXPECT_EQ(outcome.result.digest, driven.digest);
    EXPECT_EQ(outcome.result.log.refused.queue, 0U);
    EXPECT_EQ(outcome.check.differing, 0U) << outcome.check.mismatches[0];
    EXPECT_EQ(outcome.result.log.frames, lines_of(driven.log, "$FPFRM,"));
    compared += outcome.check.compared;
    frames += driven.frames;
  }
  EXPECT_GT(compared, 500U);
  EXPECT_GT(frames, 500U);
}

}  // namespace
}  // namespace fencepost::test
