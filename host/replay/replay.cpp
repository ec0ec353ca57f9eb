#include "host/replay/replay.hpp"

#include "host/replay/log_replay.hpp"

namespace fencepost::host {

ReplayOutcome replay(std::string_view bytes, const std::string& name, const ReplayOptions& options) {
  LogReplay log(options);
  while (!bytes.empty() && !log.ended()) log.take(bytes);
  log.finish();
  return {log.now(), log.check(), log.complaints(), log.why_unreadable(name)};
}

}  // namespace fencepost::host
