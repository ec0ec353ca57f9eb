// Commands and records that come over the console while it is a log: the log stays the whole truth.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "firmware/record/stream_reader.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::Mode;

// A log's records through a pipeline, one at a time, as host/replay does.
struct Replayed {
  explicit Replayed(const std::string& log) {
    std::array<char, record::StreamReader::kBuffer> buffer{};
    record::StreamReader reader(buffer);
    reader.push(log, *this);
    reader.finish();
    counts = reader.counts();
  }
  void accept(const record::Header& logged) {
    pipeline.start_run(header);
    memory->settings = {};
    EXPECT_EQ(logged.profile.view(), "micro");
    ++runs;
  }
  void accept(const sensor::CameraIntrinsics& camera) { pipeline.set_camera(camera); }
  void accept(const record::Signature& signature) { pipeline.set_signature(signature); }
  void accept(const record::Setting& setting) {
    EXPECT_EQ(pipeline.set(setting.key.view(), setting.value.view()), std::nullopt);
  }
  void accept(const sensor::OdometrySample& sample) {
    EXPECT_EQ(pipeline.accept(sample), std::nullopt);
    process();
  }
  void accept(const sensor::BlobFrame& frame) {
    EXPECT_EQ(pipeline.accept(frame), std::nullopt);
    process();
  }
  template <class Record>
  void accept(const Record&) {}
  void process() {
    while (pipeline.place_next_frame()) {
    }
    pipeline.watch_without_frames();
  }

  record::Header header{1, "fencepost", "0.1.0", "replay", "micro"};
  std::unique_ptr<loop::Memory<config::Micro>> memory = std::make_unique<loop::Memory<config::Micro>>();
  loop::Pipeline<config::Micro> pipeline{*memory, Mode::kQuiet};
  record::Counts counts;
  int runs = 0;
};

// The queue empties before the log is read.
std::string whole_log(Desk<>& desk) {
  desk.link.bytes_a_turn = 10'000;
  desk.turn(50);
  return desk.link.said();
}

TEST(ConsoleLog, ReplaysToTheSameDigestHoweverMuchWasTyped) {
  const char* commands[] = {"help\n",
                            "status\n",
                            "objects\n",
                            "map\n",
                            "get\n",
                            "frob\n",
                            "set confirm.k 2\n",
                            "set confirm.k 3\n",
                            "alerts off\n",
                            "set alert.stop 1\n",
                            "set confirm.n 4\n",
                            "alerts on\n",
                            "version\n",
                            "mode log\n",
                            "$FPODO,1,2,3*0000\n",
                            "set alert.stop x\n"};
  for (const std::size_t speed : {2U, 4U, 6U, 11U, 5000U}) {
    SCOPED_TRACE(speed);
    std::mt19937 random(static_cast<unsigned>(speed));
    Desk<> desk(Mode::kLog, desk_approach(600));
    desk.link.bytes_a_turn = speed;
    for (int i = 0; i < 12'500; ++i) {
      if (i % 137 == 0) desk.link.type(commands[random() % std::size(commands)]);
      desk.turn();
    }
    const std::string log = whole_log(desk);
    const Replayed replayed(log);
    EXPECT_EQ(replayed.memory->map.digest(), desk.memory().map.digest());
    EXPECT_EQ(replayed.memory->counters.frames, desk.memory().counters.frames);
    EXPECT_EQ(replayed.counts.rejected(), 0U);
    EXPECT_GT(replayed.counts.foreign, 20U);
    EXPECT_GT(desk.memory().counters.frames, speed < 4 ? 0U : 10U);
    EXPECT_TRUE(desk.link.read_all());
  }
}

