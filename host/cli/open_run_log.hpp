// The log of `run` and of `record --camera`, written beside the loop.
#pragma once

#include <memory>
#include <utility>

#include "host/cli/exit_code.hpp"
#include "host/live/run_log.hpp"

namespace fencepost::host::cli {

/// errors: Failure (kDevice)
inline std::unique_ptr<WriteBehind> open_run_log(const RunLogSettings& settings, base::Time now) {
  linux::Opened<RunLog> opened = RunLog::open(settings, now);
  if (!opened) throw Failure(Exit::kDevice, opened.problem());
  return std::make_unique<WriteBehind>(std::make_unique<RunLog>(std::move(*opened)));
}

}  // namespace fencepost::host::cli
