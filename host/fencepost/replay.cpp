#include "host/fencepost/replay.hpp"

#include "host/replay/replay.hpp"
#include "host/result/to_json.hpp"

namespace fencepost {

Replayed replay(std::string_view log, const std::string& profile) {
  if (!profile.empty() && profile != "micro" && profile != "small" && profile != "full") {
    return {{}, "'" + profile + "' is no profile; take micro, small or full"};
  }
  host::ReplayOptions options;
  options.profile = profile;
  const host::ReplayOutcome outcome = host::replay(log, "the log", options);
  if (outcome.unreadable) return {{}, outcome.unreadable->message};
  return {host::to_json(outcome.result), {}};
}

}  // namespace fencepost
