// `status` and `objects`, line by line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/alert/obstacle.hpp"
#include "firmware/console/console_state.hpp"
#include "firmware/loop/memory.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::app {

/// The two sensors' cables.
struct Links {
  sensor::LinkState camera = sensor::LinkState::kAbsent;
  sensor::LinkState odometry = sensor::LinkState::kAbsent;
};

/// What `status` tells.
struct StatusFacts {
  std::string_view profile;
  Mode mode = Mode::kText;
  bool alerts = true;
  Links links;
  const Run& run;
  const Counters& counters;
  const Calibration& calibration;
  std::optional<recon::MapPose> robot{};
  std::uint32_t objects = 0;
  std::uint32_t confirmed = 0;
  std::uint32_t capacity = 0;
  std::uint64_t digest = 0;
};

inline constexpr std::size_t kStatusLines = 6;
std::size_t write_status(std::size_t line, const StatusFacts& facts, std::span<char> out);

std::size_t write_objects_head(std::span<char> out);
/// `what` is missing, and why that may be.
std::size_t write_none(std::string_view what, const StatusFacts& facts, std::span<char> out);
/// One object as the robot sees it at time `now`.
std::size_t write_object(char letter, const recon::ObjectCore& object, std::string_view name, const Obstacle& seen,
                         base::Time now, std::span<char> out);

}  // namespace fencepost::app
