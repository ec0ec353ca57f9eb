#include "host/replay/replay.hpp"

#include "host/replay/log_replay.hpp"

namespace fencepost::host {

ReplayOutcome replay(std::string_view bytes, const std::string& name, const ReplayOptions& options) {
  LogReplay log(options);
  for (const char byte : bytes) {
    log.push(byte);
    if (log.ended()) break;
  }
  log.finish();
  return {log.now(), log.check(), log.complaints(), log.why_unreadable(name)};
}

}  // namespace fencepost::host
