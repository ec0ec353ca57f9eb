#include "firmware/loop/pipeline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "firmware/loop/loop.hpp"
#include "firmware/record/stream_reader.hpp"
#include "hal/fake/scripted_source.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using base::Metres;
using base::Time;
using console::Mode;
using console::Refusal;

template <class Profile = config::Small>
struct Bench {
  explicit Bench(Mode mode = Mode::kQuiet) : pipeline(*memory, mode) {
    pipeline.start_run(header);
    pipeline.set_camera(level_pixy2());
  }
  int place() {
    int placed = 0;
    while (pipeline.place_next_frame()) ++placed;
    return placed;
  }
  std::uint32_t refused(Refusal reason) { return memory->counters.refused[static_cast<std::size_t>(reason)]; }
  std::string output() {
    const auto bytes = memory->output.waiting();
    std::string text(bytes.data(), bytes.size());
    memory->output.taken(text.size());
    return text;
  }

  record::Header header{1, "fencepost", "0.0.0", "test", Profile::kName};
  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline;
};

TEST(Pipeline, AFrameWaitsForTheOdometryAtItsExposure) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.07, 1));  // exposed at 1.02
  EXPECT_EQ(bench.place(), 0);
  bench.pipeline.accept(desk_odometry(1.0199));
  EXPECT_EQ(bench.place(), 0);
  bench.pipeline.accept(desk_odometry(1.02));
  EXPECT_EQ(bench.place(), 1);
  EXPECT_EQ(bench.memory->counters.frames, 1U);
}

