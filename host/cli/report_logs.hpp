// The logs of a report, each as much of it as the page has room for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/replay/replay.hpp"
#include "host/web/page.hpp"

namespace fencepost::host::cli {

/// Maximum bytes of a report: mail takes it, and a browser opens it at once.
inline constexpr std::size_t kMaxReport = 2'000'000;

struct ReportInputs {
  std::vector<std::string> logs;
  std::vector<std::optional<std::string>> scenes;  ///< the text of one for each log, or nothing
  ReplayOptions options;
  bool whole = false;  ///< all of each log, however long
};

/// A log, and the result of its replay.
struct ReportedLog {
  GivenLog given;
  ReplayOutcome outcome;
  std::string thinned;             ///< how much of it is in there; empty: all
  std::optional<Failure> failure;  ///< why nothing of it could be read
};

/// In the order given. Short logs are whole; the others share the rest of the room. Memory does not grow with a log.
/// One that cannot be read, or with `whole` is longer than a browser can take, has its failure.
std::vector<ReportedLog> read_report_logs(const ReportInputs& inputs, std::size_t page_size);

/// "logs/run.log" is "run.log".
std::string title_of(const std::string& log);

}  // namespace fencepost::host::cli
