// The words for the state of a cable.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "hal/sensor/link_state.hpp"

namespace fencepost::console {

/// The words for one device in one state.
struct LinkWords {
  std::string_view name;    ///< for people: "camera"; empty: there is no sentence
  std::string_view device;  ///< of FPLNK; empty: it has no cable, nothing is reported
  std::string_view detail;  ///< of FPLNK, at most sensor::kMaxText characters, no comma
  std::string_view remedy;  ///< the thing to check
};

/// For a sensor that offers no words of its own: `name` is "camera" or "odometry".
LinkWords plain_link_words(std::string_view name, sensor::LinkState state);

/// A sensor whose owner knows more offers `link_words(state)`, of any type with the members of LinkWords.
template <class Source>
auto link_words(const Source& source, std::string_view name, sensor::LinkState state) {
  if constexpr (requires { source.link_words(state); }) {
    return source.link_words(state);
  } else {
    return plain_link_words(name, state);
  }
}

/// "camera is silent: check its power, ...\r\n". Returns the length, 0 if `out` is too small.
std::size_t describe_link(sensor::LinkState state, std::string_view name, std::string_view remedy, std::span<char> out);

}  // namespace fencepost::console
