#include "tests/studies/tables/given_run.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "firmware/config/profile.hpp"
#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/track/object.hpp"
#include "host/evaluate/cut.hpp"
#include "host/replay/models.hpp"
#include "tests/studies/tables/quality_run.hpp"

namespace fencepost::test {
namespace {

recon::Sighting sighting_of(const recon::CameraModel& camera, const recon::LensPose& lens, const GivenBlob& given) {
  const sensor::Blob& blob = given.blob;
  recon::Observation seen = recon::observe_alone(camera, {blob.x1, blob.y1, blob.x2, blob.y2});
  seen.left = given.left_hidden ? recon::End::kLowerBound : recon::End::kSeen;
  seen.right = given.right_hidden ? recon::End::kLowerBound : recon::End::kSeen;
  return recon::make_sighting(camera, lens, seen);
}

template <class Profile>
host::ObjectResult describe(const recon::Object<Profile>& object) {
  host::ObjectResult result;
  result.id = object.id;
  result.signature = object.signature;
  result.state = record::ObjectState::kConfirmed;
  result.views = object.views;
  result.confidence = object.hybrid().ok() ? static_cast<double>(object.hybrid().outline().confidence()) : 0;
  result.models = host::models_of(object);
  return result;
}

template <class Profile>
host::ObjectEvaluation follow(const Tour& tour, std::size_t truth) {
  const host::SceneObject& scene_object = tour.scene.objects[truth];
  host::ObjectEvaluation result;
  result.truth = truth;
  result.name = scene_object.name;
  result.signature = scene_object.signature;
  result.swaps = 0;
  const recon::CameraModel camera = recon::make_camera_model(tour.scene.camera);
  const auto object = std::make_unique<recon::Object<Profile>>();
  recon::HybridSolver<Profile::kHybridSectors, Profile::kHybridOrder> solver;
  for (std::size_t v = 0; v < tour.views.size(); ++v) {
    const GivenView& view = tour.views[v];
    const auto given =
        std::find_if(view.blobs.begin(), view.blobs.end(), [&](const GivenBlob& blob) { return blob.object == truth; });
    if (given == view.blobs.end()) continue;
    const recon::LensPose lens = recon::lens_pose(recon::to_map_pose(view.pose), camera);
    const recon::Sighting sighting = sighting_of(camera, lens, *given);
    const base::Time t = tour.frames[v].exposure;
    if (result.visible++ == 0) {
      object->begin(static_cast<std::uint32_t>(truth + 1), scene_object.signature, sighting, t);
    }
    object->track(sighting.left.end, sighting.right.end, t);
    object->model(sighting, {});
    if (object->hybrid().new_weight) solver.solve(object->hybrid());
    if (!std::binary_search(kTableViews.begin(), kTableViews.end(), object->views)) continue;
    result.cuts.push_back(host::cut_of(describe(*object), scene_object.footprint, false));
  }
  if (result.visible == 0) return result;
  result.found = {object->id, record::ObjectState::kConfirmed, object->views};
  result.cuts.push_back(host::cut_of(describe(*object), scene_object.footprint, true));
  return result;
}

template <class Profile>
host::Evaluation run_profile(const Tour& tour) {
  host::Evaluation evaluation;
  evaluation.frame_truth = true;
  evaluation.frames = tour.frames.size();
  evaluation.profile = std::string(Profile::kName);
  evaluation.swaps = 0;
  for (const host::ModelResult& model : host::models_of(*std::make_unique<recon::Object<Profile>>())) {
    evaluation.models.push_back(model.name);
  }
  for (std::size_t truth = 0; truth < tour.scene.objects.size(); ++truth) {
    evaluation.objects.push_back(follow<Profile>(tour, truth));
  }
  return evaluation;
}

}  // namespace

host::Evaluation run_given(const Tour& tour, const std::string& profile) {
  if (profile == config::Micro::kName) return run_profile<host::Compared<config::Micro>>(tour);
  if (profile == config::Small::kName) return run_profile<host::Compared<config::Small>>(tour);
  if (profile == config::Full::kName) return run_profile<host::Compared<config::Full>>(tour);
  throw std::runtime_error("profile " + profile + " is not known");
}

}  // namespace fencepost::test
