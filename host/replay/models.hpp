// The models of one object as polygons of the map frame.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "firmware/recon/track/object.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// 64 vertices, the circle's area. Map frame.
ModelResult cylinder_model(const recon::ObjectCore& object);
ModelResult cylinder_paper_model(const recon::ObjectCore& object, const recon::CylinderPaper& paper);
ModelResult clip_model(const recon::ObjectCore& object, std::span<const recon::Vec2> vertices);

/// The convex hull of a sheaf's posts; `name` is sheaf or sheaf_paper.
ModelResult sheaf_model(const recon::ObjectCore& object, std::string name, std::span<const recon::Vec2> hull,
                        recon::SheafRefusal refusal);

/// The fitted outline, moved out where it is uncertain.
ModelResult hybrid_model(const recon::HybridCore& hybrid, const recon::OutlineView& outline);

/// Outline of the solid cells, holes included.
ModelResult carve_model(const recon::ObjectCore& object, const recon::GridPlacement& placement, std::size_t cells,
                        std::span<const std::uint32_t> words);

/// All models of the profile, in the order of the result document.
template <class Profile>
std::vector<ModelResult> models_of(const recon::Object<Profile>& object) {
  std::vector<ModelResult> models{cylinder_model(object)};
  if constexpr (Profile::kPaperCylinder) models.push_back(cylinder_paper_model(object, object.cylinder_paper));
  if constexpr (Profile::kSheafViews > 0) {
    recon::PlaneSheaf<Profile::kSheafViews, Profile::kSheafPosts> sheaf;
    sheaf.build_paper(object.sheaf.view());
    models.push_back(sheaf_model(object, "sheaf_paper", sheaf.hull(), sheaf.refusal()));
    sheaf.build(object.sheaf.view());
    models.push_back(sheaf_model(object, "sheaf", sheaf.hull(), sheaf.refusal()));
  }
  if constexpr (Profile::kGridCells > 0) {
    models.push_back(carve_model(object, object.grid.placement(), Profile::kGridCells, object.grid.words()));
  }
  models.push_back(clip_model(object, object.clip.vertices()));
  models.push_back(hybrid_model(object.hybrid, object.hybrid.outline()));
  return models;
}

}  // namespace fencepost::host
