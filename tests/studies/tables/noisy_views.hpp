// A perfect frame through the reference's camera: one blob an object, with the noise of a level, and the truth about
// it.
#pragma once

#include <vector>

#include "host/scene/scene.hpp"
#include "host/simulate/truth.hpp"
#include "tests/studies/common/noise_levels.hpp"

namespace fencepost::test {

/// One object's blob in one view. Only a test knows more of it than the blob.
struct GivenBlob {
  sensor::Blob blob;
  std::size_t object = 0;     ///< index into Scene::objects: whose it is, or whose place it takes
  bool left_hidden = false;   ///< this end is no edge of the object: the image border or a nearer object cuts it
  bool right_hidden = false;  ///< noise does not count: a lost piece hides nothing
  bool is_false = false;      ///< something else, taken for the object; its ends count as edges
};

/// Of `perfect`, simulated without noise, the widest piece of each object counts if it has two columns. Draws depend on
/// scene.seed, the frame and the object only: the same at every level.
std::vector<GivenBlob> noisy_view(const host::Scene& scene, const host::FrameTruth& perfect, const BlobNoise& noise);

/// The frame as a camera would send it, with whose blobs these are: largest first.
host::FrameTruth frame_of(const host::FrameTruth& perfect, std::vector<GivenBlob> blobs);

}  // namespace fencepost::test
