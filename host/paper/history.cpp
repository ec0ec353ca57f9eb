#include "host/paper/history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "firmware/config/profile.hpp"
#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "host/evaluate/matching.hpp"
#include "host/geometry/median.hpp"
#include "host/render/regions.hpp"
#include "host/replay/models.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host {
namespace {

using FullObject = recon::Object<Compared<config::Full>>;

recon::Box box_of(const sensor::Blob& blob) { return {blob.x1, blob.y1, blob.x2, blob.y2}; }

/// Index of the widest blob that is this object's alone.
std::optional<std::size_t> widest_blob(const FrameTruth& frame, std::size_t object) {
  std::optional<std::size_t> widest;
  int width = 0;
  for (std::size_t b = 0; b < frame.blobs.size(); ++b) {
    const sensor::Blob& blob = frame.frame.blobs[b];
    if (frame.blobs[b].object != object || !frame.blobs[b].others.empty() || blob.x2 - blob.x1 < width) continue;
    width = blob.x2 - blob.x1 + 1;
    widest = b;
  }
  return widest;
}

recon::Sighting sighting_of(const recon::CameraModel& camera, const sensor::OdometrySample& pose,
                            const sensor::Blob& blob, HiddenEnds hidden) {
  recon::Observation seen = recon::observe_alone(camera, box_of(blob));  // noise may move an end to the border
  if (hidden.left) seen.left = recon::End::kLowerBound;
  if (hidden.right) seen.right = recon::End::kLowerBound;
  return recon::make_sighting(camera, recon::lens_pose(recon::to_map_pose(pose), camera), seen);
}

/// Keeps the map's objects after the requested frames.
class Follower final : public RunObserver {
 public:
  Follower(const Tour& tour, const std::vector<std::size_t>& after) : tour_(tour), after_(after) {
    for (std::size_t f = 0; f < tour.frames.size(); ++f) numbers_[tour.frames[f].frame.frame] = f;
  }

  void run_begins() override {
    histories_.clear();
    latest_.clear();
  }
  void frame_placed(const PlacedFrame& placed) override {
    const auto named = numbers_.find(placed.frame.frame);
    if (named == numbers_.end()) return;
    const std::size_t frame = named->second;
    for (const PlacedSighting& sighting : placed.sightings) {
      const recon::WaitingBlob& blob = placed.frame.blobs[sighting.blob];
      histories_[sighting.id].blobs.push_back({frame, blob.box, colour_in(frame, blob.box)});
      if (snapshots_before_end()) latest_[sighting.id] = placed.describe(sighting.id);
    }
    if (!std::binary_search(after_.begin(), after_.end(), frame + 1)) return;
    for (const auto& [id, object] : latest_) {
      History& history = histories_[id];
      history.snapshots.push_back({frame + 1, object.views, object.confidence, object.models, history.blobs.size()});
    }
  }
  /// `last`: the object as it is at the end. Snapshots are empty where it was not yet seen.
  [[nodiscard]] History history(const ObjectResult& last) const {
    const auto found = histories_.find(last.id);
    if (found == histories_.end()) return nothing();
    const History& kept = found->second;
    History whole{{}, kept.blobs};
    for (const std::size_t frames : after_) {
      Snapshot& snapshot = whole.snapshots.emplace_back();
      snapshot.frames = frames;
      for (const Snapshot& one : kept.snapshots) {
        if (one.frames == frames) snapshot = one;
      }
      if (frames == tour_.frames.size()) {
        snapshot = {frames, last.views, last.confidence, last.models, kept.blobs.size()};
      }
    }
    return whole;
  }
  [[nodiscard]] History nothing() const {
    History history;
    for (const std::size_t frames : after_) history.snapshots.push_back({frames, 0, 0, {}, 0});
    return history;
  }

 private:
  // Describing an object costs as much as all its models.
  [[nodiscard]] bool snapshots_before_end() const { return !after_.empty() && after_.front() < tour_.frames.size(); }
  // The colour of the camera's largest region inside the box: the robot may have joined several.
  [[nodiscard]] Colour colour_in(std::size_t frame, const recon::Box& box) const {
    for (const Region& region : tour_.images[frame].regions) {
      const bool inside = region.left > box.x1 - 1 && region.right < box.x2 + 1 && region.top > box.y1 - 1 &&
                          region.bottom < box.y2 + 1;
      if (inside && region.colour) return *region.colour;
    }
    return {};
  }

  const Tour& tour_;
  const std::vector<std::size_t>& after_;
  std::map<std::uint32_t, std::size_t> numbers_;  ///< from the camera's count to the place in the tour
  std::map<std::uint32_t, History> histories_;
  std::map<std::uint32_t, ObjectResult> latest_;
};

/// Least distance of the outline along the optical axis, m.
double depth_of(const MultiPolygon& footprint, const CameraPose& lens) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polygon& polygon : footprint) {
    for (const Point& p : polygon.outer) {
      const double ahead = (p.x - lens.x) * std::cos(lens.heading) + (p.y - lens.y) * std::sin(lens.heading);
      least = std::min(least, ahead);
    }
  }
  constexpr double kMinDepth = 0.1;  // m: a model that reaches behind the lens
  return std::max(kMinDepth, least);
}

