// Settings in an image: the robot's own store reads exactly the settings that were written.
#include "host/configure/configure.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/config/about_image.hpp"
#include "firmware/config/settings_store.hpp"
#include "hal/mcu/about_board.hpp"

namespace fencepost::host {
namespace {

using config::CameraId;
using config::OdometryId;

constexpr std::uint32_t kFlash = 0x0800'0000;
constexpr std::uint32_t kSettings = 0x0800'4000;
constexpr std::uint32_t kPage = 1024;

template <class About>
void append(std::vector<std::uint8_t>& bytes, const About& about) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&about);  // a little-endian desk, as the parts are
  bytes.insert(bytes.end(), begin, begin + sizeof about);
}

// Twenty bytes of program, then what it says of itself; with cameras 0 to 4 and two lines.
ImageMemory image(std::uint32_t settings = kSettings, std::uint32_t cameras = 0b11111, std::uint32_t page = kPage) {
  config::DeviceLimits limits{cameras, 0b1111, true, 8, false, config::Devices(CameraId::kPixy2, OdometryId::kConsole)};
  std::vector<std::uint8_t> bytes(20, 0xB5);
  append(bytes, mcu::about_board("testboard", kFlash, settings, page));
  append(bytes, config::about_image("0.1.0", 2, limits));
  ImageMemory memory;
  EXPECT_TRUE(memory.put(0, bytes));
  return memory;
}

struct Pages {
  const ImageMemory& memory;
  std::uint32_t settings = kSettings;

  [[nodiscard]] static std::size_t size() { return kPage; }
  [[nodiscard]] std::span<const std::uint8_t> page(std::size_t n) const {
    return memory.bytes().subspan(settings - memory.begin() + n * kPage, kPage);
  }
  static bool program(std::size_t /*n*/, std::size_t /*offset*/, std::span<const std::uint8_t> /*bytes*/) {
    return false;
  }
  static bool erase(std::size_t /*n*/) { return false; }
};

std::string kept(const ImageMemory& memory, std::uint32_t settings = kSettings) {
  Pages pages{memory, settings};
  config::SettingsStore store(pages);
  std::string text;
  store.load([&](std::string_view line) { text += std::string(line.substr(0, line.find('*'))) + "\n"; });
  return text;
}

RobotFile robot(std::string_view json) {
  const auto file = parse_robot(json, "robot.json");
  EXPECT_TRUE(file.ok()) << file.error();
  return *file;
}

std::string wrong(const ConfigureRequest& request, const ImageMemory& memory = image()) {
  const auto configured = configure(memory, request);
  return configured.ok() ? "taken" : configured.error();
}

TEST(Configure, WritesDevicesSettingsCalibrationAndColours) {
  ConfigureRequest request;
  request.settings = {{"camera", "pixy2.1"}, {"odometry", "encoders"}, {"alert.warn", "0.7"}};
  request.robot = robot(R"({"camera": {"mount": {"x": 0.05, "z": 0.12, "pitch": 0}},
                           "signatures": [{"id": 1, "name": "red", "rgb": "d02020", "pad": 4}],
                           "wheels": {"metres_per_tick": 0.0003222, "track": 0.155},
                           "settings": {"alert.stop": 0.3, "alert.warn": 0.6}})");
  const auto configured = configure(image(), request);
  ASSERT_TRUE(configured.ok()) << configured.error();
  EXPECT_EQ(configured->board, "testboard");
  EXPECT_EQ(configured->version, "0.1.0");
  EXPECT_EQ(configured->memory.begin(), kFlash);
  EXPECT_EQ(configured->memory.at(kFlash), 0xB5);
  const std::string text = kept(configured->memory);
  EXPECT_TRUE(text.starts_with("$FPCFG,camera,pixy2.1\n$FPCFG,odometry,encoders\n$FPCFG,wheel.diameter,")) << text;
  EXPECT_NE(text.find("\n$FPCFG,wheel.track,155.0\n$FPCFG,alert.stop,0.30\n$FPCFG,alert.warn,0.70\n"
                      "$FPCAM,pixy2.1,316,208,188.30,188.30,157.50,103.50,0.0000,0.0500,0.0000,0.1200,0.0000,0.0000,"
                      "0.0330\n$FPSIG,1,d02020,red,,4\n"),
            std::string::npos)
      << text;
  EXPECT_GT(configured->used, 200U);
  EXPECT_EQ(configured->room, kPage);
  for (std::uint32_t at = 0; at < kPage; ++at) {
    ASSERT_TRUE(configured->memory.known(kSettings + kPage + at)) << "or an older page stays the newest";
    ASSERT_EQ(configured->memory.at(kSettings + kPage + at), 0xFF);
  }
}

