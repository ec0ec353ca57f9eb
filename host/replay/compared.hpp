// The paper's models beside the robot's own: computed at the desk, for any profile, from the same sightings.
#pragma once

#include <type_traits>

#include "firmware/config/profile.hpp"
#include "firmware/recon/models/carving.hpp"
#include "firmware/recon/models/cylinder_paper.hpp"
#include "firmware/recon/models/sheaf.hpp"
#include "host/replay/evidence_carving.hpp"

namespace fencepost::host {

/// Views of the sheaf, 75: the paper's tour, whole; and the vertices of its hull.
inline constexpr std::size_t kSheafViews = 75;
inline constexpr std::size_t kSheafPosts = 192;

template <class Model>
inline constexpr bool kIsCarving = false;
template <std::size_t kCells, std::size_t kVertices, std::size_t kPending>
inline constexpr bool kIsCarving<recon::Carving<kCells, kVertices, kPending>> = true;

template <class Models>
inline constexpr bool kCarves = false;
template <class... Others>
inline constexpr bool kCarves<recon::ModelList<recon::Cylinder, Others...>> = (kIsCarving<Others> || ...);

/// A profile with more models. Its robot's state, decisions and digest are those of `Profile`: what is compared is no
/// part of them, and it sees the sightings that the robot's models take.
template <class Profile>
struct Compared : Profile {
  using Paper = recon::ModelList<recon::Cylinder, recon::CylinderPaper, recon::SheafViews<kSheafViews>, KeptTangents>;
  using PaperAndCarving = recon::ModelList<recon::Cylinder, recon::CylinderPaper, recon::SheafViews<kSheafViews>,
                                           KeptTangents, recon::Carving<128, 192, 64>>;
  using ComparisonModels = std::conditional_t<kCarves<typename Profile::Models>, Paper, PaperAndCarving>;
};

}  // namespace fencepost::host
