// The predicted box of each object in the next frame: columns and rows of the level, undistorted camera in whole
// pixels. Matching needs no more, and a small part saves the room.
#pragma once

#include <cstdint>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "firmware/recon/track/object.hpp"

namespace fencepost::recon {

/// One side of a predicted box: its column or row, the sigma of that, px.
struct PredictedLine {
  std::int16_t at = 0;
  std::int16_t sigma = 0;  ///< 0: not known
};

/// Where an object should appear, before any clipping to the image. Without a distance (depth 0) it is somewhere on its
/// last bearing. `left.at` is then the column of its middle at the greatest distance, `right.at` at the least.
struct Prediction {
  PredictedLine left;
  PredictedLine right;
  PredictedLine top;
  PredictedLine bottom;
  std::int16_t left_tolerance = 0;  ///< px: farther off than this on average, the blob cannot be the object
  std::int16_t right_tolerance = 0;
  std::int16_t foot_row = 0;  ///< px, of the last sighting, if the robot is stationary since; 0: not, or it may move
  bool refuted = false;       ///< it should have been seen and was not
  float depth = 0;            ///< m along the axis to its nearest point; 0: the distance is not known
  std::uint8_t signature = 0;
  std::uint8_t last_track = 0;  ///< see ObjectCore
  bool confirmed = false;
  bool hides = false;     ///< confirmed, and its ends are known: it cuts things behind it
  bool divided = false;   ///< it turned out to be two objects; nothing matches it
  bool possible = false;  ///< it can be in the image
  bool anywhere = false;  ///< even where it is predicted, a blob is as likely of something new of its colour
  bool expected = false;  ///< well inside the image, near and well known: not seeing it means something
};

/// Predicts by the circle `estimate`, in the object's local frame: its cylinder, unless a better place is known; else
/// by the last bearing. The caller sets signature, confirmed and hides.
Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const CylinderEstimate& estimate, const MeasurementNoise& noise);
/// By the outline where it is known well, else by the cylinder, else by the last bearing.
Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const PlacedOutline& outline, const MeasurementNoise& noise);

}  // namespace fencepost::recon