// Of six cameras on a board with one line, one is at an address that is too low for it.
TEST(Configure, ChoicesAreWhatCanBeConfigured) {
  const auto found = choices(image(kSettings, 1U << 0U | 1U << 1U | 1U << 3U | 1U << 9U | 1U << 12U | 1U << 19U));
  ASSERT_TRUE(found.ok()) << found.error();
  EXPECT_EQ(found->board, "testboard");
  EXPECT_TRUE(found->dfu && !found->uf2 && !found->cartridge);
  std::string text;
  for (const ImageChoices::Camera& camera : found->cameras) {
    text += camera.name + (camera.delivered ? " delivered:" : ":");
    for (const std::string& odometry : camera.odometries) text += " " + odometry;
    text += "\n";
  }
  EXPECT_EQ(text,
            "console: console encoders create1 create2\n"
            "pixy2 delivered: console encoders\n"
            "pixy2_i2c delivered: console encoders create1 create2\n"
            "huskylens delivered: console encoders\n"
            "jevois delivered: console encoders\n");
  EXPECT_EQ(found->initial.front(), std::pair(std::string("camera"), std::string("pixy2")));
  EXPECT_FALSE(choices(ImageMemory()).ok());
}

TEST(Configure, WheelsAreAWheelWithSuchTicks) {
  ConfigureRequest request;
  request.robot = robot(R"({"wheels": {"metres_per_tick": -0.00012345}})");
  const auto configured = configure(image(), request);
  ASSERT_TRUE(configured.ok()) << configured.error();
  config::Devices devices;
  for (const std::string& line : configured->configured) {
    const std::size_t comma = line.find(',', 7);
    ASSERT_FALSE(devices.set(line.substr(7, comma - 7), line.substr(comma + 1, line.find('*') - comma - 1))) << line;
  }
  EXPECT_NEAR(static_cast<double>(devices.wheels(16).left_pm_per_count), -123'450'000.0, 123.0);
}

TEST(Configure, ANewChoiceReplacesTheOld) {
  ConfigureRequest request;
  request.settings = {{"camera", "pixy2.1"}};
  const auto first = configure(image(), request);
  ASSERT_TRUE(first.ok());
  request.settings = {{"lens", "75"}};
  const auto second = configure(first->memory, request);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(kept(second->memory), "$FPCFG,lens,75\n");
  EXPECT_EQ(kept(configure(image(), {})->memory), "");
}

