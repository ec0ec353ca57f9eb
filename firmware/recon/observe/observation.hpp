// One blob of one frame, as tracking and models read it. It is built once a frame, after pieces of one object are
// joined. The state of each end of a blob is stored here and nowhere else.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/frame_queue.hpp"

namespace fencepost::recon {

/// How a side of a blob relates to the same side of its object.
enum class End : std::uint8_t {
  kSeen,        ///< the object's own edge
  kAmbiguous,   ///< an edge, but so near a neighbour or the border that it may be cut short: the hybrid, which can do
                ///< without, takes a lower bound; all others an edge
  kLowerBound,  ///< at the border or behind a neighbour: the object reaches at least to there
  kOccluded,    ///< another object's edge, or none
};

constexpr bool is_edge(End end) { return end == End::kSeen || end == End::kAmbiguous; }

struct Observation {
  Box box;  ///< px, as the camera sent it
  std::uint8_t signature = 0;
  bool moves : 1 = false;      ///< by itself, see WaitingBlob
  bool bearing : 1 = false;    ///< of the middle alone: all four ends are kOccluded
  std::uint8_t track : 6 = 0;  ///< id of a camera that tracks, see WaitingBlob; 0: none
  End left = End::kLowerBound;
  End right = End::kLowerBound;
  End top = End::kLowerBound;
  End bottom = End::kLowerBound;
  std::int16_t left_column = 0;  ///< px of the level, undistorted camera: comparable with predictions
  std::int16_t right_column = 0;
  std::uint16_t width = 0;  ///< mm, known of all things of its signature; 0: not known

  [[nodiscard]] int twice_middle() const { return left_column + right_column; }
  [[nodiscard]] int columns() const { return right_column - left_column; }
  [[nodiscard]] bool no_edge() const { return !is_edge(left) && !is_edge(right); }
};

using Observations = base::FixedVector<Observation, sensor::kMaxBlobs>;

/// A blob alone in the image: an end on the border is a lower bound, any other one is seen.
Observation observe_alone(const CameraModel& camera, const Box& box, std::uint8_t signature = 0);

/// A bearing in the image: the object's middle is there, and nothing is known of its ends.
Observation observe_bearing(const CameraModel& camera, const Box& box, std::uint8_t signature = 0);

/// All blobs of a frame. Ends that a nearer blob may hide are lower bounds; those near one, or near the border, are
/// ambiguous (occlusion.hpp).
void observe(std::span<const WaitingBlob> blobs, const CameraModel& camera, Observations& observations);

}  // namespace fencepost::recon
