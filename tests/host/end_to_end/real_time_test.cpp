// In real time, for each kind of link that two programs can have between them on any machine: events are awaited, never
// times. All other drives have the clock of tests/stage.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/host/end_to_end/drive_scene.hpp"

namespace fencepost::host::testing {
namespace {

class RealTime : public ::testing::Test {
 protected:
  /// `run` at two places of `emulate`, until it has used some frames; the log replays.
  void expect_run(const std::vector<std::string>& emulated, const std::function<std::string(std::size_t)>& place) {
    constexpr std::size_t kFrames = 20;
    spill(folder.path() / "scene.json", scene_for(camera_of("pixy2:./a"), 12, 0.3));
    std::vector<std::string> words = {"emulate"};
    words.insert(words.end(), emulated.begin(), emulated.end());
    words.insert(words.end(), {"scene.json", "--loop"});
    emulate.emplace(folder, words, "emulate.");
    ASSERT_TRUE(emulate->shows("create2 on ")) << emulate->err();
    Process run(folder,
                {"run", "--camera", "pixy2:" + place(0), "--odometry", "create2:" + place(1), "--robot", "scene.json",
                 "--log", "run.log", "--mode", "quiet", "--frames", std::to_string(kFrames)},
                "run.");
    EXPECT_EQ(run.wait(), 0) << run.err() << emulate->err();
    EXPECT_EQ(emulate->end(SIGTERM), 0) << emulate->err();
    expect_replays(folder, run.err());
  }

  Folder folder;
  std::optional<Process> emulate;
};
using RealTimeSerial = RealTime;
using RealTimeTcp = RealTime;

TEST_F(RealTimeSerial, ARunHasFramesAndReplays) {
  expect_run({"pixy2:./a", "create2:./b"}, [](std::size_t index) { return index == 0 ? "./a" : "./b"; });
}

TEST_F(RealTimeTcp, ARunHasFramesAndReplays) {
  expect_run({"pixy2:tcp:0", "create2:tcp:0"}, [this](std::size_t index) {
    const std::string shown = emulate->out();
    std::smatch port;
    const std::regex pattern((index == 0 ? "pixy2" : "create2") + std::string(" on 127\\.0\\.0\\.1:([0-9]+)"));
    EXPECT_TRUE(std::regex_search(shown, port, pattern)) << shown;
    return "tcp:127.0.0.1:" + port[1].str();
  });
}

}  // namespace
}  // namespace fencepost::host::testing
