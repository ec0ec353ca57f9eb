// Pieces of a long drive: laps around blocks that come and go, and the ways between two places.
#pragma once

#include <variant>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/odometry.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::test {

using Input = std::variant<sensor::OdometrySample, sensor::BlobFrame>;

/// One piece: what camera and wheels say from its start on, in order of arrival. Times and frame numbers begin at 0.
struct Piece {
  host::Scene scene;
  std::vector<Input> inputs;
  base::Duration length;  ///< a whole number of odometry periods
};

/// Once around `center` in 7.5 s, three blocks of those that tests/studies/identity draws for `seed`, low noise. The
/// robot starts and ends at the same place for every seed.
Piece make_lap(unsigned seed, host::Point center);

/// From the laps' start around one centre to that around another, 2 m/s, nothing to be seen.
Piece make_transfer(host::Point from, host::Point to);

}  // namespace fencepost::test
