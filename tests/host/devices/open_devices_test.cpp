#include "host/devices/open_devices.hpp"

#include <gtest/gtest.h>

#include "host/devices/catalogue.hpp"
#include "tests/folder.hpp"
#include "tests/hal/linux/pty.hpp"

namespace fencepost::devices {
namespace {

using base::milliseconds;
using base::Time;
using host::CameraDevice;
using host::DeviceFailure;
using host::Devices;
using sensor::LinkState;

std::variant<Devices, DeviceFailure> open(const std::string& camera, const std::string& odometry, bool wait,
                                          const std::string& robot = "{}") {
  const auto camera_spec = parse_device(camera, Use::kCamera);
  const auto odometry_spec = parse_device(odometry, Use::kOdometry);
  EXPECT_TRUE(camera_spec.ok()) << camera;
  EXPECT_TRUE(odometry_spec.ok()) << odometry;
  return open_devices(*camera_spec, *odometry_spec, *host::parse_robot(robot, "robot.json"), linux::MonotonicClock(),
                      wait);
}

constexpr const char* kRobot = R"({"signatures": [{"id": 1, "rgb": "d02020"}],
  "colours": [{"signature": 1, "red": [0.6, 0.9], "green": [0.05, 0.2]}], "wheels": {"track": 0.2},
  "can": {"left": {"id": 1, "byte": 0, "scale": 0.001}, "right": {"id": 2, "byte": 0, "scale": 0.001}}})";

/// Names of a row at every place that it can have by itself, though nothing is plugged in.
std::vector<std::string> names_of(const Row& row, Use use) {
  std::vector<std::string> names;
  for (const PlaceKind place : places_of(row, use)) {
    switch (place) {
      case PlaceKind::kTty: names.push_back(*row.name + ":/dev/no"); break;
      case PlaceKind::kTcp: names.push_back(*row.name + ":tcp:127.0.0.1:1"); break;
      case PlaceKind::kI2c: names.push_back(*row.name + ":/dev/i2c-250"); break;
      case PlaceKind::kSpi: names.push_back(*row.name + ":/dev/spidev250.0"); break;
      case PlaceKind::kUsb: names.push_back(*row.name + ":usb,serial=none"); break;
      case PlaceKind::kCan: names.push_back(*row.name + ":nocan0"); break;
      case PlaceKind::kVideo: names.push_back(*row.name + ":/dev/video250"); break;
      case PlaceKind::kFilm:  // is there, or is not
      case PlaceKind::kNxt:
      case PlaceKind::kNone: break;
    }
  }
  return names;
}

std::vector<std::string> all_names(Use use) {
  std::vector<std::string> names;
  for (const Row* row : rows_for(use)) {
    for (const std::string& name : names_of(*row, use)) names.push_back(name);
  }
  return names;
}

TEST(OpenDevices, AwaitsEveryCameraAtEveryPlace) {
  const std::vector<std::string> names = all_names(Use::kCamera);
  ASSERT_GT(names.size(), 20U);
  for (const std::string& name : names) {
    auto opened = open(name, "console", true, kRobot);
    auto* devices = std::get_if<Devices>(&opened);
    ASSERT_NE(devices, nullptr) << name << ": " << std::get<DeviceFailure>(opened).message;
    EXPECT_TRUE(devices->intrinsics.has_value()) << name;
    for (int ms = 0; ms < 600; ms += 20) {
      devices->camera->tend(Time{} + milliseconds(ms));
      EXPECT_FALSE(devices->camera->poll(Time{} + milliseconds(ms)).ok());
    }
    EXPECT_EQ(devices->camera->link(), LinkState::kAbsent) << name;
    EXPECT_FALSE(devices->camera->problem().empty()) << name;
    EXPECT_TRUE(devices->camera->cabled()) << name << ": the console was opened instead";
    EXPECT_EQ(devices->camera->patience(), linux::kRetryInterval) << name << ": nothing to ask";
  }
}

TEST(OpenDevices, AwaitsEveryOdometryAtEveryPlace) {
  const std::vector<std::string> names = all_names(Use::kOdometry);
  ASSERT_GE(names.size(), 10U);
  for (const std::string& name : names) {
    auto opened = open("console", name, true, kRobot);
    auto* devices = std::get_if<Devices>(&opened);
    ASSERT_NE(devices, nullptr) << name << ": " << std::get<DeviceFailure>(opened).message;
    for (int ms = 0; ms < 600; ms += 20) {
      devices->odometry->tend(Time{} + milliseconds(ms));
      EXPECT_FALSE(devices->odometry->poll(Time{} + milliseconds(ms)).ok());
    }
    EXPECT_EQ(devices->odometry->link(), LinkState::kAbsent) << name;
    EXPECT_FALSE(devices->odometry->problem().empty()) << name;
    EXPECT_FALSE(devices->intrinsics.has_value()) << "the console tells it";
    EXPECT_EQ(devices->odometry->patience(), linux::kRetryInterval) << name;
  }
}

