// The seven noise levels of the published tables.
#pragma once

#include <array>
#include <string_view>

#include "host/scene/scene.hpp"

namespace fencepost::test {

struct NoiseLevel {
  std::string_view key;  ///< on the command line
  std::string_view name;
  host::SceneNoise noise;
};

const std::array<NoiseLevel, 7>& noise_levels();

}  // namespace fencepost::test
