// The scene that every board has to show: a scene goes in, its log replays to the same map and the same alerts.
#pragma once

#include <string>

#include "host/scene/scene.hpp"
#include "tests/boards/counting.hpp"
#include "tests/boards/emulator.hpp"

namespace fencepost::test {

/// GoogleTest expectations; `profile` is the one that the image has to say it was built with. `placed`: m, how far off
/// its truth an object may be; more where a small table has only just begun with it. `corrected`: the pose is.
void expect_scene_replays(const BoardUnderTest& board, const std::string& profile, const host::Scene& scene,
                          double placed = 0.08, PoseCorrected corrected = PoseCorrected::kNo);

}  // namespace fencepost::test