TEST(Pipeline, SaysWhetherTheLatestInputWasUsed) {
  Bench bench;
  loop::Pipeline<config::Small>& pipeline = bench.pipeline;
  EXPECT_FALSE(pipeline.accept(desk_odometry(1.0)));
  EXPECT_TRUE(pipeline.used_input());
  EXPECT_EQ(pipeline.accept(desk_odometry(1.0)), record::Reject::kTime);
  EXPECT_FALSE(pipeline.used_input());
  EXPECT_FALSE(pipeline.accept(desk_frame(1.05, 1)));
  EXPECT_TRUE(pipeline.used_input());
  EXPECT_EQ(pipeline.accept(desk_frame(1.05, 2)), record::Reject::kTime);
  EXPECT_FALSE(pipeline.used_input());
  EXPECT_FALSE(pipeline.accept(desk_frame(1.06, 3)));
  EXPECT_TRUE(pipeline.used_input());
  sensor::BlobFrame outside = desk_frame(1.07, 4);
  outside.blobs[0].x2 = 316;
  EXPECT_EQ(pipeline.accept(outside), record::Reject::kRange);
  EXPECT_FALSE(pipeline.used_input());
  EXPECT_FALSE(pipeline.accept(desk_frame(1.08, 5)));
  EXPECT_EQ(pipeline.accept(desk_odometry(1.1, 2'000)), record::Reject::kRange);
  EXPECT_FALSE(pipeline.used_input());
}

// Stream time is behind the robot's clock by a lag. A smaller lag is believed at once. It grows by at most 10 ms an
// input, and only by an input that is the newest.
TEST(Pipeline, StreamTimeFollowsTheClockSlowly) {
  Bench bench;
  loop::Pipeline<config::Small>& pipeline = bench.pipeline;
  const auto behind = [&](std::int64_t now) {
    pipeline.set_clock(Time{now});
    return bench.memory->run.behind->raw;
  };
  EXPECT_FALSE(pipeline.has_clock());
  pipeline.accept(desk_odometry(1.0));
  EXPECT_EQ(behind(20'000), 10'000);
  EXPECT_TRUE(pipeline.has_clock());
  pipeline.accept(desk_odometry(1.1));
  EXPECT_EQ(behind(20'900), 9'900);
  pipeline.accept(desk_odometry(1.2));
  EXPECT_EQ(behind(21'950), 9'950) << "by less than 10 ms";
  pipeline.accept(desk_odometry(1.3));
  EXPECT_EQ(behind(30'000), 10'050);
  pipeline.accept(desk_frame(1.25, 1));
  EXPECT_EQ(behind(30'000), 10'050) << "it was late";
  EXPECT_EQ(behind(22'000), 9'000) << "less is believed of any";
}

TEST(Pipeline, AFrameWaitsAtMost200msOfStreamTime) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.07, 1));
  bench.pipeline.accept(desk_frame(1.2699, 2));
  EXPECT_EQ(bench.place(), 0);
  bench.pipeline.accept(desk_frame(1.27, 3));
  EXPECT_EQ(bench.place(), 1);  // the first is given up
  EXPECT_EQ(bench.refused(Refusal::kNoPose), 1U);
  EXPECT_EQ(bench.memory->waiting.size(), 2U);
}

TEST(Pipeline, AtMostFourFramesWait) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  for (int i = 0; i < 5; ++i) bench.pipeline.accept(desk_frame(1.06 + 0.01 * i, static_cast<std::uint32_t>(i)));
  EXPECT_EQ(bench.memory->waiting.size(), 4U);
  EXPECT_EQ(bench.refused(Refusal::kNoPose), 1U);
  bench.pipeline.accept(desk_odometry(1.10));
  EXPECT_EQ(bench.place(), 4);
}

TEST(Pipeline, FramesBeforeTheFirstOdometryAndInGapsAreRefused) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.04, 1));  // exposed at 0.99
  EXPECT_EQ(bench.place(), 1);
  EXPECT_EQ(bench.refused(Refusal::kNoPose), 1U);
  bench.pipeline.accept(desk_frame(1.85, 2));
  bench.pipeline.accept(desk_odometry(2.00));
  EXPECT_EQ(bench.place(), 1);
  EXPECT_EQ(bench.refused(Refusal::kOdometryGap), 1U);
  EXPECT_EQ(bench.memory->counters.frames, 0U);
}

TEST(Pipeline, WithoutCalibrationFramesAreRefused) {
  Bench bench;
  bench.pipeline.start_run(bench.header);
  bench.pipeline.accept(desk_odometry(1.0));
  bench.pipeline.accept(desk_frame(1.1, 1));
  EXPECT_EQ(bench.refused(Refusal::kNoCamera), 1U);
  EXPECT_EQ(bench.pipeline.stream_time(), Time::nearest(1.1)) << "time goes on";
  EXPECT_EQ(bench.pipeline.accept(desk_frame(1.1, 2)), record::Reject::kTime);
}

TEST(Pipeline, ACalibrationAppliesToTheFramesAfterIt) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.06, 1));  // latency 0.05: exposed at 1.01
  bench.pipeline.set_camera(level_pixy2(0.02));
  bench.pipeline.accept(desk_frame(1.07, 2));  // latency 0.02: exposed at 1.05
  bench.pipeline.accept(desk_odometry(1.02));
  EXPECT_EQ(bench.place(), 1);
  bench.pipeline.accept(desk_odometry(1.05));
  EXPECT_EQ(bench.place(), 1);
  // Only the calibrations in use are kept, two at a time. What a third one displaces is refused, not misread.
  bench.pipeline.accept(desk_frame(1.20, 3));
  bench.pipeline.set_camera(level_pixy2(0.03));
  bench.pipeline.set_camera(level_pixy2(0.04));
  EXPECT_EQ(bench.memory->waiting.size(), 1U);
  bench.pipeline.accept(desk_frame(1.21, 4));
  bench.pipeline.set_camera(level_pixy2(0.05));
  EXPECT_EQ(bench.refused(Refusal::kNoPose), 1U);
  EXPECT_EQ(bench.memory->waiting.size(), 1U);
  EXPECT_EQ(bench.memory->waiting.front().frame, 4U);
}

TEST(Pipeline, RejectsWhatAReaderOfTheLogWouldReject) {
  Bench bench;
  EXPECT_EQ(bench.pipeline.accept(desk_odometry(1.00)), std::nullopt);
  EXPECT_EQ(bench.pipeline.accept(desk_odometry(1.00)), record::Reject::kTime);
  EXPECT_EQ(bench.pipeline.accept(desk_frame(1.02, 1)), std::nullopt);
  EXPECT_EQ(bench.pipeline.accept(desk_frame(1.01, 2)), record::Reject::kTime);
  sensor::BlobFrame outside = desk_frame(1.03, 3);
  outside.blobs[0].x2 = 316;
  EXPECT_EQ(bench.pipeline.accept(outside), record::Reject::kRange);
  EXPECT_EQ(bench.memory->counters.rejected, 3U);
  bench.pipeline.restart();  // times start again
  EXPECT_EQ(bench.pipeline.accept(desk_odometry(0.5)), std::nullopt);
  EXPECT_EQ(bench.pipeline.accept(desk_frame(0.5, 4)), std::nullopt);
}

