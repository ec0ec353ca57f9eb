#include "host/calibrate/findings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::host {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A parameter as people see it.
struct Row {
  std::size_t index;  ///< camera first, then wheels
  std::string_view key;
  std::string_view label;
  std::string_view unit;
  double scale;  ///< unit of the parameter / shown unit
  int decimals;
  double most;  ///< the largest sigma that is of use, in the parameter's unit
  bool essential;
  std::string_view motion;
};

// A sigma is of use if it changes the map by less than the map's own noise (a hybrid of 75 views;
// share/doc/calibrate.md).
constexpr std::array<Row, kCalibrated> kRows = {{
    {kFocal, "focal_length", "focal length", "px", 1, 2, 0.02, true,
     "turn once all the way around on the spot, so that the blocks seen first are seen again"},
    {kYaw, "yaw", "yaw", "deg", 1 / kDegree, 2, 1.0 * kDegree, true,
     "drive straight on for half a metre or more past blocks; turning on the spot tells nothing of it"},
    {kPitch, "pitch", "pitch", "deg", 1 / kDegree, 2, 1.0 * kDegree, true,
     "drive towards a block from 1.5 m to 0.4 m, its foot in view"},
    {kLatency, "latency", "latency", "ms", 1000, 1, 0.02, true,
     "turn left, then right, briskly; at an even speed and straight on late pictures look like early ones"},
    {kHeight, "mount_z", "mount height", "mm", 1000, 1, 0.006, false,
     "drive towards a block from 1.5 m to 0.4 m, its foot in view"},
    {kMountX, "mount_x", "mount ahead", "mm", 1000, 1, 0.010, false,
     "turn once around on the spot with blocks 0.4 m away"},
    {kMountY, "mount_y", "mount to the left", "mm", 1000, 1, 0.010, false,
     "turn once around on the spot with blocks 0.4 m away"},
    {kK1, "k1", "lens k1", "", 1, 4, 0.03, false, "let blocks wander from one side of the image to the other"},
    {place_of(kStep), "wheel_scale", "wheel scale", "%", 100, 2, 0.015, false,
     "give the width of a block (--size) or the distance of two (--distance)"},
    {place_of(kTurn), "turn_scale", "turn scale", "%", 100, 2, 0.01, false,
     "turn once all the way around on the spot, so that the blocks seen first are seen again"},
    {place_of(kCurve), "curve", "turn a metre", "deg", 1 / kDegree, 2, 1.2 * kDegree, false,
     "drive straight on for a metre or more with blocks in view"},
}};

/// A sigma above this share of the prior's is mostly the prior.
constexpr double kMostlyPrior = 0.5;

double prior_of(const CalibrationProblem& problem, std::size_t index) {
  return index < kCameraParameters ? problem.camera_sigma[index] : problem.wheel_sigma[index - kCameraParameters];
}

bool is_held(const SolverOptions& options, std::size_t index) {
  return index < kCameraParameters ? options.hold_camera[index] : options.hold_wheels[index - kCameraParameters];
}

double sigma_of(const CalibrationProblem& problem, const CalibratedMatrix& matrix, std::size_t index) {
  const double variance = matrix[index][index];
  return variance > 0 ? std::sqrt(variance) : prior_of(problem, index);
}

bool is_observed(const CalibrationProblem& problem, const CalibratedMatrix& matrix, const Row& row) {
  const double sigma = sigma_of(problem, matrix, row.index);
  return sigma <= row.most && sigma <= kMostlyPrior * prior_of(problem, row.index);
}

template <class Quantity>
Quantity within(double value, double low, double high) {
  return Quantity::nearest(std::clamp(value, low, high));
}

}  // namespace

double of_use(std::size_t index) { return std::ranges::find(kRows, index, &Row::index)->most; }

std::array<bool, kCalibrated> to_be_held(const CalibrationProblem& problem, const SolverOptions& impossible,
                                         const CalibratedMatrix& matrix) {
  std::array<bool, kCalibrated> held{};
  for (const Row& row : kRows) {
    held[row.index] = is_held(impossible, row.index) || (row.essential && !is_observed(problem, matrix, row));
  }
  return held;
}

std::vector<Finding> findings_of(const CalibrationProblem& problem, const Estimate& estimate,
                                 const CalibratedMatrix& matrix, const std::array<bool, kCalibrated>& held) {
  std::vector<Finding> findings;
  for (const Row& row : kRows) {
    Finding finding;
    finding.key = row.key;
    finding.label = row.label;
    finding.unit = row.unit;
    const bool of_camera = row.index < kCameraParameters;
    const double configured = of_camera ? problem.configured[row.index] : 0;
    const double found = of_camera ? estimate.camera[row.index] : estimate.wheels[row.index - kCameraParameters];
    finding.sigma = sigma_of(problem, matrix, row.index) * row.scale;
    finding.configured = configured * row.scale;
    finding.found = (held[row.index] ? configured : found) * row.scale;
    if (row.index == kFocal) {
      finding.configured = problem.optics.fx;
      finding.found = problem.optics.fx * std::exp(held[row.index] ? 0 : found);
      finding.sigma *= finding.found;
    }
    finding.decimals = row.decimals;
    finding.held = held[row.index];
    finding.observed = !finding.held && is_observed(problem, matrix, row);
    finding.essential = row.essential && (problem.rows || row.index != kPitch);
    finding.motion = row.motion;
    if (!problem.rows && (row.index == kPitch || row.index == kHeight)) {
      finding.motion = "tell the mount's height (z): without it rows are not used";
    }
    findings.push_back(finding);
  }
  return findings;
}

sensor::CameraIntrinsics calibrated(const sensor::CameraIntrinsics& configured, const Estimate& estimate,
                                    const std::array<bool, kCalibrated>& held) {
  constexpr double kLongest = 32'767;  // px, as the record has it
  sensor::CameraIntrinsics found = configured;
  const CameraValues& values = estimate.camera;
  if (!held[kFocal]) {
    found.fx = within<base::Pixels2>(configured.fx.to_double() * std::exp(values[kFocal]), 1, kLongest);
    found.fy = within<base::Pixels2>(configured.fy.to_double() * std::exp(values[kFocal]), 1, kLongest);
  }
  if (!held[kYaw]) found.mount.yaw = within<base::Radians>(values[kYaw], -7, 7);
  if (!held[kPitch]) found.mount.pitch = within<base::Radians>(values[kPitch], -0.7, 0.7);
  if (!held[kLatency]) found.latency = within<base::Duration>(values[kLatency], 0, 10);
  if (!held[kHeight]) found.mount.z = within<base::Metres>(values[kHeight], 0, 10);
  if (!held[kMountX]) found.mount.x = within<base::Metres>(values[kMountX], -10, 10);
  if (!held[kMountY]) found.mount.y = within<base::Metres>(values[kMountY], -10, 10);
  if (!held[kK1]) found.k1 = within<base::Ratio4>(values[kK1], -1, 1);
  return found;
}

}  // namespace fencepost::host
