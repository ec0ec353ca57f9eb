// `status` and `objects`, line by line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/alert/obstacle.hpp"
#include "firmware/config/devices.hpp"
#include "firmware/console/console_state.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/console/links.hpp"
#include "firmware/recon/models/next_view.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::console {

/// The facts that `status` reports.
struct StatusFacts {
  std::string_view profile;
  Mode mode = Mode::kText;
  bool alerts = true;
  Links links;
  const Counters& counters;
  std::optional<base::Time> time{};                  ///< of the stream
  const sensor::CameraIntrinsics* camera = nullptr;  ///< the calibration in force, if any
  std::optional<recon::MapPose> robot{};
  std::uint32_t objects = 0;
  std::uint32_t confirmed = 0;
  std::uint32_t capacity = 0;
  std::uint64_t digest = 0;
  record::CalibrationDoubt doubt{};
  const config::Devices* devices = nullptr;
  const config::DeviceOffer* offer = nullptr;  ///< where devices are chosen
};

/// One more where devices are chosen, and one while the camera's calibration seems wrong.
constexpr std::size_t status_lines(const record::CalibrationDoubt& doubt, bool offered) {
  return 6 + (offered ? 1U : 0U) + (doubt.doubt == record::Doubt::kNone ? 0U : 1U);
}
std::size_t write_status(std::size_t line, const StatusFacts& facts, std::span<char> out);

std::size_t write_objects_head(std::span<char> out);
/// `what` is missing, and why that may be.
std::size_t write_none(std::string_view what, const StatusFacts& facts, std::span<char> out);
/// One object as the robot sees it at time `now`.
std::size_t write_object(char letter, const recon::ObjectCore& object, std::string_view name,
                         const alert::Obstacle& seen, base::Time now, std::span<char> out);

/// From where to look at an object next; `origin` is that of the outline's frame.
std::size_t write_next(const recon::ObjectCore& object, std::string_view name, const recon::NextView& next,
                       recon::MapPoint origin, std::span<char> out);

}  // namespace fencepost::console
