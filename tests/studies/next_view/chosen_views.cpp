#include "tests/studies/next_view/chosen_views.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "host/evaluate/metrics.hpp"
#include "host/replay/replay.hpp"
#include "host/result/lookup.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/studies/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

/// A frame a second; the robot stands 0.3 s before and after each.
host::PosesPath stops(const std::vector<double>& bearings, host::Point middle) {
  constexpr double kStands = 0.3;
  host::PosesPath path;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const double x = middle.x + kViewDistance * std::cos(bearings[i]);
    const double y = middle.y + kViewDistance * std::sin(bearings[i]);
    const double heading = std::remainder(bearings[i] + std::numbers::pi, 2 * std::numbers::pi);
    const auto t = static_cast<double>(i);
    path.poses.push_back({std::max(0.0, t - kStands), x, y, heading});
    path.poses.push_back({t + kStands, x, y, heading});
  }
  return path;
}

const host::ObjectResult* most_seen(const host::ResultDocument& result) {
  const auto most = std::max_element(result.objects.begin(), result.objects.end(),
                                     [](const auto& a, const auto& b) { return a.views < b.views; });
  return most == result.objects.end() ? nullptr : &*most;
}

}  // namespace

host::Scene lone_object(unsigned seed) {
  host::Scene scene = objects_of_reference(seed);
  scene.objects.resize(1);
  scene.camera.mount.yaw = {};
  scene.rate = 1;
  return scene;
}

Looked look_from(const std::vector<double>& bearings, const host::Scene& object, const NoiseLevel& level) {
  host::Scene scene = object;
  scene.path = stops(bearings, host::centroid(object.objects[0].footprint));
  scene.noise = scene_noise(level);
  std::string log;
  const auto made = host::simulate(scene, [&](std::string_view line) { log += line; });
  if (!made.ok()) throw std::runtime_error(made.error());
  const host::ReplayOutcome outcome = host::replay(log, "views", {});
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  Looked looked;
  const host::ObjectResult* found = most_seen(outcome.result);
  if (found == nullptr) return looked;
  if (const host::ModelResult* hybrid = host::find_model(*found, "hybrid")) {
    const host::Score score = host::score(hybrid->geometry, object.objects[0].footprint);
    looked.recklessness = score.recklessness;
    looked.paranoia = score.paranoia;
  }
  if (found->next) looked.next = found->next->bearing;
  return looked;
}

std::vector<double> evenly(int views) {
  std::vector<double> bearings;
  for (int i = 0; i < views; ++i) bearings.push_back(2 * std::numbers::pi * i / views);
  return bearings;
}

std::vector<double> chosen(int views, const host::Scene& object, const NoiseLevel& level) {
  constexpr double kWithoutAWish = 100 * std::numbers::pi / 180;
  std::vector<double> bearings{0};
  while (static_cast<int>(bearings.size()) < views) {
    const Looked looked = look_from(bearings, object, level);
    bearings.push_back(looked.next.value_or(bearings.back() + kWithoutAWish));
  }
  return bearings;
}

}  // namespace fencepost::test
