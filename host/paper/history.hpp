// The robot's models of one true object after each frame of a tour.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware/recon/observe/camera_model.hpp"
#include "host/paper/tour.hpp"
#include "host/render/solid.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// A blob that an object took.
struct TakenBlob {
  std::size_t frame = 0;  ///< index into Tour::frames
  recon::Box box;
  Colour colour;
};

/// One object at one moment.
struct Snapshot {
  std::size_t frames = 0;           ///< of the tour, so far
  std::uint32_t views = 0;          ///< in which it was seen
  double confidence = 0;            ///< the object's
  std::vector<ModelResult> models;  ///< none: not seen yet
  std::size_t taken = 0;            ///< of History::blobs, so far
};

struct History {
  std::vector<Snapshot> snapshots;  ///< one for each of the frame counts asked for
  std::vector<TakenBlob> blobs;
};

/// With given data association and occlusion: each view of `object` goes directly to the robot's object (profile full).
/// `after`: ascending frame counts. Blobs of several objects are left out.
History follow_given(const Tour& tour, std::size_t object, const std::vector<std::size_t>& after);

/// Runs the log through the whole pipeline. For each of the scene's objects: the states of the map's object that is
/// matched to it at the end. One that is not found has empty snapshots.
std::vector<History> follow_inferred(const Tour& tour, const std::vector<std::size_t>& after);

/// The model `name` of a snapshot, raised to a height band, in the mean colour of the blobs taken so far. The band is
/// what the model's own distance gives the rows of those blobs (median over the views). Without area if the model has
/// none.
Solid solid_of_model(const Tour& tour, const History& history, const Snapshot& snapshot, std::string_view name,
                     std::size_t object);

}  // namespace fencepost::host
