// Drives that end where they begin, with the things beside them: the world of a run is a row of them.
#pragma once

#include <vector>

#include "firmware/record/records.hpp"
#include "host/emulate/scene/feed.hpp"
#include "host/emulate/scene/travel.hpp"
#include "host/scene/scene.hpp"
#include "tests/studies/storm/chance.hpp"

namespace fencepost::test {

struct Lap {
  explicit Lap(const host::Scene& scene);

  emulate::Feed feed;
  emulate::TravelLog travel;
  base::Duration length;  ///< from its first pose to the first one of the next
};

struct LapChoice {
  sensor::CameraIntrinsics camera;
  double rate = 10;  ///< images a second
  std::vector<record::Signature> signatures;
};

/// From the origin, heading 0, and back there at rest: towards something and away again, round a circle, or round on
/// the spot. Every second one comes nearer to something than a robot should.
host::Scene random_lap(Chance& chance, const LapChoice& choice);

}  // namespace fencepost::test