TEST(Pipeline, ARestartKeepsCalibrationAndSettingsAndCounts) {
  Bench bench;
  ASSERT_EQ(bench.pipeline.set("alert.stop", "0.30"), std::nullopt);
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.04, 1));
  bench.pipeline.restart();
  EXPECT_EQ(bench.refused(Refusal::kNoPose), 1U);  // the frame that waited
  EXPECT_TRUE(bench.memory->calibration.known);
  EXPECT_EQ(bench.memory->settings.text(config::Key::kAlertStop).view(), "0.30");
  EXPECT_EQ(bench.memory->counters.odometry, 1U);
  EXPECT_FALSE(bench.pipeline.stream_time().has_value());
}

TEST(Pipeline, IdenticalCalibrationHasNoEffect) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.06, 1));
  for (int i = 0; i < 5; ++i) bench.pipeline.set_camera(level_pixy2());
  EXPECT_EQ(bench.memory->waiting.size(), 1U);
  bench.pipeline.accept(desk_odometry(1.02));
  EXPECT_EQ(bench.place(), 1);
}

TEST(Pipeline, TheEndOfTheStreamRefusesWhatStillWaits) {
  Bench bench;
  bench.pipeline.accept(desk_odometry(1.00));
  bench.pipeline.accept(desk_frame(1.07, 1));
  bench.pipeline.finish();
  EXPECT_EQ(bench.refused(Refusal::kNoPose), 1U);
}

// The alert comes with the frame that completes k of n.
TEST(Pipeline, TheAlertComesWithTheConfirmingFrame) {
  Bench bench(Mode::kText);
  bench.pipeline.set_signature({1, {0xd0, 0x20, 0x20}, "red"});
  bench.pipeline.accept(desk_odometry(0.0, 0.8));
  for (std::uint32_t i = 1; i <= 3; ++i) {
    EXPECT_EQ(bench.output(), "") << i;
    const double t = 0.1 * i;
    bench.pipeline.accept(desk_odometry(t, 0.8));
    bench.pipeline.accept(desk_frame(t, i, 0.8));
    EXPECT_EQ(bench.place(), 1);
  }
  // 0.2 m away the foot of the post is below the image; that it is, tells that the post is near.
  const std::string text = bench.output();
  EXPECT_EQ(text.rfind("STOP    red  0.", 0), 0U)
      << text << name(bench.memory->map.slots()[0].cylinder.estimate().refusal);
}

TEST(Pipeline, KeepsWarningWhenTheCameraFallsSilent) {
  Bench bench(Mode::kText);
  for (std::uint32_t i = 0; i <= 5; ++i) {
    bench.pipeline.accept(desk_odometry(0.1 * i, 0.02 * i));
    bench.pipeline.accept(desk_frame(0.1 * i, i, 0.02 * i));
    bench.place();
  }
  EXPECT_EQ(bench.output().find("STOP"), std::string::npos);
  for (int i = 6; i <= 50; ++i) {  // blind, still driving at 0.2 m/s
    bench.pipeline.accept(desk_odometry(0.1 * i, 0.02 * i));
    bench.place();
    bench.pipeline.watch_without_frames();
  }
  EXPECT_NE(bench.output().find("STOP"), std::string::npos);
}

// --- the console as a log ---

template <class Link, class Profile = config::Micro>
struct Robot {
  explicit Robot(Link& link, const std::vector<fake::OdometryStep>& o, const std::vector<fake::CameraStep>& c)
      : odometry(o), camera(c), loop(*memory, camera, odometry, link, Mode::kLog) {
    loop.pipeline().start_run(header);
    loop.pipeline().set_camera(level_pixy2());
    loop.pipeline().set_signature({1, {0xd0, 0x20, 0x20}, "red"});
  }
  record::Header header{1, "fencepost", "0.0.0", "test", Profile::kName};
  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  fake::ScriptedOdometry odometry;
  fake::ScriptedCamera camera;
  loop::Loop<Profile, fake::ScriptedCamera, fake::ScriptedOdometry, Link> loop;
};

struct Script {
  std::vector<fake::OdometryStep> odometry;
  std::vector<fake::CameraStep> camera;
};
Script approach(int frames) {
  Script script;
  for (int i = 0; i < frames; ++i) {
    const double t = 0.02 * i;
    const double x = 0.0008 * i;
    script.odometry.push_back({Time::nearest(t), desk_odometry(t, x)});
    script.camera.push_back({Time::nearest(t), desk_frame(t, static_cast<std::uint32_t>(i), x)});
  }
  return script;
}

