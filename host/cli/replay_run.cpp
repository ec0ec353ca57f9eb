#include "host/cli/replay_run.hpp"

#include <fmt/format.h>

#include "host/cli/exit_code.hpp"
#include "host/cli/files.hpp"
#include "host/cli/terminal.hpp"
#include "host/import/import.hpp"
#include "host/scene/load.hpp"
#include "host/segment/setup_file.hpp"

namespace fencepost::host::cli {
namespace {

const char* reject_remedy(record::Reject reason) {
  switch (reason) {
    case record::Reject::kCrc: return "damaged on the way: check cable, baud rate and card";
    case record::Reject::kKind: return "unknown records: perhaps from a newer version";
    case record::Reject::kFields: return "wrong number of fields: check what writes them";
    case record::Reject::kNumber: return "not a plain decimal number: check what writes them";
    case record::Reject::kRange: return "values out of range: check units and the size in FPCAM";
    case record::Reject::kLength: return "longer than 1024 characters: line ends were lost";
    case record::Reject::kTruncated: return "the last line has no end: the recording was cut off";
    case record::Reject::kTime: return "time did not advance: two recordings in one, or a clock that jumped";
    case record::Reject::kFormat: return "of another format: use the release that wrote them";
  }
  return "";
}

void say_refused(const std::string& where, std::uint64_t count, const char* reason, const char* remedy) {
  if (count == 0) return;
  say(fmt::format("{}{} frame{} refused: {} ({})", where, count, count == 1 ? "" : "s", reason, remedy));
}

}  // namespace

ReplayOutcome replay_file(const std::string& path, const ReplayOptions& options) {
  ReplayOutcome outcome = replay(read_input(path), input_name(path), options);
  if (outcome.unreadable) throw Failure(Exit::kUnreadable, outcome.unreadable->message);
  return outcome;
}

Scene read_scene(const std::string& path) {
  const LoadedScene scene = parse_scene(read_input(path), input_name(path));
  if (!scene.ok()) throw Failure(Exit::kUnreadable, scene.error().message());
  return *scene;
}

sensor::CameraIntrinsics read_camera(const std::string& path) {
  try {
    return parse_camera(read_input(path), input_name(path));
  } catch (const ImportError& error) {
    throw Failure(Exit::kUnreadable, error.message());
  }
}

void say_what_was_left_out(const ReplayOutcome& outcome, const std::string& log_name) {
  const std::string where = log_name.empty() ? "" : log_name + ": ";
  const LogCounts& log = outcome.result.log;
  for (std::size_t i = 0; i < log.rejected.size(); ++i) {
    const auto reason = static_cast<record::Reject>(i);
    const RejectedLines& lines = log.rejected[i];
    if (lines.count == 0) continue;
    say(fmt::format("{}{} line{} rejected: {}, first in line {} ({})", where, lines.count, lines.count == 1 ? "" : "s",
                    record::name(reason), lines.first_line, reject_remedy(reason)));
  }
  say_refused(where, log.refused.no_pose, "no_pose", "no odometry at their exposure: check latency and clock");
  say_refused(where, log.refused.odometry_gap, "odometry_gap", "odometry paused for more than 0.5 s");
  say_refused(where, log.refused.no_camera, "no_camera", "no $FPCAM before them: give one with --camera");
  say_refused(where, log.refused.queue, "queue", "the log could not keep up: use a faster port");
  for (const std::string& complaint : outcome.complaints) say(where + complaint);
}

}  // namespace fencepost::host::cli
