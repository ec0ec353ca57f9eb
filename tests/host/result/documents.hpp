// A small result document made by hand, with every case the writers must handle.
#pragma once

#include "host/result/result.hpp"

namespace fencepost::host::testing {

inline ModelResult square_model(const char* name, double x, double y, double side) {
  ModelResult model;
  model.name = name;
  model.geometry = {{{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}}};
  return model;
}

inline ModelResult silent_model(const char* name) {
  ModelResult model;
  model.name = name;
  model.reason = "seen from one place only";
  return model;
}

inline sensor::CameraIntrinsics pixy2() {
  sensor::CameraIntrinsics camera;
  camera.model = "pixy2";
  camera.width = 316;
  camera.height = 208;
  camera.fx = camera.fy = base::Pixels2::nearest(273.6);
  camera.cx = base::Pixels2::nearest(157.5);
  camera.cy = base::Pixels2::nearest(103.5);
  camera.mount.x = base::Metres::nearest(0.05);
  camera.mount.z = base::Metres::nearest(0.12);
  camera.latency = base::Duration::nearest(0.05);
  return camera;
}

/// Object 1: red, confirmed, three models of known area. Object 2: a signature the log does not name, nothing known.
inline ResultDocument small_document() {
  ResultDocument d;
  d.log.records = 12;
  d.log.frames = 5;
  d.log.odometry = 4;
  d.log.foreign = 1;
  d.log.refused.no_pose = 2;
  d.log.rejected[static_cast<std::size_t>(record::Reject::kCrc)] = {3, 7};
  d.digest = 0x0123456789abcdefULL;
  d.profile = "full";
  d.pose = PoseResult{1.2, 0.5, -0.25, 0.125};
  d.path = {{0, 0, 0, 0}, {0.6, 0.25, -0.1, -0.2}, {1.2, 0.5, -0.25, 0.125}};
  d.signatures = {{1, {0xd0, 0x20, 0x20}, "red"}};
  d.camera = pixy2();

  ObjectResult red{1, 1, record::ObjectState::kConfirmed, 75, 0.0, 0.2, 0.97, {}};
  ModelResult cylinder = square_model("cylinder", 1.0, 0.0, 0.1);
  cylinder.circle = Circle{{1.05, 0.05}, 0.06};
  red.models = {cylinder, square_model("carve", 1.0, 0.0, 0.2), square_model("clip", 1.0, 0.0, 0.1)};
  ObjectResult unknown{2, 9, record::ObjectState::kTentative, 1, 0.0, 0.0, 0.5, {}};
  unknown.models = {silent_model("cylinder"), silent_model("carve"), silent_model("clip")};
  d.objects = {red, unknown};
  d.objects[0].base = 0.03;

  using base::Time;
  record::AlertReport warn{Time::nearest(1.0),
                           record::AlertLevel::kWarn,
                           1,
                           1,
                           base::Radians::nearest(0.1),
                           base::Metres::nearest(0.4),
                           base::Duration::nearest(1.1),
                           base::Ratio2::nearest(0.9)};
  record::AlertReport stop{Time::nearest(1.1),
                           record::AlertLevel::kStop,
                           1,
                           1,
                           base::Radians::nearest(-0.2094),
                           base::Metres::nearest(0.24),
                           std::nullopt,
                           base::Ratio2::nearest(0.93)};
  d.alerts = {warn, stop};
  d.guard = {{1.0, 0.05, 1}, {-0.25, 2.0, 9}};
  record::SectorReport sectors;
  sectors.t = Time::nearest(1.2);
  for (const double distance : {0.5, -1.0, 1.5}) {
    record::SectorReport::Sector sector;
    if (distance > 0) sector.distance = base::Metres::nearest(distance);
    static_cast<void>(sectors.sectors.push_back(sector));
  }
  d.sectors = sectors;
  record::WayReport ways;
  ways.t = Time::nearest(1.2);
  static_cast<void>(
      ways.ways.push_back({record::WayMotion::kForward, base::Ratio2::nearest(-1.6), base::Metres::nearest(0.42),
                           base::Metres::nearest(0.5), record::WayEnd::kThing}));
  d.ways = ways;
  d.speed_limit = base::Metres::nearest(0.35);
  d.calibration = {{Time::nearest(0.9), record::Doubt::kRows, base::Ratio2::nearest(1.31)}};
  return d;
}

}  // namespace fencepost::host::testing
