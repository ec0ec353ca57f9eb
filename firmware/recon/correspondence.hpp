// Which blob is which object: by signature and predicted place in the image.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware/recon/assignment.hpp"
#include "firmware/recon/camera_model.hpp"
#include "firmware/recon/object.hpp"
#include "firmware/recon/sighting.hpp"

namespace fencepost::recon {

/// Where an object should appear: columns in px, before any clipping to the image.
struct Prediction {
  bool possible = false;  ///< it can be in the image at all
  bool expected = false;  ///< it lies well inside the image, near and well known: not seeing it means something
  float left = 0;
  float right = 0;
  float left_tolerance = 0;  ///< px: how far this end may be off
  float right_tolerance = 0;
  float depth = 0;  ///< m along the axis; 0 unknown
};

Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const MeasurementNoise& noise);

/// A box as an interval of undistorted columns of the level camera (px), comparable with predictions.
struct Interval {
  float left = 0;
  float right = 0;
  bool left_censored = true;
  bool right_censored = true;
  bool bottom_censored = true;
};

Interval interval_of(const CameraModel& camera, const BlobRays& rays);

/// Cost of taking the blob for the object, 0 (perfect) to 200 (at the tolerance); kImpossible: it cannot be.
std::uint8_t match_cost(const Prediction& prediction, const Interval& interval);

/// True if the blob lies within the predicted interval plus tolerance: a piece of it, not a new object.
bool covers(const Prediction& prediction, const Interval& interval);

/// True if the blob overlaps the predicted interval, tolerance left out: it may hide the object.
bool overlaps(const Prediction& prediction, const Interval& interval);

}  // namespace fencepost::recon
