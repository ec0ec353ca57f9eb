// Why a log's distances are wrong: the few configured numbers whose errors explain what its sightings contradict.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/calibrate/drive_log.hpp"
#include "host/calibrate/parameters.hpp"

namespace fencepost::host {

enum class CauseKind : std::uint8_t { kFocal, kYaw, kPitch, kLatency, kHeight, kStep, kTurn, kCurve, kPad, kWidth };

struct Cause {
  CauseKind kind = CauseKind::kPad;
  std::optional<std::uint8_t> signature{};  ///< of kPad, kWidth; without one it is of all
  double configured = 0;                    ///< px, rad, s, m; wheels: 0; widths: m
  double found = 0;                         ///< wheels: the share, or rad a metre, that reported ways and turns lack
  double sigma = 0;
  std::size_t objects = 0;
  std::size_t sightings = 0;
  std::vector<CauseKind> or_else{};  ///< other explanations that this log does not exclude
};

struct Causes {
  std::vector<Cause> causes{};
  bool is_part = false;   ///< more was seen than is judged
  double moving = 0;      ///< share of the boxes that are of things that move
  bool sideways = false;  ///< the robot moves so, and nothing is judged
  bool several = false;   ///< one alone explains too little: the model may be wrong, and none is named
};

// A fault lasts: the beginning shows it, and a minute more only costs.
inline constexpr double kJudgedSeconds = 60;
inline constexpr double kMaxMoving = 0.1;  ///< of `moving`; with more nothing is judged, as others may move, too
inline constexpr std::size_t kJudgedObjects = 12;  ///< those seen most

/// The cause that explains what a log contradicts. It is off by more than three sigmas, and by more than maps notice.
/// Empty where the log contradicts nothing, or does not say.
Causes find_causes(DriveLog log);

}  // namespace fencepost::host
