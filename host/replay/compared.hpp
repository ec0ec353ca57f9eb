// The paper's models beside the robot's own: computed at the desk, for any profile, from the same sightings.
#pragma once

#include <type_traits>

#include "firmware/config/profile.hpp"
#include "hal/base/vectors.hpp"
#include "host/models/carving.hpp"
#include "host/models/cylinder_paper.hpp"
#include "host/models/evidence_carving.hpp"
#include "host/models/outline_batch.hpp"
#include "host/models/sheaf.hpp"

namespace fencepost::host {

/// Views of the sheaf: the paper's whole tour.
inline constexpr std::size_t kSheafViews = 75;
inline constexpr std::size_t kSheafPosts = 192;  ///< vertices of its hull

/// A profile with more models for comparison. They are no part of its robot: state, decisions and digest are those of
/// `Profile`. They see the sightings that the robot's models take.
template <class Profile>
struct Compared : Profile {
  /// 75 views of a round object leave a polygon of at most 154 vertices.
  using ComparisonModels = recon::ModelList<recon::Cylinder, recon::CylinderPaper, recon::SheafViews<kSheafViews>,
                                            KeptTangents, recon::Carving<128, 192, 64>>;
  using OutlineBatch =
      std::conditional_t<base::kLaneVectors && Profile::kHybridSteps == 0, recon::OutlineBatch, recon::NoBatch>;
};

}  // namespace fencepost::host