TEST(ConsoleLog, InputsOverTheConsoleAreInTheLog) {
  Desk<> desk(Mode::kLog);
  const Script script = desk_approach(300);
  for (std::size_t i = 0; i < script.camera.size(); ++i) {
    desk.link.type(line_of(*script.odometry[i].answer));
    desk.link.type(line_of(*script.camera[i].answer));
    if (i == 100) desk.link.type("set confirm.k 2\r");
    if (i == 150) {
      sensor::CameraIntrinsics camera = level_pixy2();
      camera.latency = base::Duration::nearest(0.04);
      desk.link.type(line_of(camera));
      camera.latency = base::Duration::nearest(0.06);
      desk.link.type(line_of(camera));
    }
    desk.turn(2);
  }
  desk.turn(100);
  const Replayed replayed(whole_log(desk));
  EXPECT_EQ(desk.memory().counters.odometry, 300U);
  EXPECT_GT(desk.memory().counters.frames, 290U);
  EXPECT_EQ(replayed.memory->map.digest(), desk.memory().map.digest());
  EXPECT_EQ(replayed.counts.records_of(record::Kind::kFrame), 300U);
}

TEST(ConsoleLog, AResetStartsARunWithEverythingThatAReplayNeeds) {
  Desk<> desk(Mode::kLog, desk_approach(400));
  desk.turn(2000);
  desk.link.type("set confirm.k 2\n");
  desk.turn(2000);
  desk.link.type("reset\n");
  desk.turn(5000);
  const Replayed replayed(whole_log(desk));
  EXPECT_EQ(replayed.runs, 2);
  EXPECT_EQ(replayed.memory->map.digest(), desk.memory().map.digest());
  EXPECT_GT(desk.memory().map.frames(), 150U);
  EXPECT_LT(desk.memory().map.frames(), 210U);
}

TEST(ConsoleLog, ALogThatBeginsWithinARunSaysSo) {
  Desk<> desk(Mode::kText, desk_approach(400));
  desk.turn(1000);
  desk.link.take_said();
  const std::string said = desk.type_line("mode log");
  EXPECT_EQ(said.find("$FPHDR"), std::string::npos);
  EXPECT_NE(said.find("$FPCAM"), std::string::npos);
  EXPECT_NE(said.find("$FPCFG"), std::string::npos);
  EXPECT_NE(said.find("mode is log; this run began unlogged, 'reset' starts one that replays exactly\r\n"),
            std::string::npos);
  desk.link.type("reset\n");
  desk.turn(10'000);
  const Replayed replayed(whole_log(desk));
  EXPECT_EQ(replayed.memory->map.digest(), desk.memory().map.digest());
}

TEST(ConsoleLog, ALogThatBeginsBeforeTheFirstInputIsWhole) {
  Desk<> desk(Mode::kText);
  const std::string said = desk.type_line("mode log");
  EXPECT_EQ(said.find("$FPHDR"), 0U);
  EXPECT_NE(said.find("mode is log\r\n"), std::string::npos) << said;
}

TEST(ConsoleLog, ASettingIsEchoedAtOnce) {
  Desk<> desk(Mode::kLog);
  desk.turn(10);
  desk.link.take_said();
  EXPECT_EQ(desk.type_line("set correct.pose on"),
            line_of(record::Setting{"correct.pose", "on"}) + "correct.pose = on\r\n");
  EXPECT_EQ(desk.type_line("set correct.pose on"), "correct.pose = on\r\n");  // nothing changed
}

// The link is full of log records; who types gets an answer all the same, and the log goes on.
TEST(ConsoleLog, ASaturatedLinkStillAnswers) {
  Desk<> desk(Mode::kLog, desk_approach(600));
  desk.link.bytes_a_turn = 2;  // odometry and frames alone need five
  desk.turn(4000);
  desk.link.type("status\n");
  int turns = 0;
  while (desk.link.said().find("objects 1 of 4") == std::string::npos && turns < 2000) {
    desk.turn();
    ++turns;
  }
  EXPECT_LT(turns, 2000);
  const std::uint32_t before = desk.memory().counters.odometry;
  desk.turn(1000);
  EXPECT_GT(desk.memory().counters.odometry, before);
}

}  // namespace
}  // namespace fencepost::test
