// The models of one object as polygons of the map frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/track/object.hpp"
#include "host/replay/compared.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// 64 vertices, the circle's area. Map frame.
ModelResult cylinder_model(const recon::ObjectCore& object);
ModelResult cylinder_paper_model(const recon::ObjectCore& object, const recon::CylinderPaper& paper);

/// The exact polygon of wedges; `name` is clip or clip_paper.
ModelResult clip_model(const recon::ObjectCore& object, std::string name, std::span<const recon::Vec2> vertices);

/// The convex hull of a sheaf's posts; `name` is sheaf or sheaf_paper.
ModelResult sheaf_model(const recon::ObjectCore& object, std::string name, std::span<const recon::Vec2> hull,
                        recon::SheafRefusal refusal);

/// The fitted outline, moved out where it is uncertain; its sides are open where no edge is among `clusters`. While
/// views wait for a fit that will change it much, the object's cylinder.
ModelResult hybrid_model(const recon::ObjectCore& object, const recon::HybridCore& hybrid,
                         const recon::OutlineView& outline, recon::ConstClusters clusters);

/// Outline of the solid cells, holes included; `name` is carve or carve_paper.
ModelResult carve_model(const recon::ObjectCore& object, std::string name, const recon::GridPlacement& placement,
                        std::size_t cells, std::span<const std::uint32_t> words);

/// Puts models into the order of the result document.
void sort_models(std::vector<ModelResult>& models);

/// The result document's form of each type of model. A further type needs a further function here, or it does not
/// compile.
inline void add_results(const recon::ObjectCore& object, const recon::CylinderPaper& paper,
                        std::vector<ModelResult>& models) {
  models.push_back(cylinder_paper_model(object, paper));
}
template <std::size_t kViews>
void add_results(const recon::ObjectCore& object, const recon::SheafViews<kViews>& views,
                 std::vector<ModelResult>& models) {
  recon::PlaneSheaf<kViews, kSheafPosts> sheaf;
  sheaf.build_paper(views.view());
  models.push_back(sheaf_model(object, "sheaf_paper", sheaf.hull(), sheaf.refusal()));
  sheaf.build(views.view());
  models.push_back(sheaf_model(object, "sheaf", sheaf.hull(), sheaf.refusal()));
}
template <std::size_t kCells, std::size_t kVertices, std::size_t kPending>
void add_results(const recon::ObjectCore& object, const recon::Carving<kCells, kVertices, kPending>& carving,
                 std::vector<ModelResult>& models) {
  models.push_back(carve_model(object, "carve_paper", carving.grid().placement(), kCells, carving.grid().words()));
  models.push_back(clip_model(object, "clip_paper", carving.clip().vertices()));
}
template <class Profile>
void add_results(const recon::Object<Profile>& object, const KeptTangents& kept, std::vector<ModelResult>& models) {
  // Fitted to the end here: on a small profile the outline may be some frames behind the tangents.
  auto hybrid = object.hybrid();
  std::make_unique<recon::HybridSolver<Profile::kHybridSectors, Profile::kHybridOrder>>()->solve(hybrid);
  const Carved carved = carve_with(kept.tangents(), Evidence(hybrid, hybrid.outline(), object.origin));
  models.push_back(carve_model(object, "carve", carved.grid.placement(), Carved::kCells, carved.grid.words()));
  models.push_back(clip_model(object, "clip", carved.clip.vertices()));
}
template <std::size_t kSectors>
void add_results(const recon::ObjectCore& object, const recon::Hybrid<kSectors>& hybrid,
                 std::vector<ModelResult>& models) {
  models.push_back(hybrid_model(object, hybrid, hybrid.outline(), hybrid.clusters));
}

/// All models of the profile, the robot's own and those compared with them, in the order of the result document.
template <class Profile>
std::vector<ModelResult> models_of(const recon::Object<Profile>& object) {
  std::vector<ModelResult> models{cylinder_model(object)};
  const auto add = [&](const auto& model) { add_results(object, model, models); };
  object.models.for_each(add);
  object.comparison.for_each(add);
  sort_models(models);
  return models;
}

}  // namespace fencepost::host
