// A recorded run through the robot's own loop, for programs of others: what `fencepost replay --json` does.
#pragma once

#include <string>
#include <string_view>

namespace fencepost {

struct Replayed {
  std::string document;  ///< the result document, JSON: host/share/doc/results.md; empty if it could not be replayed
  std::string error;     ///< why not, what is wrong and what to try; else empty
};

/// `log`: its bytes, not packed; `profile`: "micro", "small", "full" or, if empty, the log's own.
[[nodiscard]] Replayed replay(std::string_view log, const std::string& profile = {});

}  // namespace fencepost
