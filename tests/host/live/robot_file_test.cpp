#include "host/live/robot_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "drivers/pixy2/camera.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::host {
namespace {

RobotFile read(const std::string& text) {
  const auto robot = parse_robot(text, "robot.json");
  EXPECT_TRUE(robot.ok()) << (robot.ok() ? "" : robot.error());
  return robot.ok() ? *robot : RobotFile{};
}

TEST(RobotFile, PutsItsNumbersOverTheCamerasProfile) {
  const RobotFile robot = read(R"({"camera": {"fx": 280.25, "latency": 0.04,
                                   "mount": {"x": 0.05, "z": 0.12, "yaw": 0.1, "pitch": null}}})");
  const sensor::CameraIntrinsics camera = robot.camera.over(pixy2::kPixy2Profile);
  EXPECT_EQ(camera.model.view(), "pixy2");
  EXPECT_EQ(camera.width, 316);
  EXPECT_EQ(camera.fx.raw, 28'025);
  EXPECT_EQ(camera.fy.raw, 27'366);
  EXPECT_EQ(camera.latency.raw, 400);
  EXPECT_EQ(camera.mount.x.raw, 500);
  EXPECT_EQ(camera.mount.z.raw, 1'200);
  EXPECT_EQ(camera.mount.yaw.raw, 1'000);
  EXPECT_FALSE(camera.mount.pitch.has_value());
  EXPECT_FALSE(robot.camera.complete());
}

TEST(RobotFile, AMountIsLevelUnlessItSaysOtherwise) {
  EXPECT_EQ(read(R"({"camera": {"mount": {}}})").camera.mount->pitch->raw, 0);
  EXPECT_EQ(read(R"({"camera": {"mount": {"pitch": 0.05}}})").camera.mount->pitch->raw, 500);
  EXPECT_FALSE(read(R"({"camera": {}})").camera.mount.has_value());
}

TEST(RobotFile, ASceneServesToo) {
  const RobotFile robot = read(R"({"format": 1, "seed": 7,
    "camera": {"model": "mine", "width": 80, "height": 60, "fx": 90, "fy": 91, "cx": 39.5, "cy": 29.5, "rate": 50, "max_blobs": 8},
    "robot": {"width": 0.31}, "signatures": [{"id": 2, "name": "lemon", "rgb": "E0D010"}],
    "objects": [], "path": {}, "noise": {}})");
  EXPECT_TRUE(robot.camera.complete());
  EXPECT_EQ(robot.camera.over({}).model.view(), "mine");
  ASSERT_EQ(robot.signatures.size(), 1U);
  EXPECT_EQ(robot.signatures[0].signature, 2);
  EXPECT_EQ(robot.signatures[0].name.view(), "lemon");
  ASSERT_EQ(robot.settings.size(), 1U);
  EXPECT_EQ(robot.settings[0].first, "robot.width");
  EXPECT_EQ(robot.settings[0].second, "0.31");
}

TEST(RobotFile, SignaturesHaveASizeAndAPad) {
  const RobotFile robot = read(R"({"signatures": [{"id": 2, "rgb": "E0D010", "size": 0.05, "pad": 4}]})");
  ASSERT_EQ(robot.signatures.size(), 1U);
  EXPECT_EQ(robot.signatures[0].width, 50);
  EXPECT_EQ(robot.signatures[0].pad, 4);
}

// A signature's colour and 40 to either side, inside 16..240.
TEST(RobotFile, ACmucamsWindowsLieAroundTheColours) {
  const RobotFile robot = read(R"({"signatures": [{"id": 3, "rgb": "d02080"}]})");
  ASSERT_EQ(robot.windows.size(), 1U);
  const cmucam::ColourWindow& window = robot.windows[0];
  EXPECT_EQ(window.signature, 3);
  EXPECT_EQ(window.red_min, 208 - 40);
  EXPECT_EQ(window.red_max, 208 + 40);
  EXPECT_EQ(window.green_min, 0) << "32 - 40";
  EXPECT_EQ(window.green_max, 32 + 40);
  EXPECT_EQ(window.blue_min, 128 - 40);
  EXPECT_EQ(window.blue_max, 128 + 40);
}

TEST(RobotFile, WindowsThatWereMeasuredCountInstead) {
  const RobotFile robot = read(R"({"signatures": [{"id": 3, "rgb": "d02080"}],
    "windows": [{"signature": 3, "red": [100, 240], "green": [16, 30], "blue": [17, 18]}]})");
  ASSERT_EQ(robot.windows.size(), 1U);
  EXPECT_EQ(robot.windows[0].red_min, 100);
  EXPECT_EQ(robot.windows[0].blue_max, 18);
}

TEST(RobotFile, ReadsTrainedColours) {
  const RobotFile robot = read(R"({"colours": [
    {"signature": 2, "red": [0.55, 0.7], "green": [0.2, 0.3125], "brightness": [20, 250]},
    {"signature": 9, "red": [0, 1], "green": [0.5, 0.5]}]})");
  ASSERT_EQ(robot.colours.size(), 2U);
  EXPECT_EQ(robot.colours[0], (segmenter::ColourRange{2, {5'500}, {7'000}, {2'000}, {3'125}, 20, 250}));
  EXPECT_EQ(robot.colours[1], (segmenter::ColourRange{9, {0}, {10'000}, {5'000}, {5'000}, 0, 255}));
  EXPECT_TRUE(robot.signatures.empty());
}

TEST(RobotFile, ReadsWheels) {
  const RobotFile robot = read(R"({"wheels": {"metres_per_tick": 0.000444, "right_metres_per_tick": -0.000445,
                                   "track": 0.235, "counter_bits": 16, "max_speed": 0.6}})");
  const odometry::WheelBase wheels = robot.wheels.over({});
  EXPECT_EQ(wheels.left_pm_per_count, 444'000'000);
  EXPECT_EQ(wheels.right_pm_per_count, -445'000'000);
  EXPECT_EQ(wheels.track_pm, 235'000'000'000);
  EXPECT_EQ(wheels.counter_bits, 16);
  EXPECT_EQ(wheels.max_speed_mm_s, 600);
  EXPECT_EQ(read("{}").wheels.over(odometry::kCreate2Wheels).track_pm, odometry::kCreate2Wheels.track_pm);
}

TEST(RobotFile, ReadsCountsOnCan) {
  const RobotFile robot = read(R"({"wheels": {"metres_per_tick": 0.001, "track": 0.4},
    "can": {"left": {"id": "0x181", "byte": 2, "length": 2}, "right": {"id": 386, "byte": 4, "length": 2, "big_endian": true, "sign": -1}}})");
  ASSERT_TRUE(robot.can.has_value());
  EXPECT_EQ(robot.can->quantity, can_wheels::Quantity::kCounts);
  EXPECT_EQ(robot.can->left.id, 0x181U);
  EXPECT_EQ(robot.can->left.first_byte, 2);
  EXPECT_EQ(robot.can->left.size, 2);
  EXPECT_FALSE(robot.can->left.big_endian);
  EXPECT_EQ(robot.can->right.id, 386U);
  EXPECT_TRUE(robot.can->right.big_endian);
  EXPECT_EQ(robot.can->wheels.left_pm_per_count, 1'000'000'000);
  EXPECT_EQ(robot.can->wheels.right_pm_per_count, -1'000'000'000);
  EXPECT_EQ(robot.can->wheels.track_pm, 400'000'000'000);
  EXPECT_EQ(robot.can->wheels.counter_bits, 16);
}

std::string shared(const char* name) {
  return test::contents(std::string(FENCEPOST_SOURCE_DIR "/host/share/can/") + name);
}

bus::CanFrame frame_of(std::uint32_t id, bool extended, std::initializer_list<std::uint8_t> data) {
  bus::CanFrame frame;
  frame.id = id;
  frame.extended = extended;
  frame.length = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

// The document's frames: node 5, 100000 and -123456 counts.
TEST(RobotFile, TheCanopenExampleReadsPositions) {
  const RobotFile robot = read(shared("canopen_wheels.json"));
  ASSERT_TRUE(robot.can.has_value());
  EXPECT_EQ(value_in(frame_of(0x185, false, {0x37, 0x06, 0xA0, 0x86, 0x01, 0x00}), robot.can->left), 100'000);
  EXPECT_EQ(value_in(frame_of(0x186, false, {0x37, 0x06, 0xC0, 0x1D, 0xFE, 0xFF}), robot.can->right), -123'456);
  EXPECT_EQ(robot.can->wheels.counter_bits, 32);
  EXPECT_EQ(robot.can->wheels.right_pm_per_count, -robot.can->wheels.left_pm_per_count);
}

// Device 3 at 123456, device 4 at -1000; a frame of 11 bits with the same number is another one.
TEST(RobotFile, TheTalonExampleReadsPositions) {
  const RobotFile robot = read(shared("frc_talon_srx_wheels.json"));
  ASSERT_TRUE(robot.can.has_value());
  const auto forward = frame_of(0x0204'1443, true, {0x01, 0xE2, 0x40, 0xFF, 0x06, 0, 0, 0});
  EXPECT_EQ(value_in(forward, robot.can->left), 123'456);
  EXPECT_EQ(value_in(forward, robot.can->right), std::nullopt);
  EXPECT_EQ(value_in(frame_of(0x0204'1444, true, {0xFF, 0xFC, 0x18, 0x00, 0x64, 0, 0, 0}), robot.can->right), -1'000);
  EXPECT_EQ(value_in(frame_of(0x443, false, {0x01, 0xE2, 0x40, 0, 0, 0, 0, 0}), robot.can->left), std::nullopt);
  EXPECT_EQ(robot.can->wheels.counter_bits, 24);
}

TEST(RobotFile, ReadsVelocitiesOnCan) {
  const RobotFile robot = read(R"({"wheels": {"track": 0.4}, "can": {"quantity": "velocities", "silence": 0.5,
    "left": {"id": "0x18FF0102", "extended": true, "byte": 0, "length": 4, "scale": 0.001, "signed": false},
    "right": {"id": "0x18ff0102", "extended": true, "byte": 4, "scale": 0.002}}})");
  ASSERT_TRUE(robot.can.has_value());
  EXPECT_EQ(robot.can->quantity, can_wheels::Quantity::kVelocities);
  EXPECT_EQ(robot.can->left.id, 0x18FF0102U);
  EXPECT_TRUE(robot.can->left.extended);
  EXPECT_FALSE(robot.can->left.is_signed);
  EXPECT_TRUE(robot.can->right.is_signed);
  EXPECT_EQ(robot.can->right.size, 4);
  EXPECT_EQ(robot.can->wheels.left_pm_per_count, 1'000'000'000);
  EXPECT_EQ(robot.can->wheels.right_pm_per_count, 2'000'000'000);
  EXPECT_EQ(robot.can->silence.raw, 5'000);
}

TEST(RobotFile, ReadsSettings) {
  const RobotFile robot = read(R"({"settings": {"alert.stop": 0.3, "correct.pose": true, "confirm.k": "2"}})");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"alert.stop", "0.3"}, {"confirm.k", "2"}, {"correct.pose", "on"}};
  EXPECT_EQ(robot.settings, expected);
}

TEST(RobotFile, ReadsTheEndsOfTheRobot) {
  const RobotFile robot = read(R"({"robot": {"front": 0.12, "rear": 0.3, "width": 0.24}})");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"robot.front", "0.12"}, {"robot.rear", "0.3"}, {"robot.width", "0.24"}};
  EXPECT_EQ(robot.settings, expected);
}

// Rounded outwards, as wide to the left as to the right.
TEST(RobotFile, AFootprintBecomesTheRectangleAroundIt) {
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"robot.front", "0.25"}, {"robot.rear", "0.07"}, {"robot.width", "0.25"}};
  EXPECT_EQ(read(R"({"robot": {"footprint": [[0.25, 0], [-0.061, 0.1], [-0.061, -0.121]]}})").settings, expected);
  EXPECT_EQ(read(R"({"robot": {"footprint": [[0.25, 0], [-0.061, 0.1], [-0.061, -0.121], [0.25, 0]]}})").settings,
            expected);
  EXPECT_EQ(read(R"({"robot": {"footprint": [[0, 0.005], [-0.29, 0.005], [-0.29, -0.005], [0, -0.005]]}})").settings,
            (std::vector<std::pair<std::string, std::string>>{
                {"robot.front", "0.01"}, {"robot.rear", "0.29"}, {"robot.width", "0.02"}}));
}

TEST(RobotFile, TheDocumentsExampleIsOne) {
  const std::string document = test::contents(FENCEPOST_SOURCE_DIR "/host/share/doc/live.md");
  const std::size_t begin = document.find("```json\n") + 8;
  const RobotFile robot = read(document.substr(begin, document.find("```", begin) - begin));
  EXPECT_EQ(robot.camera.mount->z.raw, 1'200);
  EXPECT_EQ(robot.windows.size(), 1U);
  EXPECT_EQ(robot.settings.size(), 5U);
  EXPECT_EQ(robot.wheels.counter_bits, 16);
  ASSERT_TRUE(robot.can.has_value());
  EXPECT_EQ(robot.can->wheels.right_pm_per_count, -445'000'000);
}

TEST(RobotFile, SaysWhatIsWrongWhereAndWhatToDo) {
  const std::pair<const char*, const char*> kBad[] = {
      {"", "line 1, column 1: the file is empty; share/doc/live.md shows a robot file"},
      {"{\"camera\": ", "the JSON ends too early"},
      {"[]", "must be an object"},
      {R"({"camra": {}})", "/camra: unknown key \"camra\"; did you mean \"camera\"?"},
      {R"({"camera": {}, "camera": {}})", "appears twice"},
      {R"({"camera": {"fx": -1}})", "/camera/fx: -1 is out of range"},
      {R"({"camera": {"width": 2.5}})", "/camera/width: must be a whole number"},
      {R"({"camera": {"mount": {"pitch": 45}}})", "/camera/mount/pitch: 45 is out of range"},
      {R"({"camera": {"model": "a name that is much too long for a text field"}})", "/camera/model: has 45 characters"},
      {R"({"signatures": [{"id": 1, "rgb": "red"}]})", "/signatures/0/rgb: \"red\" is not a colour"},
      {R"({"signatures": [{"id": 1, "rgb": "d02020"}, {"id": 1, "rgb": "d02020"}]})",
       "/signatures/1/id: signature 1 is there twice"},
      {R"({"windows": []})", "/windows: has 0 windows"},
      {R"({"windows": [{"signature": 1, "red": [9, 8], "green": [1, 2], "blue": [1, 2]}]})",
       "/windows/0/red: the least is above the greatest; swap them"},
      {R"({"colours": []})", "/colours: has 0 colours"},
      {R"({"colours": [{"signature": 0, "red": [0, 1], "green": [0, 1]}]})", "/colours/0/signature: 0 is out of range"},
      {R"({"colours": [{"signature": 1, "red": [0.6, 0.5], "green": [0, 1]}]})",
       "/colours/0/red: the least is above the greatest; swap them"},
      {R"({"colours": [{"signature": 1, "red": [0, 2], "green": [0, 1]}]})", "/colours/0/red/1: 2 is out of range"},
      {R"({"colours": [{"signature": 1, "red": [0, 1]}]})", "/colours/0: \"green\" is missing"},
      {R"({"wheels": {"metres_per_tick": 0}})", "/wheels/metres_per_tick: is 0"},
      {R"({"wheels": {"track": 0}})", "/wheels/track: must be greater than 0"},
      {R"({"wheels": {"trakc": 1}})", "did you mean \"track\"?"},
      {R"({"can": {"left": {}}})", "/can/left: \"id\" is missing"},
      {R"({"can": {"left": {"id": "181", "byte": 0}}})", "/can/left/id: \"181\" is no CAN identifier"},
      {R"({"can": {"left": {"id": 2048, "byte": 0}}})", "/can/left/id: 2048 is out of range"},
      {R"({"can": {"left": {"id": 1, "byte": 6, "length": 4}}})", "reach beyond the 8 bytes"},
      {R"({"can": {"left": {"id": 1, "byte": 0}, "right": {"id": 2, "byte": 0}}})", "/can/left: \"scale\" is missing"},
      {R"({"can": {"left": {"id": 1, "byte": 0, "scale": 1}, "right": {"id": 2, "byte": 0, "scale": 1}}})",
       "/can: the distance of the wheels is not known"},
      {R"({"can": {"left": {"id": 1, "byte": 0, "scale": 1, "sign": 0}, "right": {"id": 2, "byte": 0}}})",
       "/can/left/sign: is 0"},
      {R"({"can": {"quantity": "ticks", "left": {}, "right": {}}})", "write \"counts\" or \"velocities\""},
      {R"({"can": {"left": {"id": 1, "byte": 0, "signed": 1}}})", "/can/left/signed: must be true or false"},
      {R"({"settings": {"alert.stopp": 1}})", "/settings/alert.stopp: there is no setting"},
      {R"({"settings": {"alert.stop": 11}})", "/settings/alert.stop: \"11\" is not possible"},
      {R"({"robot": {"width": "wide"}})", "/robot/width: must be a number"},
      {R"({"robot": {"width": 6}})", "/robot/width: \"6\" is not possible"},
      {R"({"robot": {"front": 0}})", "/robot/front: 0 is out of range"},
      {R"({"robot": {"rear": -0.1}})", "/robot/rear: -0.1 is out of range"},
      {R"({"robot": {"nose": 0.1}})", "/robot/nose: unknown key"},
      {R"({"robot": {"width": 0.2, "footprint": [[0.1, 0.1], [-0.1, 0.1], [0, -0.1]]}})",
       "/robot/footprint: says the same as front, rear and width"},
      {R"({"robot": {"footprint": [[0.1, 0.1], [-0.1, 0.1]]}})", "/robot/footprint: has 2 corners"},
      {R"({"robot": {"footprint": [[0.1, 0.1], [-0.1, 0.1], [0.1, 0.1]]}})",
       "/robot/footprint: has fewer than three different corners"},
      {R"({"robot": {"footprint": [[0.1, 0.1], [-0.1, -0.1], [0.1, -0.1], [-0.1, 0.1]]}})",
       "/robot/footprint: the outline crosses or touches itself at (0, 0)"},
      {R"({"robot": {"footprint": [[0.1, 0], [-0.1, 0], [0, 0]]}})", "/robot/footprint: "},
      {R"({"robot": {"footprint": [[6, 0.1], [-0.1, 0.1], [0, -0.1]]}})", "/robot/footprint/0/0: 6 is out of range"},
      {R"({"robot": {"footprint": [[0.1, 0.1], [-0.1, 3], [0, -0.1]]}})", "/robot/footprint/1/1: 3 is out of range"},
      {R"({"robot": {"footprint": [[0.3, 0.1], [0.1, 0.1], [0.2, -0.1]]}})",
       "/robot/footprint: the robot's origin is not inside or level with it"},
  };
  for (const auto& [text, message] : kBad) {
    const auto robot = parse_robot(text, "robot.json");
    ASSERT_FALSE(robot.ok()) << text;
    EXPECT_TRUE(robot.error().starts_with("robot.json: ")) << robot.error();
    EXPECT_NE(robot.error().find(message), std::string::npos) << robot.error();
  }
}

}  // namespace
}  // namespace fencepost::host
