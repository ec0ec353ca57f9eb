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

/// Gets the alerts of a replay instead of its result document: of a long run there may be many.
class AlertSink {
 public:
  virtual ~AlertSink() = default;
  /// A new run begins: earlier alerts were of the run before.
  virtual void run_begins() = 0;
  virtual void hear(const record::AlertReport& alert) = 0;
};

/// Poses of a path that nobody reads one by one: the drawn line, `path` of the result document. 4 MB.
inline constexpr std::size_t kPosesToShow = 1U << 17U;

struct ReplayOptions {
  std::string profile;                             ///< micro, small, full; empty: the log's FPHDR, else full
  std::optional<sensor::CameraIntrinsics> camera;  ///< in force from the start, for logs without FPCAM
  std::optional<double> from;                      ///< s, stream time; earlier records are not used
  std::optional<double> to;
  std::optional<std::uint64_t> frames;                          ///< stop after the N-th accepted frame record
  std::vector<std::pair<std::string, std::string>> settings{};  ///< key, value: in force whatever the log says
  std::optional<PoseNoise> pose_noise;                          ///< default: of a robot that drives, 4 mm and 7 mrad
  bool check = false;  ///< compare logged FPOBJ, FPALR, FPALV, FPSPD, FPCAL and FPDIG with our own
  std::function<void(std::string_view)> text;  ///< gets each console sentence, without line end
  std::function<void(std::string_view)> log;   ///< gets each line of the log this run writes, with line end
  RunObserver* observer = nullptr;             ///< called for each frame that the map accepts
  AlertSink* alerts = nullptr;
  std::optional<std::size_t> most_poses{};  ///< of the result's path: a longer one is thinned evenly; default: all
  std::optional<std::uint32_t> run{};       ///< the N-th of the log; default: its last
};

struct CheckOutcome {
  std::uint64_t compared = 0;
  std::vector<std::string> mismatches;  ///< "line 12: logged ..., own ..." (at most 20), see `differing`
  std::uint64_t differing = 0;
  std::uint64_t damaged = 0;        ///< lines that were, or may have been, one of those records, but cannot be read
  std::uint64_t first_damaged = 0;  ///< line number, 1-based
};

/// Why a stream could not be replayed at all; `message` says what, where and what to try.
struct Unreadable {
  std::string message;
};

struct ReplayOutcome {
  ResultDocument result;
  CheckOutcome check;
  std::vector<std::string> complaints;   ///< signatures or settings not taken, an implausible camera: one sentence each
  std::optional<Unreadable> unreadable;  ///< set: empty or foreign input, other format, no usable frame, no such run
  std::uint32_t runs = 0;                ///< that have begun; with `options.run` none after it is looked for
};

/// The next bytes of a log, in any portions; none at its end. They hold until the next call.
using LogSource = std::function<std::string_view()>;

/// Replays one log. Of several runs in it (FPHDR) the last, or `options.run`, is reported; counts are of all that was
/// read. `name` is used in messages only. In memory that does not grow with the log: a few tens of MB, and what
/// `options` has kept of path and alerts.
ReplayOutcome replay(const LogSource& source, const std::string& name, const ReplayOptions& options);
/// The same for bytes that are in memory.
ReplayOutcome replay(std::string_view bytes, const std::string& name, const ReplayOptions& options);

}  // namespace fencepost::host
