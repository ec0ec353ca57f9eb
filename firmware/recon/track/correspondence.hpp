// Which blob may be which object: by signature, predicted place and size in the image, and where its foot should be.
// Everything here is whole pixels of the level, undistorted camera: costs need no more, and a small part saves the
// room.
#pragma once

#include <cstdint>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "firmware/recon/track/assignment.hpp"
#include "firmware/recon/track/object.hpp"

namespace fencepost::recon {

/// One side of a predicted box: its column or row, the sigma of that, px.
struct PredictedLine {
  std::int16_t at = 0;
  std::int16_t sigma = 0;  ///< 0: not known
};

/// Where an object should appear, before any clipping to the image. Without a distance (depth 0) it is somewhere on its
/// last bearing: `left.at` is then the column of its middle if it is far away, `right.at` if it is as near as may be.
struct Prediction {
  PredictedLine left;
  PredictedLine right;
  PredictedLine top;
  PredictedLine bottom;
  std::int16_t left_tolerance = 0;  ///< px: farther off than this on average, the blob cannot be the object
  std::int16_t right_tolerance = 0;
  float depth = 0;  ///< m along the axis to its nearest point; 0: the distance is not known
  std::uint8_t signature = 0;
  bool confirmed = false;
  bool divided = false;   ///< it turned out to be two objects; nothing matches it
  bool possible = false;  ///< it can be in the image at all
  bool expected = false;  ///< well inside the image, near and well known: not seeing it means something
};

/// Whose prediction it is (signature, confirmed) is left to who asks.
/// By the circle `estimate`, in the object's local frame: its cylinder's, unless something knows better; else by the
/// last bearing.
Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const CylinderEstimate& estimate, const MeasurementNoise& noise);
/// By the outline where it is known well, else by the cylinder, else by the last bearing.
Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const PlacedOutline& outline, const MeasurementNoise& noise);

/// A blob as an interval that is comparable with predictions.
struct Interval {
  std::int16_t left = 0;
  std::int16_t right = 0;
  bool left_censored = true;
  bool right_censored = true;
  bool top_censored = true;
  bool bottom_censored = true;
};

Interval interval_of(const CameraModel& camera, const Box& box);

/// Cost of taking the blob for the object, 0 (perfect) to 200; kImpossible: it cannot be. The mean over the box's
/// visible sides of the squared deviation in units of three sigmas, at most 1 a side: place, size and shape in one. Of
/// `box` only the rows are used.
std::uint8_t match_cost(const Prediction& prediction, const Interval& interval, const Box& box);

/// True if the blob lies within the predicted interval, give or take three sigmas: it may be a piece of the object.
bool covers(const Prediction& prediction, const Interval& interval);

/// True if the blob's middle lies in the predicted interval, give or take a sigma.
bool has_middle_of(const Prediction& prediction, const Interval& interval);

/// Counts the frames in a row in which an end that was seen is more than three sigmas off, always to the same side.
/// `ends`: the blob's that are not this object's own.
void compare_ends(ObjectCore& object, const Prediction& prediction, const Interval& interval, const OpenEnds& ends);

/// True if the blob overlaps the predicted interval, tolerance left out: it may hide the object.
bool overlaps(const Prediction& prediction, const Interval& interval);

/// True if the blob is two objects of one signature that touch in the image: its ends are those of a left and of a
/// right object, and neither alone would be so wide. The distance of one of them must be known; the other one, without,
/// must have been seen last beside it.
bool shows_both(const Prediction& left, const Prediction& right, const Interval& interval, const Box& box);

/// True if the object, predicted nearer than `behind`, reaches over the blob's end at this column (px): that end is
/// then not the blob's own. `side` is -1 for the left end and 1 for the right one.
bool hides_end(const Prediction& nearer, const Prediction& behind, std::int16_t column, int side);

}  // namespace fencepost::recon
