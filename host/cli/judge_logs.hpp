// Logs against their scenes, as many at once as there are cores.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/smooth/truth_par.hpp"

namespace fencepost::host::cli {

/// What of the command's options each log is judged by.
struct JudgeRequest {
  std::vector<std::string> logs;
  std::vector<std::string> scenes;
  std::string camera;
  std::vector<std::string> models;
  std::size_t jobs = 0;  ///< 0: as many as there are cores
  bool smooth = false;
  EvaluateOptions options;
};

/// What became of one log.
struct Judged {
  std::optional<Evaluation> evaluation;
  std::optional<SmoothEvaluation> smoothed;
  std::vector<std::string> said;
  std::optional<Failure> failure;
};

/// In the order of the logs, whatever the number of jobs.
std::vector<Judged> judge_logs(const JudgeRequest& request);

/// Leaves the other models out. errors: Failure (kUsage): there is none of that name
void keep_models(Evaluation& evaluation, const std::vector<std::string>& names);

}  // namespace fencepost::host::cli
