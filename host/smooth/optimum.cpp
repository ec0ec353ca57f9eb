#include "host/smooth/optimum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/calibrate/outline.hpp"
#include "host/calibrate/sighting_model.hpp"
#include "host/geometry/rings.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

constexpr int kCylinderVertices = 64;  ///< as a replay has it

/// world_T_world: where a node's odometry has to be moved.
struct Correction {
  FloorMotion motion;
  double t = 0;
};

std::vector<Correction> corrections_of(const StartedProblem& started) {
  std::vector<Correction> corrections;
  const CalibrationProblem& problem = started.problem;
  for (std::size_t i = 0; i < problem.node_times.size(); ++i) {
    const TrackPose odometry = problem.odometry.at(problem.node_times[i]);
    const PoseValues& node = started.estimate.nodes[i];
    Correction correction{{node[kPoseHeading] - odometry.heading, {}}, problem.node_times[i]};
    const Point turned = correction.motion({odometry.x, odometry.y});
    correction.motion.shift = {node[kPoseX] - turned.x, node[kPoseY] - turned.y};
    corrections.push_back(correction);
  }
  return corrections;
}

PoseResult blended(const Correction& a, const Correction& b, const TrackPose& odometry, double t) {
  const double share = b.t > a.t ? std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0) : 0;
  const Point from = a.motion({odometry.x, odometry.y});
  const Point to = b.motion({odometry.x, odometry.y});
  return {t, from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
          odometry.heading + a.motion.turn + share * (b.motion.turn - a.motion.turn)};
}

/// At every sample of the odometry; between two nodes both say where it was.
std::vector<PoseResult> path_of(const DriveLog& log, const StartedProblem& started) {
  const std::vector<Correction> corrections = corrections_of(started);
  std::vector<PoseResult> path;
  for (const TimedPose& sample : log.odometry) {
    const auto next = std::ranges::upper_bound(corrections, sample.t, {}, &Correction::t);
    const Correction& b = next == corrections.end() ? corrections.back() : *next;
    const Correction& a = next == corrections.begin() ? corrections.front() : *(next - 1);
    path.push_back(blended(a, b, started.problem.odometry.at(sample.t), sample.t));
  }
  return path;
}

MultiPolygon moved_areas(const MultiPolygon& areas, const FloorMotion& motion) {
  MultiPolygon result;
  for (const Polygon& polygon : areas) result.push_back(moved(polygon, motion.turn, motion.shift));
  return result;
}

/// The online object that is the same thing: of its signature, the nearest after the motion, each once. Where the
/// optimum has only one of a signature, it is the one that was seen most.
std::vector<const ObjectResult*> counterparts(const ResultDocument& online, const ResultDocument& optimum,
                                              const FloorMotion& motion) {
  std::vector<const ObjectResult*> result;
  std::vector<const ObjectResult*> free;
  for (const ObjectResult& object : online.objects) {
    if (object_circle(object) != nullptr) free.push_back(&object);
  }
  for (const ObjectResult& object : optimum.objects) {
    const bool single = std::ranges::count(optimum.objects, object.signature, &ObjectResult::signature) == 1;
    const Point at = object_circle(object)->center;
    const ObjectResult* best = nullptr;
    double least = 0;
    for (const ObjectResult* candidate : free) {
      if (candidate->signature != object.signature) continue;
      const Point there = motion(object_circle(*candidate)->center);
      const double cost = single ? -static_cast<double>(candidate->views) : std::hypot(there.x - at.x, there.y - at.y);
      if (best != nullptr && cost >= least) continue;
      best = candidate;
      least = cost;
    }
    std::erase(free, best);
    result.push_back(best);
  }
  return result;
}

std::vector<PointPair> path_pairs(const ResultDocument& online, const ResultDocument& optimum) {
  std::vector<PointPair> pairs;
  const std::size_t count = std::min(online.path.size(), optimum.path.size());
  for (std::size_t i = 0; i < count; ++i) {
    pairs.push_back({{online.path[i].x, online.path[i].y}, {optimum.path[i].x, optimum.path[i].y}});
  }
  return pairs;
}

