#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/smooth/truth_par.hpp"

namespace fencepost::host::cli {

SmoothEvaluation smooth_log(const std::string& log, const Scene& scene, const EvaluateOptions& options) {
  SmoothOptions same;
  same.profile = options.profile;
  same.camera = options.camera;
  const SmoothOutcome outcome = smooth(read_log(log), log, same);
  if (outcome.replay.unreadable) throw Failure(Exit::kUnreadable, outcome.replay.unreadable->message);
  if (!outcome.smoothed) throw Failure(Exit::kUnreadable, outcome.refusal);
  return evaluate_smoothed(*outcome.smoothed, scene, log);
}

std::string with_smoothed(const std::string& text, bool json, const std::vector<SmoothEvaluation>& smoothed) {
  return json ? with_smooth_json(text, smoothed) : text + smooth_evaluation_text(smoothed);
}

}  // namespace fencepost::host::cli
