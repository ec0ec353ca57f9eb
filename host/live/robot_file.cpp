#include "host/live/robot_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/config/colours.hpp"
#include "firmware/config/settings.hpp"
#include "host/live/robot_can.hpp"
#include "host/scene/read_scene.hpp"

namespace fencepost::host {
namespace {

/// [least, greatest]
JsonNode read_pair(const JsonNode& node, std::string_view channel) {
  JsonNode pair = node.at(channel);
  if (pair.size(2, "numbers") > 2) pair.fail("has more than two numbers", "give [least, greatest]");
  return pair;
}

void read_range(const JsonNode& node, std::string_view channel, std::uint8_t& low, std::uint8_t& high) {
  const JsonNode range = read_pair(node, channel);
  low = static_cast<std::uint8_t>(range.at(std::size_t{0}).integer(0, 255));
  high = static_cast<std::uint8_t>(range.at(std::size_t{1}).integer(0, 255));
  if (low > high) range.fail("the least is above the greatest", "swap them");
}

std::vector<cmucam::ColourWindow> read_windows(const JsonNode& node) {
  std::vector<cmucam::ColourWindow> windows;
  const std::size_t count = node.size(1, "windows");
  if (count > cmucam::kMaxWindows) {
    node.fail("there are " + std::to_string(count) + " windows", "give at most " + std::to_string(cmucam::kMaxWindows));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode one = node.at(i);
    one.expect_keys({"signature", "red", "green", "blue"});
    cmucam::ColourWindow& window = windows.emplace_back();
    window.signature = static_cast<std::uint8_t>(one.at("signature").integer(0, 255));
    read_range(one, "red", window.red_min, window.red_max);
    read_range(one, "green", window.green_min, window.green_max);
    read_range(one, "blue", window.blue_min, window.blue_max);
  }
  return windows;
}

void read_shares(const JsonNode& node, std::string_view channel, base::Ratio4& low, base::Ratio4& high) {
  const JsonNode range = read_pair(node, channel);
  low = base::Ratio4::nearest(range.at(std::size_t{0}).number(0, 1, ""));
  high = base::Ratio4::nearest(range.at(std::size_t{1}).number(0, 1, ""));
  if (low > high) range.fail("the least is above the greatest", "swap them");
}

void read_colours(const JsonNode& node, RobotFile& robot) {
  const std::size_t count = node.size(1, "colours");
  if (count > segmenter::kMaxRanges) {
    node.fail("there are " + std::to_string(count) + " colours",
              "give at most " + std::to_string(segmenter::kMaxRanges));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const JsonNode one = node.at(i);
    one.expect_keys({"signature", "red", "green", "brightness"});
    segmenter::ColourRange range;
    range.signature = static_cast<std::uint8_t>(one.at("signature").integer(1, 255));
    read_shares(one, "red", range.red_min, range.red_max);
    read_shares(one, "green", range.green_min, range.green_max);
    if (one.find("brightness")) read_range(one, "brightness", range.brightness_min, range.brightness_max);
    (void)robot.colours.push_back(range);
  }
}

std::int64_t read_step(const JsonNode& node) {
  const double metres = node.number(-1, 1, "m");
  const auto step = static_cast<std::int64_t>(std::llround(metres * kPicometresPerMetre));
  if (step == 0) node.fail("is 0", "give the way of the wheel's rim per tick, in metres");
  return step;
}

WheelNumbers read_wheels(const JsonNode& node) {
  node.expect_keys(
      {"metres_per_tick", "left_metres_per_tick", "right_metres_per_tick", "track", "counter_bits", "max_speed"});
  WheelNumbers wheels;
  if (const auto both = node.find("metres_per_tick")) {
    wheels.left_pm_per_count = wheels.right_pm_per_count = read_step(*both);
  }
  if (const auto left = node.find("left_metres_per_tick")) wheels.left_pm_per_count = read_step(*left);
  if (const auto right = node.find("right_metres_per_tick")) wheels.right_pm_per_count = read_step(*right);
  constexpr double kWidest = 9;  // m, drivers/odometry
  if (const auto track = node.find("track")) {
    wheels.track_pm = static_cast<std::int64_t>(std::llround(track->positive(kWidest, "m") * kPicometresPerMetre));
  }
  if (const auto bits = node.find("counter_bits")) wheels.counter_bits = static_cast<int>(bits->integer(2, 32));
  if (const auto speed = node.find("max_speed")) {
    wheels.max_speed_mm_s = static_cast<std::int32_t>(std::lround(speed->positive(100, "m/s") * 1000));
  }
  return wheels;
}

class SettingReader {
 public:
  void set(const JsonNode& node, const std::string& key, const std::string& value) {
    const auto error = settings_.set(key, value);
    if (!error) {
      taken_.emplace_back(key, value);
    } else if (*error == config::SettingError::kUnknownKey) {
      node.fail("there is no setting \"" + key + "\"", "share/doc/console.md lists them");
    } else {
      node.fail("\"" + value + "\" is not possible", "share/doc/console.md has the ranges");
    }
  }
  std::vector<std::pair<std::string, std::string>> taken() { return std::move(taken_); }

