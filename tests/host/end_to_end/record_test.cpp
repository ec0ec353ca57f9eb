// `fencepost record --camera --odometry` on emulated devices.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/host/end_to_end/drive_scene.hpp"

namespace fencepost::host::testing {
namespace {

TEST(EndToEndRecord, DevicesAreRecordedInPartsThatAreOneRun) {
  const Folder folder;
  spill(folder.path() / "scene.json", scene_for(camera_of("pixy2:./a"), 12, 0.6));
  Process emulate(folder, {"emulate", "pixy2", "records", "scene.json", "--link", "a", "--link", "b"}, "emulate.");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(folder.path() / "b"); })) << emulate.err();
  Process record(folder,
                 {"record", "--camera", "pixy2:./a", "--odometry", "records:./b", "--robot", "scene.json", "-o",
                  "part.log", "--log-size", "8K"},
                 "record.");
  EXPECT_EQ(emulate.wait(), 0) << emulate.err();
  EXPECT_EQ(record.end(SIGINT), 130) << record.err();
  EXPECT_EQ(record.out(), "");
  EXPECT_NE(record.err().find("log part.log to part-000"), std::string::npos) << record.err();
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "part-0002.log"));
  EXPECT_EQ(shell(folder, "cat part.log part-*.log > run.log").exit_code, 0);
  expect_replays(folder, record.err());
  expect_things(folder, camera_of("pixy2:./a"), 0.01);
}

}  // namespace
}  // namespace fencepost::host::testing
