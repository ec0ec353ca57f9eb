#include "host/cli/replay_run.hpp"

#include <fmt/format.h>

#include "host/cli/exit_code.hpp"
#include "host/cli/files.hpp"
#include "host/cli/terminal.hpp"
#include "host/import/import.hpp"
#include "host/scene/load.hpp"
#include "host/segment/setup_file.hpp"
#include "host/text/plural.hpp"

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

std::string megabytes(std::uint64_t bytes) { return fmt::format("{} MB", bytes / 1'000'000); }

}  // namespace

std::string_view ReplayProgress::next() {
  const auto done = static_cast<double>(input_.position());
  if (input_.size()) progress_.at(done, static_cast<double>(*input_.size()));
  if (!input_.size()) progress_.at(megabytes(input_.position()));
  return input_.next();
}

ReplayOutcome replay_input(LogInput& input, const std::string& path, ReplayOptions options) {
  if (!options.most_poses) options.most_poses = kPosesToShow;
  ReplayProgress progress(input);
  ReplayOutcome outcome = replay([&] { return progress.next(); }, input_name(path), options);
  if (outcome.unreadable) throw Failure(Exit::kUnreadable, outcome.unreadable->message);
  return outcome;
}

ReplayOutcome replay_file(const std::string& path, const ReplayOptions& options) {
  LogInput input(path);
  return replay_input(input, path, options);
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

std::vector<std::string> what_was_left_out(const ReplayOutcome& outcome, const std::string& log_name) {
  const std::string where = log_name.empty() ? "" : log_name + ": ";
  const LogCounts& log = outcome.result.log;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < log.rejected.size(); ++i) {
    const auto reason = static_cast<record::Reject>(i);
    const RejectedLines& rejected = log.rejected[i];
    if (rejected.count == 0) continue;
    lines.push_back(fmt::format("{}{} rejected: {}, first in line {} ({})", where, plural(rejected.count, "line"),
                                record::name(reason), rejected.first_line, reject_remedy(reason)));
  }
  const auto refused = [&](std::uint64_t count, const char* reason, const char* remedy) {
    if (count == 0) return;
    lines.push_back(fmt::format("{}{} refused: {} ({})", where, plural(count, "frame"), reason, remedy));
  };
  refused(log.refused.no_pose, "no_pose", "no odometry at their exposure: check latency and clock");
  refused(log.refused.odometry_gap, "odometry_gap", "odometry paused for more than 0.5 s");
  refused(log.refused.no_camera, "no_camera", "no $FPCAM before them: give one with --camera");
  refused(log.refused.queue, "queue", "the log could not keep up: use a faster port");
  if (outcome.runs > 1) {
    lines.push_back(
        fmt::format("{}this is run {} of the log; replay --run N shows an earlier one", where, outcome.runs));
  }
  for (const std::string& complaint : outcome.complaints) lines.push_back(where + complaint);
  return lines;
}

void say_what_was_left_out(const ReplayOutcome& outcome, const std::string& log_name) {
  for (const std::string& line : what_was_left_out(outcome, log_name)) say(line);
}

}  // namespace fencepost::host::cli