 private:
  config::Settings settings_;
  std::vector<std::pair<std::string, std::string>> taken_;
};

std::string metres_text(int hundredths) {
  const std::string cents = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + (cents.size() < 2 ? ".0" : ".") + cents;
}

void read_settings(const JsonNode& root, SettingReader& reader) {
  if (const auto robot = root.find("robot")) {
    const RobotBody body = read_robot_body(*robot);
    for (const std::string key : {"front", "rear", "width"}) {
      if (const auto member = robot->find(key)) reader.set(*member, "robot." + key, member->written());
    }
    if (!body.footprint.empty()) {
      const BodyRectangle rectangle = rectangle_around(body.footprint);
      const JsonNode footprint = robot->at("footprint");
      reader.set(footprint, "robot.front", metres_text(rectangle.front));
      reader.set(footprint, "robot.rear", metres_text(rectangle.rear));
      reader.set(footprint, "robot.width", metres_text(rectangle.width));
    }
  }
  const auto settings = root.find("settings");
  if (!settings) return;
  settings->expect_object();
  for (const std::string& key : settings->keys()) {
    const JsonNode member = settings->at(key);
    const std::string written = member.written();
    reader.set(member, key,
               member.is_text()     ? member.text()
               : written == "true"  ? "on"
               : written == "false" ? "off"
                                    : written);
  }
}

RobotFile read_robot(const JsonNode& root) {
  // The last six are of scenes: a scene file serves too.
  root.expect_keys({"camera", "signatures", "robot", "wheels", "can", "windows", "colours", "settings", "format",
                    "seed", "objects", "path", "odometry", "noise"});
  RobotFile robot;
  if (const auto camera = root.find("camera")) robot.camera = read_camera_numbers(*camera);
  if (const auto signatures = root.find("signatures")) {
    for (const SceneSignature& read : read_signatures(*signatures)) robot.signatures.push_back(read.recorded());
  }
  if (const auto windows = root.find("windows")) {
    robot.windows = read_windows(*windows);
  } else {
    const std::size_t count = std::min(robot.signatures.size(), cmucam::kMaxWindows);
    for (std::size_t i = 0; i < count; ++i) robot.windows.push_back(config::window_around(robot.signatures[i]));
  }
  if (const auto colours = root.find("colours")) read_colours(*colours, robot);
  if (const auto wheels = root.find("wheels")) robot.wheels = read_wheels(*wheels);
  if (const auto can = root.find("can")) robot.can = read_can(*can, robot.wheels);
  SettingReader settings;
  read_settings(root, settings);
  robot.settings = settings.taken();
  return robot;
}

}  // namespace

odometry::WheelBase WheelNumbers::over(odometry::WheelBase wheels) const {
  wheels.left_pm_per_count = left_pm_per_count.value_or(wheels.left_pm_per_count);
  wheels.right_pm_per_count = right_pm_per_count.value_or(wheels.right_pm_per_count);
  wheels.track_pm = track_pm.value_or(wheels.track_pm);
  wheels.counter_bits = counter_bits.value_or(wheels.counter_bits);
  wheels.max_speed_mm_s = max_speed_mm_s.value_or(wheels.max_speed_mm_s);
  return wheels;
}

base::Result<RobotFile, std::string> parse_robot(std::string_view text, const std::string& name) {
  try {
    return read_robot(JsonText(text, "share/doc/live.md shows a robot file").root());
  } catch (const SceneProblem& problem) {
    return name + ": " + problem.where + ": " + problem.what + "; " + problem.remedy;
  }
}

}  // namespace fencepost::host