void set_band(const Tour& tour, const std::vector<TakenBlob>& blobs, Solid& solid) {
  const sensor::CameraIntrinsics& camera = tour.scene.camera;
  std::vector<double> tops;
  std::vector<double> bottoms;
  for (const TakenBlob& blob : blobs) {
    const CameraPose lens = lens_at(camera, believed_pose(tour, blob.frame));
    const double metres_a_pixel = depth_of(solid.footprint, lens) / camera.fy.to_double();
    const double cy = camera.cy.to_double();
    if (blob.box.y1 > 1) tops.push_back(lens.z - (blob.box.y1 - 0.5 - cy) * metres_a_pixel);
    if (blob.box.y2 < camera.height - 2) bottoms.push_back(lens.z - (blob.box.y2 + 0.5 - cy) * metres_a_pixel);
  }
  solid.z_min = bottoms.empty() ? 0 : std::max(0.0, median_of(bottoms));
  solid.z_max = tops.empty() ? solid.z_min : std::max(solid.z_min, median_of(tops));
}

void set_colour(const std::vector<TakenBlob>& blobs, Solid& solid) {
  Colour sum;
  for (const TakenBlob& blob : blobs) {
    sum = {sum.red + blob.colour.red, sum.green + blob.colour.green, sum.blue + blob.colour.blue};
  }
  const auto mean = [&](double channel) {
    return static_cast<std::uint8_t>(
        std::lround(channel / static_cast<double>(std::max<std::size_t>(1, blobs.size()))));
  };
  solid.colour = {mean(sum.red), mean(sum.green), mean(sum.blue)};
}

}  // namespace

History follow_given(const Tour& tour, std::size_t object, const std::vector<std::size_t>& after) {
  History history;
  const recon::CameraModel camera = recon::make_camera_model(tour.scene.camera);
  const auto models = std::make_unique<FullObject>();
  const auto solver = std::make_unique<recon::HybridSolver<config::Full::kHybridSectors, config::Full::kHybridOrder>>();
  std::size_t next = 0;
  for (std::size_t f = 0; f < tour.frames.size(); ++f) {
    const FrameTruth& frame = tour.frames[f];
    if (const auto b = widest_blob(frame, object)) {
      const sensor::Blob& blob = frame.frame.blobs[*b];
      const recon::Sighting sighting = sighting_of(camera, tour.poses[f], blob, tour.hidden[f][object]);
      if (history.blobs.empty()) models->begin(1, blob.signature, sighting, frame.exposure);
      models->track(sighting.left.end, sighting.right.end, frame.exposure);
      models->model(sighting, {});
      if (models->hybrid().new_weight) solver->solve(models->hybrid());
      models->note_outline();
      history.blobs.push_back({f, box_of(blob), tour.images[f].regions[*b].colour.value_or(Colour{})});
    }
    if (next == after.size() || after[next] != f + 1) continue;
    ++next;
    Snapshot& snapshot = history.snapshots.emplace_back();
    snapshot.frames = f + 1;
    snapshot.taken = history.blobs.size();
    if (history.blobs.empty()) continue;
    snapshot.views = models->views;
    snapshot.confidence = static_cast<double>(models->confidence());
    snapshot.models = models_of(*models);
  }
  return history;
}

std::vector<History> follow_inferred(const Tour& tour, const std::vector<std::size_t>& after) {
  Follower follower(tour, after);
  ReplayOptions options;
  options.profile = std::string(config::Full::kName);
  options.observer = &follower;
  const ReplayOutcome outcome = replay(tour.log, "tour", options);
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  const std::vector<ObjectResult>& objects = outcome.result.objects;
  const auto matches = match_objects(objects, tour.scene);
  std::vector<History> histories;
  for (std::size_t truth = 0; truth < tour.scene.objects.size(); ++truth) {
    const auto match = std::find(matches.begin(), matches.end(), std::optional(truth));
    const auto index = static_cast<std::size_t>(match - matches.begin());
    histories.push_back(match == matches.end() ? follower.nothing() : follower.history(objects[index]));
  }
  return histories;
}

Solid solid_of_model(const Tour& tour, const History& history, const Snapshot& snapshot, std::string_view name,
                     std::size_t object) {
  Solid solid;
  solid.signature = tour.scene.objects[object].signature;
  solid.owner = object;
  for (const ModelResult& model : snapshot.models) {
    if (model.name == name) solid.footprint = model.geometry;
  }
  if (solid.footprint.empty()) return solid;
  const std::vector<TakenBlob> blobs(history.blobs.begin(),
                                     history.blobs.begin() + static_cast<std::ptrdiff_t>(snapshot.taken));
  set_band(tour, blobs, solid);
  set_colour(blobs, solid);
  return solid;
}

}  // namespace fencepost::host