TEST(OpenDevices, ACameraBehindTheBrickSharesIt) {
  auto opened = open("nxtcam:nxt,port=2", "nxt:usb,serial=none", true);
  auto* devices = std::get_if<Devices>(&opened);
  ASSERT_NE(devices, nullptr);
  for (int ms = 0; ms < 600; ms += 20) {
    const Time now = Time{} + milliseconds(ms);
    devices->odometry->tend(now);
    EXPECT_FALSE(devices->odometry->poll(now).ok());
    EXPECT_FALSE(devices->camera->poll(now).ok());
  }
  EXPECT_EQ(devices->camera->link(), LinkState::kAbsent);
  EXPECT_EQ(devices->camera->problem(), devices->odometry->problem());
  EXPECT_EQ(devices->camera->patience(), linux::kRetryInterval);
}

TEST(OpenDevices, TheConsolesInputsAreSilentUntilOneCame) {
  auto opened = open("console", "console", false);
  auto* devices = std::get_if<Devices>(&opened);
  ASSERT_NE(devices, nullptr);
  EXPECT_EQ(devices->camera->link(), LinkState::kSilent);
  EXPECT_EQ(devices->odometry->link(), LinkState::kSilent);
  devices->camera->console_gave(0);
  devices->odometry->console_gave(1);
  EXPECT_EQ(devices->camera->link(), LinkState::kSilent);
  EXPECT_EQ(devices->odometry->link(), LinkState::kOk);
}

TEST(OpenDevices, WithoutWaitingAMissingDeviceIsAFailure) {
  for (const auto& [camera, odometry, message] :
       {std::tuple("pixy2:/dev/no", "console", "pixy2: cannot open the serial port /dev/no"),
        std::tuple("pixy2:/dev/i2c-250", "console", "/dev/i2c-250"),
        std::tuple("pixy2:tcp:127.0.0.1:1", "console", "nobody listens there"),
        std::tuple("console", "nxt:usb,serial=none", "0694:0002"),
        std::tuple("console", "create2:/dev/null", "create2: cannot open the serial port /dev/null"),
        std::tuple("v4l2:/dev/video250", "console", "v4l2: cannot open the camera /dev/video250"),
        std::tuple("v4l2:/dev/video250", "console", "v4l2-ctl --list-devices"),
        std::tuple("video:no.y4m", "console", "video: the film no.y4m cannot be read")}) {
    const auto opened = open(camera, odometry, false, kRobot);
    const auto* failure = std::get_if<DeviceFailure>(&opened);
    ASSERT_NE(failure, nullptr) << camera;
    EXPECT_FALSE(failure->usage);
    EXPECT_NE(failure->message.find(message), std::string::npos) << failure->message;
  }
}

TEST(OpenDevices, WhatMakesNoSenseIsUsageWhateverIsPluggedIn) {
  for (const auto& [camera, odometry, message] :
       {std::tuple("cmucam2:/dev/no", "console", "tracks no colour yet"),
        std::tuple("console", "can:can0", "add \"can\" to a --robot file"),
        std::tuple("nxtcam:nxt", "create1:/dev/no", "add --odometry nxt:usb"),
        std::tuple("console", "nxt:/dev/no,left=A,right=A", "the same motor"),
        std::tuple("v4l2:/dev/video0", "console", "no colour is trained"),
        std::tuple("pixy2:/dev/no", "create2:/dev/no", "cannot both have that port")}) {
    const auto opened = open(camera, odometry, true);
    const auto* failure = std::get_if<DeviceFailure>(&opened);
    ASSERT_NE(failure, nullptr) << camera;
    EXPECT_TRUE(failure->usage);
    EXPECT_NE(failure->message.find(message), std::string::npos) << failure->message;
  }
}

TEST(OpenDevices, TheRobotsNumbersLieOverTheCamerasProfile) {
  auto opened = open("pixy2.1:/dev/no", "console", true, R"({"camera": {"mount": {"z": 0.2}}})");
  const auto& intrinsics = std::get<Devices>(opened).intrinsics;
  ASSERT_TRUE(intrinsics.has_value());
  EXPECT_EQ(intrinsics->model.view(), "pixy2.1");
  EXPECT_EQ(intrinsics->fx.raw, 18'830);  // 158 / tan 40 deg
  EXPECT_EQ(intrinsics->mount.z.raw, 2'000);
  auto imager = open("cmucam2:/dev/no,imager=ov7620", "console", true, kRobot);
  EXPECT_EQ(std::get<Devices>(imager).intrinsics->width, 159);
}

TEST(OpenDevices, APortThatComesIsOpened) {
  const test::Folder folder;
  auto opened = open("xbc:" + folder.file("xbc"), "console", true);
  CameraDevice& camera = *std::get<Devices>(opened).camera;
  camera.tend(Time{});
  EXPECT_EQ(camera.link(), LinkState::kAbsent);
  const linux::FarEnd far(folder.file("xbc"));
  camera.tend(Time{} + milliseconds(249));
  EXPECT_EQ(camera.link(), LinkState::kAbsent) << "at most four times a second";
  camera.tend(Time{} + milliseconds(250));
  static_cast<void>(camera.poll(Time{} + milliseconds(250)));
  EXPECT_EQ(camera.link(), LinkState::kSilent);
  EXPECT_EQ(camera.problem(), "");
}

}  // namespace
}  // namespace fencepost::devices