TEST(Configure, ACartridgeHasAMemoryOfItsOwn) {
  ConfigureRequest request;
  request.settings = {{"alert.stop", "0.3"}};
  const auto configured = configure(image(0x0E00'0000), request);
  ASSERT_TRUE(configured.ok()) << configured.error();
  EXPECT_TRUE(configured->cartridge);
  EXPECT_EQ(configured->memory.bytes().size(), 32U * 1024);
  EXPECT_EQ(kept(configured->memory, 0x0E00'0000), "$FPCFG,alert.stop,0.30\n");
}

TEST(Configure, RefusesWhatTheRobotWould) {
  EXPECT_EQ(wrong({{{"camera", "pixy2"}, {"odometry", "create2"}}, {}, {}}).substr(0, 88),
            "testboard cannot have the camera pixy2 with the odometry create2: camera and wheel base ");
  EXPECT_EQ(wrong({{{"camera", "pixi2"}}, {}, {}}),
            "the image of testboard has no camera \"pixi2\"; did you mean pixy2? it has console, pixy2, pixy2.1, "
            "pixy2_i2c, pixy2.1_i2c");
  EXPECT_EQ(wrong({{{"camera", "xbc"}}, {}, {}}).substr(0, 43), "the image of testboard has no camera \"xbc\";");
  EXPECT_EQ(wrong({{{"odometry", "wheels"}}, {}, {}}),
            "the image of testboard has no odometry \"wheels\"; it has console, encoders, create1, create2");
  EXPECT_EQ(wrong({{{"lens", "200"}}, {}, {}}), "lens=200 is not possible; it takes 0 to 150 deg");
  EXPECT_EQ(wrong({{{"alert.stop", "40"}}, {}, {}}), "alert.stop=40 is not possible; it takes 0.00 to 10.00 m");
  EXPECT_EQ(wrong({{{"alert.stopp", "1"}}, {}, {}}).substr(0, 61),
            "there is no setting \"alert.stopp\"; did you mean alert.stop? `");
}

TEST(Configure, SaysWhatDoesNotFit) {
  ConfigureRequest request;
  request.robot =
      robot(R"({"signatures": [{"id": 1, "name": "a", "rgb": "d02020"}, {"id": 2, "name": "b", "rgb": "20d020"},
                                           {"id": 3, "name": "c", "rgb": "2020d0"}]})");
  EXPECT_EQ(wrong(request), "there are 3 signatures, the image has room for 2; leave some out");
  request = {};
  request.robot = robot(R"({"wheels": {"left_metres_per_tick": 0.0001, "right_metres_per_tick": 0.0002}})");
  EXPECT_EQ(wrong(request), "/wheels: a board's two wheels are alike; give \"metres_per_tick\" for both");
  EXPECT_EQ(wrong({{{"camera", "pixy2.1"}, {"alert.stop", "0.3"}}, {}, {}}, image(kSettings, 0b11111, 64)),
            "the settings do not fit into the 64 bytes that testboard has for them; leave some out");
  request = {};
  request.calibration = config::delivered_calibration(CameraId::kHuskylens);
  EXPECT_EQ(wrong(request),
            "the calibration is of 320x240 pixels, the camera pixy2 has 316x208; name the camera that it is of");
}

// As large as each other, and through another lens: taken for a Pixy2, a Pixy2.1 stops too late.
TEST(Configure, ACalibrationIsOfTheCameraThatIsThere) {
  ConfigureRequest request;
  request.settings = {{"camera", "pixy2.1"}};
  request.robot = robot(R"({"camera": {"model": "pixy2", "width": 316, "height": 208, "fx": 273.6, "fy": 273.6,
                                       "cx": 157.5, "cy": 103.5}})");
  EXPECT_EQ(wrong(request), "the calibration is of a pixy2, the camera is pixy2.1; name the camera that it is of");
  request.settings = {{"camera", "pixy2_i2c"}};
  EXPECT_EQ(wrong(request), "taken");
  request.robot = robot(R"({"camera": {"width": 320}})");
  EXPECT_EQ(wrong(request).substr(0, 35), "the calibration is of 320x208 pixel");
}

TEST(Configure, TakesOnlyAnImageOfOurs) {
  ImageMemory other;
  ASSERT_TRUE(other.put(0, std::vector<std::uint8_t>(5'000, 0x42)));
  EXPECT_EQ(wrong({}, other), "this is no image of Fencepost, or one of a version that cannot be configured");
  const ImageMemory whole = image();
  ImageMemory cut;
  ASSERT_TRUE(cut.put(0, whole.bytes().first(whole.bytes().size() - 8)));
  EXPECT_EQ(wrong({}, cut), "the file is cut off in what the image says of itself");
  EXPECT_EQ(wrong({}, image(kSettings, 0)), "what the image says of itself is damaged");
}

}  // namespace
}  // namespace fencepost::host