void compare_paths(const ResultDocument& online, const ResultDocument& optimum, Par& par) {
  const std::vector<PointPair> pairs = path_pairs(online, optimum);
  par.path_rms = rms_of(distances_after(aligned(pairs), pairs));
  if (pairs.empty()) return;
  par.end_off = std::hypot(pairs.back().from.x - pairs.back().to.x, pairs.back().from.y - pairs.back().to.y);
  double sum = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    sum += std::abs(std::remainder(online.path[i].heading - optimum.path[i].heading, 2 * std::numbers::pi));
  }
  par.heading_mean = sum / static_cast<double>(pairs.size());
}

}  // namespace

std::vector<SmoothedObject> optimum_objects(const StartedProblem& started, const SolverOptions& options) {
  std::vector<std::size_t> sightings(started.estimate.objects.size());
  for (const Sighting& sighting : started.problem.sightings) ++sightings[sighting.object];
  const std::vector<PlaceVariance> variances = place_variances(started.problem, options, started.estimate);
  std::vector<SmoothedObject> objects;
  for (std::size_t o = 0; o < started.estimate.objects.size(); ++o) {
    const ObjectValues& values = started.estimate.objects[o];
    SmoothedObject object;
    object.id = started.ids[o];
    object.signature = started.signatures[o];
    object.sightings = sightings[o];
    object.centre = {values[kCentreX], values[kCentreY]};
    object.radius = values[kRadius];
    object.top = started.problem.rows ? values[kTop] : 0;
    object.outline = outline_of(values);
    if (!variances.empty()) {
      const PlaceVariance& v = variances[o];
      object.sigma = std::sqrt((v.xx + v.yy) / 2 + std::hypot((v.xx - v.yy) / 2, v.xy));
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

ResultDocument optimum_result(const ResultDocument& online, const DriveLog& log, const StartedProblem& started,
                              const std::vector<SmoothedObject>& objects) {
  ResultDocument document;
  document.log = online.log;
  document.digest = online.digest;
  document.profile = online.profile;
  document.signatures = online.signatures;
  document.path = path_of(log, started);
  if (!document.path.empty()) document.pose = document.path.back();
  for (const SmoothedObject& object : objects) {
    ObjectResult result;
    result.id = object.id;
    result.signature = object.signature;
    result.state = record::ObjectState::kConfirmed;
    result.views = static_cast<std::uint32_t>(object.sightings);
    result.z_max = object.top;
    const auto known = std::ranges::find(online.objects, object.id, &ObjectResult::id);
    if (known != online.objects.end() && known->signature == object.signature) result.confidence = known->confidence;
    const LinearRing circle = circle_ring(object.centre, object.radius, kCylinderVertices);
    result.models.push_back({"cylinder", {Polygon{circle, {}}}, Circle{object.centre, object.radius}, ""});
    result.models.push_back({"optimum", {oriented(Polygon{object.outline, {}})}, std::nullopt, ""});
    document.objects.push_back(std::move(result));
  }
  std::ranges::sort(document.objects, {}, &ObjectResult::id);
  return document;
}

Par compare_online(const ResultDocument& online, ResultDocument& optimum) {
  Par par;
  compare_paths(online, optimum, par);
  par.objects_online = static_cast<std::size_t>(std::ranges::count_if(
      online.objects, [](const ObjectResult& o) { return o.state != record::ObjectState::kTentative; }));
  par.objects_optimum = optimum.objects.size();
  const auto same = counterparts(online, optimum, aligned(path_pairs(online, optimum)));
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (same[i] == nullptr) continue;
    pairs.push_back({object_circle(*same[i])->center, object_circle(optimum.objects[i])->center});
  }
  par.pairs = pairs.size();
  par.motion = aligned(pairs);
  const std::vector<double> distances = distances_after(par.motion, pairs);
  par.map_rms = rms_of(distances);
  par.map_worst = distances.empty() ? 0 : *std::ranges::max_element(distances);
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (same[i] == nullptr) continue;
    const ModelResult* model = find_model(*same[i], "hybrid");
    if (model == nullptr || model->geometry.empty()) model = find_model(*same[i], "cylinder");
    if (model == nullptr || model->geometry.empty()) continue;
    optimum.objects[i].models.push_back({"online", moved_areas(model->geometry, par.motion), std::nullopt, ""});
  }
  return par;
}

}  // namespace fencepost::host
