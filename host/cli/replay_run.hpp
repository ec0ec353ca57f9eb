// Shared by replay, report and demo: read a log, replay it, and report what was not used.
#pragma once

#include <string>
#include <vector>

#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/replay/replay.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host::cli {

/// The bytes of a log that is replayed, and how far it is, for whoever waits.
class ReplayProgress {
 public:
  explicit ReplayProgress(LogInput& input) : input_(input) {}
  std::string_view next();

 private:
  LogInput& input_;
  Progress progress_{"replaying"};
};

/// In memory that does not grow with the log: of a long path as much as can be seen. errors: Failure (kUnreadable)
ReplayOutcome replay_input(LogInput& input, const std::string& path, ReplayOptions options);
ReplayOutcome replay_file(const std::string& path, const ReplayOptions& options);

/// errors: Failure (kUnreadable)
Scene read_scene(const std::string& path);

/// From a file with an FPCAM line, a scene, or JSON that has just its block "camera", as `segment` reads it. errors:
/// Failure (kUnreadable)
sensor::CameraIntrinsics read_camera(const std::string& path);

/// Rejected lines and refused frames by reason, each with its remedy, and other remarks on the log. Names the log where
/// there are several.
std::vector<std::string> what_was_left_out(const ReplayOutcome& outcome, const std::string& log_name = "");
/// The same to standard error.
void say_what_was_left_out(const ReplayOutcome& outcome, const std::string& log_name = "");

}  // namespace fencepost::host::cli
