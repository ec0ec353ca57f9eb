// Which decoders are walked: each file of this folder names its own.
#pragma once

#include <string_view>
#include <vector>

#include "tests/drivers/states/walk.hpp"

namespace fencepost::test {

struct NamedWalk {
  std::string_view driver;   ///< its folder in drivers/, or firmware's
  std::string_view decoder;  ///< of those that it has
  Walked (*run)();
};

inline std::string name_of(const NamedWalk& walk) {
  return std::string(walk.driver) + ": " + std::string(walk.decoder);
}

struct RegisteredWalk {
  RegisteredWalk(std::string_view driver, std::string_view decoder, Walked (*run)());
};

/// All that registered themselves, by name.
const std::vector<NamedWalk>& named_walks();

}  // namespace fencepost::test
