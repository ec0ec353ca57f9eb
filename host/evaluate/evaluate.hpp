// One log against its scene. The measures and their definitions are in share/doc/evaluate.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "host/evaluate/frame_truths.hpp"
#include "host/replay/replay.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// A true object seen in at least this many frames counts as missed if it was not found.
inline constexpr std::uint64_t kVisibleFrames = 20;

struct EvaluateOptions {
  std::vector<std::uint32_t> views = {2, 4, 8, 18, 75};  ///< ascending, each once
  std::string profile;                                   ///< as ReplayOptions
  std::optional<sensor::CameraIntrinsics> camera;        ///< as ReplayOptions
};

struct EvaluateOutcome {
  Evaluation evaluation;
  ReplayOutcome replay;  ///< `unreadable` set: nothing was measured
};

/// `log` holds the bytes; `name` is used in messages only.
EvaluateOutcome evaluate(std::string_view log, const std::string& name, const Scene& truth,
                         const EvaluateOptions& options);
/// The same, read in portions and in memory that does not grow with it: the replay's result has neither alerts nor
/// path.
EvaluateOutcome evaluate(const LogSource& log, const std::string& name, const Scene& truth,
                         const EvaluateOptions& options);
/// The same for a log whose frames the scene alone does not give; `frame_truths` knows them.
EvaluateOutcome evaluate(std::string_view log, const std::string& name, const Scene& truth,
                         const FrameTruths& frame_truths, const EvaluateOptions& options);

/// Means over all objects of all logs, each with its standard error.
Summary summarise(std::span<const Evaluation> evaluations, const std::vector<std::uint32_t>& views);

}  // namespace fencepost::host
