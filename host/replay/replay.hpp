// A recorded stream through the robot's own loop, on the desk.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/sensor/camera.hpp"
#include "host/replay/pose_noise.hpp"
#include "host/replay/run_observer.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

struct ReplayOptions {
  std::string profile;                             ///< micro, small, full; empty: the log's FPHDR, else full
  std::optional<sensor::CameraIntrinsics> camera;  ///< in force from the start, for logs without FPCAM
  std::optional<double> from;                      ///< s, stream time; earlier records are not used
  std::optional<double> to;
  std::optional<std::uint64_t> frames;                          ///< stop after the N-th accepted frame record
  std::vector<std::pair<std::string, std::string>> settings{};  ///< key, value: in force whatever the log says
  std::optional<PoseNoise> pose_noise;                          ///< default: of a robot that drives, 4 mm and 7 mrad
  bool check = false;                          ///< compare logged FPOBJ, FPALR, FPALV, FPCAL and FPDIG with our own
  std::function<void(std::string_view)> text;  ///< gets each console sentence, without line end
  std::function<void(std::string_view)> log;   ///< gets each line of the log this run writes, with line end
  RunObserver* observer = nullptr;             ///< called for each frame that the map accepts
};

struct CheckOutcome {
  std::uint64_t compared = 0;
  std::vector<std::string> mismatches;  ///< "line 12: logged ..., own ..." (at most 20), see `differing`
  std::uint64_t differing = 0;
};

/// Why a stream could not be replayed at all; `message` says what, where and what to try.
struct Unreadable {
  std::string message;
};

struct ReplayOutcome {
  ResultDocument result;
  CheckOutcome check;
  std::vector<std::string> complaints;   ///< signatures or settings not taken, a doubtful camera: one sentence each
  std::optional<Unreadable> unreadable;  ///< set: empty or foreign input, other format, no usable frame
};

/// Replays the bytes of one log. A log of several runs (FPHDR) reports the last run's map; counts are of the whole.
/// `name` is used in messages only.
ReplayOutcome replay(std::string_view bytes, const std::string& name, const ReplayOptions& options);

}  // namespace fencepost::host
