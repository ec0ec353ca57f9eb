// --robot FILE.json: the numbers that are true of one robot. The layout is in share/doc/live.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/can_wheels/wheels.hpp"
#include "drivers/cmucam/config.hpp"
#include "drivers/odometry/wheel_base.hpp"
#include "drivers/segmenter/camera.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/result.hpp"
#include "host/scene/camera_numbers.hpp"

namespace fencepost::host {

/// The file's numbers of the wheels; the rest stays as the driver has it.
struct WheelNumbers {
  std::optional<std::int64_t> left_pm_per_count;  ///< negative: counts down when driving forward
  std::optional<std::int64_t> right_pm_per_count;
  std::optional<std::int64_t> track_pm;
  std::optional<int> counter_bits;
  std::optional<std::int32_t> max_speed_mm_s;

  [[nodiscard]] odometry::WheelBase over(odometry::WheelBase wheels) const;
};

struct RobotFile {
  CameraNumbers camera;
  std::vector<record::Signature> signatures;
  std::vector<cmucam::ColourWindow> windows;  ///< of "windows", else 40 to either side of each signature's colour
  base::FixedVector<segmenter::ColourRange, segmenter::kMaxRanges> colours;  ///< of cameras that deliver pictures
  std::vector<std::pair<std::string, std::string>> settings;  ///< keys and values as on the console, checked
  WheelNumbers wheels;
  std::optional<can_wheels::Mapping> can;
};

/// errors: "robot.json: /wheels/track: what is wrong; what to do"
base::Result<RobotFile, std::string> parse_robot(std::string_view text, const std::string& name);

}  // namespace fencepost::host
