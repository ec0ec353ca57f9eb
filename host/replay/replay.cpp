#include "host/replay/replay.hpp"

#include "host/replay/log_replay.hpp"

namespace fencepost::host {

ReplayOutcome replay(const LogSource& source, const std::string& name, const ReplayOptions& options) {
  LogReplay log(options);
  while (!log.ended()) {
    std::string_view bytes = source();
    if (bytes.empty()) break;
    while (!bytes.empty() && !log.ended()) log.take(bytes);
  }
  log.finish();
  return {log.now(), log.check(), log.complaints(), log.why_unreadable(name), log.runs()};
}

ReplayOutcome replay(std::string_view bytes, const std::string& name, const ReplayOptions& options) {
  const LogSource whole = [&bytes] { return std::exchange(bytes, {}); };
  return replay(whole, name, options);
}

}  // namespace fencepost::host