// Takes at most `budget` bytes between two calls of refill().
class SlowLink {
 public:
  explicit SlowLink(std::size_t bytes_a_turn) : bytes_a_turn_(bytes_a_turn) {}
  base::Result<std::size_t> read(std::span<std::uint8_t>) { return base::Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> bytes) {
    const std::size_t count = std::min(bytes.size(), budget_);
    if (count == 0) return base::Error::kFull;
    text_.append(reinterpret_cast<const char*>(bytes.data()), count);
    budget_ -= count;
    return count;
  }
  void refill() { budget_ = bytes_a_turn_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::size_t bytes_a_turn_;
  std::size_t budget_ = 0;
  std::string text_;
};
static_assert(bus::ByteLink<SlowLink>);

// Feeds a log's inputs to a pipeline, one at a time, as the loop does.
struct Feed {
  loop::Pipeline<config::Micro>& pipeline;

  void process() {
    while (pipeline.place_next_frame()) {
    }
    pipeline.watch_without_frames();
  }
  void accept(const sensor::CameraIntrinsics& camera) { pipeline.set_camera(camera); }
  void accept(const sensor::OdometrySample& sample) {
    pipeline.accept(sample);
    process();
  }
  void accept(const sensor::BlobFrame& seen) {
    pipeline.accept(seen);
    process();
  }
  template <class Record>
  void accept(const Record&) {}
};

// Whatever the robot had to refuse or drop, the log that it wrote is the whole truth: replaying it gives its digest.
TEST(Log, ReplayOfTheLogGivesTheDigestHoweverSlowTheLink) {
  for (const std::size_t speed : {40U, 80U, 120U, 230U, 5000U}) {
    SCOPED_TRACE(speed);
    const Script script = approach(600);
    SlowLink link(speed);
    Robot robot(link, script.odometry, script.camera);
    for (int i = 0; i < 1300; ++i) {
      link.refill();
      robot.loop.step(Time{i * 100});
    }
    for (int i = 0; i < 100; ++i) {  // let the queue drain
      link.refill();
      robot.loop.step(Time::nearest(20));
    }
    const std::uint64_t digest = robot.memory->map.digest();
    const std::uint32_t frames = robot.memory->counters.frames;

    std::array<char, record::StreamReader::kBuffer> buffer{};
    record::StreamReader reader(buffer);
    auto again = std::make_unique<loop::Memory<config::Micro>>();
    loop::Pipeline<config::Micro> pipeline(*again, Mode::kQuiet);
    Feed feed{pipeline};
    pipeline.start_run(robot.header);
    reader.push(link.text(), feed);
    EXPECT_EQ(reader.counts().rejected(), 0U);
    EXPECT_EQ(again->map.digest(), digest);
    EXPECT_EQ(again->counters.frames, frames);
    if (speed == 5000U) {
      EXPECT_EQ(frames, 597U);  // three were exposed before the first odometry
      EXPECT_EQ(robot.memory->counters.records_dropped, 0U);
    }
    if (speed == 40U) {
      EXPECT_GT(robot.memory->counters.records_dropped + robot.memory->counters.refused_in_all(), 100U);
    }
  }
}

TEST(Log, TellsHeaderCalibrationAlertsDigestsAndObjects) {
  const Script script = approach(600);
  SlowLink link(100'000);
  Robot robot(link, script.odometry, script.camera);
  for (int i = 0; i < 600; ++i) {
    link.refill();
    robot.loop.step(Time::nearest(0.02 * i));
  }
  const std::string& log = link.text();
  EXPECT_EQ(log.rfind("$FPHDR,1,fencepost,", 0), 0U);
  const auto count = [&](std::string_view what) {
    int found = 0;
    for (std::size_t at = log.find(what); at != std::string::npos; at = log.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("$FPHDR"), 1);
  EXPECT_EQ(count("$FPCAM"), 2);  // at the start and after 10 s
  EXPECT_EQ(count("$FPSIG"), 2);
  constexpr int kOfCars = 6;  // which a log has no use for
  EXPECT_EQ(count("$FPCFG"), 2 * (static_cast<int>(config::kKeys) - kOfCars));
  EXPECT_EQ(count("$FPODO"), 600);
  EXPECT_EQ(count("$FPFRM"), 600);
  EXPECT_EQ(count("$FPDIG"), 11);  // every 50 frames
  EXPECT_EQ(count("$FPSTA"), 11);  // 12 s
  EXPECT_GE(count("$FPOBJ"), 20);
  EXPECT_GE(count("$FPALR"), 3);
  EXPECT_LT(log.find("$FPCAM"), log.find("$FPFRM"));
}

}  // namespace
}  // namespace fencepost::test
