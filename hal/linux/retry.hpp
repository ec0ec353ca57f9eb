// How often a missing device is looked for.
#pragma once

#include <optional>

#include "hal/base/units.hpp"

namespace fencepost::linux {

/// Too short to be noticed by a person who plugs something in; a failing open costs nothing at this rate.
inline constexpr base::Duration kRetryInterval = base::milliseconds(250);

class Retry {
 public:
  /// Whether the caller may try now. The first call may, later ones once an interval; a clock set back may too.
  [[nodiscard]] bool due(base::Time now) {
    if (last_ && now >= *last_ && now - *last_ < kRetryInterval) return false;
    last_ = now;
    return true;
  }

 private:
  std::optional<base::Time> last_;
};

}  // namespace fencepost::linux
