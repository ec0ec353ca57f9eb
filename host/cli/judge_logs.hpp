// Logs against their scenes, as many at once as there are cores.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/smooth/smooth_evaluation.hpp"

namespace fencepost::host::cli {

struct EvaluateRequest {
  std::vector<std::string> logs;
  std::vector<std::string> scenes;
  std::string camera;
  std::string profile;
  std::vector<std::string> models;
  std::vector<std::uint32_t> views = {2, 4, 8, 18, 75};
  std::size_t jobs = 0;  ///< 0: as many as there are cores
  std::vector<std::string> merge;
  std::optional<double> max_recklessness;
  std::optional<double> max_paranoia;
  bool smooth = false;
  bool json = false;
  bool part = false;
  std::string output = "-";
};

/// The outcome of one log.
struct Judged {
  std::optional<Evaluation> evaluation;
  std::optional<SmoothEvaluation> smoothed;
  std::vector<std::string> said;
  std::optional<Failure> failure;
};

/// In the order of the logs, whatever the number of jobs.
std::vector<Judged> judge_logs(const EvaluateRequest& request, const EvaluateOptions& options);

/// Leaves the other models out. errors: Failure (kUsage): there is none of that name
void keep_models(Evaluation& evaluation, const std::vector<std::string>& names);

}  // namespace fencepost::host::cli
