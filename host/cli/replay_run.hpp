// Shared by replay, report and demo: read a log, replay it, and report what was not used.
#pragma once

#include <string>

#include "host/replay/replay.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host::cli {

/// errors: Failure (kUnreadable)
ReplayOutcome replay_file(const std::string& path, const ReplayOptions& options);

/// errors: Failure (kUnreadable)
Scene read_scene(const std::string& path);

/// From a file with an FPCAM line, a scene, or JSON that has just its block "camera", as `segment` reads it. errors:
/// Failure (kUnreadable)
sensor::CameraIntrinsics read_camera(const std::string& path);

/// To standard error: rejected lines and refused frames by reason, each with what to do about it; of which log, where
/// there are several.
void say_what_was_left_out(const ReplayOutcome& outcome, const std::string& log_name = "");

}  // namespace fencepost::host::cli
