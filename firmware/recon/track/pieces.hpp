// Two blobs of one object: a post in front of it cuts it in two, or the camera lost a part in the middle.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/track/correspondence.hpp"

namespace fencepost::recon {

struct PiecePair {
  std::uint8_t left = 0;
  std::uint8_t right = 0;
  bool found = false;
  bool rows_match = true;         ///< tops and feet are at one height: what one object's pieces have
  std::uint8_t whole = kNoMatch;  ///< the object that was expected as one blob; kNoMatch: a post explains the gap
};

/// The first pair of blobs of one signature that belong together, unless two objects are known to be there:
/// - a third, not farther blob fills the gap between them, and they have the same top and bottom rows; or
/// - one object is predicted that has the middles of both, with nothing between. Then the camera lost the middle, or
/// the
///   object is really two.
/// Predictions without signature are passed over.
PiecePair find_pieces(std::span<const Observation> blobs, std::span<const Prediction> predictions);

/// True if they have one signature and the same rows, and the gap between them is no wider than both together. The
/// camera may have lost a piece there.
bool are_alike(const Observation& one, const Observation& other);

/// Makes one box of a pair: from the left end of one to the right end of the other. Order is kept. If they are two
/// objects after all, the joined wedge is too wide: it carves less. Pieces with different ids are a box without one.
void join(base::FixedVector<WaitingBlob, sensor::kMaxBlobs>& blobs, const PiecePair& pair);

}  // namespace fencepost::recon
