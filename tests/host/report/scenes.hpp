// A run as the report would get it from a replay: an arc around a red box and a blue post, one false sighting.
#pragma once

#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host::testing {

inline Scene two_object_scene() {
  Scene scene;
  scene.signatures = {{1, "red", {0xd0, 0x20, 0x20}}, {2, "blue", {0x20, 0x40, 0xd0}}};
  scene.objects = {{"red box", 1, 0, 0.2, {{{1, 0}, {1.1, 0}, {1.1, 0.1}, {1, 0.1}}, {}}},
                   {"blue post", 2, 0, 0.3, {circle_ring({1.5, 0.6}, 0.05), {}}},
                   {"hidden <cone>", 1, 0, 0.3, {circle_ring({0.4, 0.9}, 0.06), {}}}};
  return scene;
}

inline ModelResult circle_model(const char* name, Point center, double radius) {
  ModelResult model;
  model.name = name;
  model.circle = Circle{center, radius};
  model.geometry = {{circle_ring(center, radius, 64), {}}};
  return model;
}

inline ModelResult outline_model(const char* name, LinearRing ring) {
  ModelResult model;
  model.name = name;
  model.geometry = {{std::move(ring), {}}};
  return model;
}

inline record::AlertReport alert_at(double t, record::AlertLevel level, std::uint32_t id, std::uint8_t signature,
                                    double bearing, double distance, std::optional<double> ttc) {
  record::AlertReport alert{base::Time::nearest(t),
                            level,
                            id,
                            signature,
                            base::Radians::nearest(bearing),
                            base::Metres::nearest(distance),
                            std::nullopt,
                            base::Ratio2::nearest(0.9)};
  if (ttc) alert.ttc = base::Duration::nearest(*ttc);
  return alert;
}

inline void add_objects(ResultDocument& d) {
  ObjectResult red{1, 1, record::ObjectState::kConfirmed, 75, 0, 0.2, 0.97, {}};
  red.models = {
      circle_model("cylinder", {1.052, 0.047}, 0.056), circle_model("cylinder_paper", {1.06, 0.05}, 0.061),
      outline_model("carve", {{0.99, -0.01},
                              {1.11, -0.01},
                              {1.11, 0.05},
                              {1.12, 0.05},
                              {1.12, 0.11},
                              {1.01, 0.11},
                              {1.01, 0.1},
                              {0.99, 0.1}}),
      outline_model("clip", {{0.995, 0.0}, {1.05, -0.008}, {1.105, 0.0}, {1.108, 0.1}, {1.05, 0.11}, {0.998, 0.102}})};
  ObjectResult blue{2, 2, record::ObjectState::kConfirmed, 41, 0, 0.3, 0.88, {}};
  blue.models = {circle_model("cylinder", {1.49, 0.605}, 0.055), circle_model("cylinder_paper", {1.47, 0.61}, 0.05),
                 outline_model("carve", circle_ring({1.5, 0.6}, 0.07, 8)),
                 outline_model("clip", circle_ring({1.5, 0.6}, 0.062, 10))};
  ObjectResult ghost{5, 7, record::ObjectState::kTentative, 1, 0, 0, 0.2, {}};
  ghost.models = {{"cylinder", {}, std::nullopt, "seen from one place only"}};
  d.objects = {red, blue, ghost};
}

inline ResultDocument arc_document() {
  using record::AlertLevel;
  ResultDocument d;
  d.profile = "full";
  d.digest = 0x5f3a99c0de77e1a1ULL;
  d.log.records = 1700;
  d.log.frames = 75;
  d.log.odometry = 1500;
  d.log.refused.no_pose = 1;
  d.log.rejected[0] = {3, 12};
  d.signatures = {{1, {0xd0, 0x20, 0x20}, "red"}, {2, {0x20, 0x40, 0xd0}, "blue"}};
  constexpr int kSamples = 1500;
  for (int i = 0; i <= kSamples; ++i) {
    const double a = 3.6 + 4.2 * i / kSamples;
    d.path.push_back({0.02 * i, 1.05 + 0.8 * std::cos(a), 0.05 + 0.8 * std::sin(a), a + std::numbers::pi / 2});
  }
  d.pose = d.path.back();
  add_objects(d);
  for (int i = 0; i < 20; ++i) {
    const double distance = 0.9 - 0.035 * i;
    const AlertLevel level = distance < 0.25  ? AlertLevel::kStop
                             : distance < 0.5 ? AlertLevel::kWarn
                                              : AlertLevel::kNotice;
    d.alerts.push_back(alert_at(6 + 0.2 * i, level, 1, 1, 0.3, distance, 2.5 - 0.1 * i));
  }
  d.alerts.push_back(alert_at(10.6, AlertLevel::kClear, 1, 1, 0.8, 1.2, std::nullopt));
  d.alerts.push_back(alert_at(14.0, AlertLevel::kNotice, 2, 2, -0.5, 0.81, std::nullopt));
  d.alerts.push_back(alert_at(15.0, AlertLevel::kWarn, 2, 2, -0.4, 0.44, 1.9));
  d.alerts.push_back(alert_at(19.5, AlertLevel::kNotice, 2, 2, -1.4, 0.62, std::nullopt));
  d.alerts.push_back(alert_at(24.0, AlertLevel::kClear, 2, 2, -2.0, 1.1, std::nullopt));
  return d;
}

}  // namespace fencepost::host::testing
