// Monotonic time of the robot. Read once per step by the caller, passed down as an argument ever after.
#pragma once

#include <concepts>

#include "hal/base/units.hpp"

namespace fencepost::bus {

template <class T>
concept Clock = requires(const T& clock) {
  { clock.now() } -> std::same_as<base::Time>;
};

}  // namespace fencepost::bus
