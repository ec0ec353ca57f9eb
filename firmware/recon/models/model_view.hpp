// The input of a model: one sighting.
#pragma once

#include "firmware/recon/observe/sighting.hpp"

namespace fencepost::recon {

struct ModelView {
  const Sighting& sighting;
  MapPoint origin;    ///< of the object's local frame
  float novelty = 1;  ///< in (0, 1]: the weight of the view; less for what a stationary robot sees again
  const MeasurementNoise& noise;
};

}  // namespace fencepost::recon
