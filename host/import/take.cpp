#include "host/import/take.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/import/log_builder.hpp"
#include "host/import/table.hpp"
#include "host/import/take_times.hpp"

namespace fencepost::host {
namespace {

constexpr double kTick = 1e-4;  // s
constexpr double kStep = 0.02;  // s, between poses of a stationary robot
constexpr int kMargin = 5;      // such poses before the first frame: 0.1 s, a camera's latency
constexpr int kLastSignature = 255;
constexpr double kCounts = 10'000;  // /m, of an imported car's encoder: finer than any real one

// A bearing outside the image is none.
std::optional<sensor::Blob> bearing_of(const ImportedBlob& taken, const sensor::CameraIntrinsics& camera) {
  const double u = taken.cx.value_or(NAN);
  const double v = taken.cy.value_or(NAN);
  if (!(u >= 0 && v >= 0 && u <= camera.width - 1 && v <= camera.height - 1)) return std::nullopt;
  sensor::Blob blob;
  blob.bearing = true;
  blob.signature = static_cast<std::uint8_t>(taken.signature);
  blob.cx = base::Pixels1::nearest(u);
  blob.cy = base::Pixels1::nearest(v);
  sensor::put_at_centre(blob);
  blob.y1 = blob.y2 = static_cast<std::int16_t>(std::lround(v));
  blob.pixels = taken.pixels;
  blob.rgb = taken.rgb;
  return blob;
}

std::optional<sensor::Blob> blob_of(const ImportedBlob& taken, const sensor::CameraIntrinsics& camera) {
  if (taken.bearing) return bearing_of(taken, camera);
  const double right = camera.width - 1;
  const double bottom = camera.height - 1;
  if (!(taken.x1 <= taken.x2 && taken.y1 <= taken.y2)) return std::nullopt;
  if (taken.x2 < 0 || taken.y2 < 0 || taken.x1 > right || taken.y1 > bottom) return std::nullopt;
  sensor::Blob blob;
  const auto whole = [](double value, double last) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, 0.0, last)));
  };
  blob.signature = static_cast<std::uint8_t>(taken.signature);
  blob.x1 = whole(taken.x1, right);
  blob.x2 = whole(taken.x2, right);
  blob.y1 = whole(taken.y1, bottom);
  blob.y2 = whole(taken.y2, bottom);
  const double cx = taken.cx.value_or((blob.x1 + blob.x2) / 2.0);
  const double cy = taken.cy.value_or((blob.y1 + blob.y2) / 2.0);
  blob.cx = base::Pixels1::nearest(std::clamp<double>(cx, blob.x1, blob.x2));
  blob.cy = base::Pixels1::nearest(std::clamp<double>(cy, blob.y1, blob.y2));
  blob.pixels = taken.pixels;
  blob.rgb = taken.rgb;
  return blob;
}

int area(const sensor::Blob& blob) { return (blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1); }

sensor::BlobFrame frame_of(const TakenFrame& taken, const sensor::CameraIntrinsics& camera, Taken& counts) {
  std::vector<sensor::Blob> blobs;
  for (const ImportedBlob& blob : taken.blobs) {
    if (const auto inside = blob_of(blob, camera)) {
      blobs.push_back(*inside);
      blobs.back().track = blob.track;
    } else {
      ++counts.skipped["blobs outside the image"];
    }
  }
  std::ranges::stable_sort(blobs, [](const auto& a, const auto& b) { return area(a) > area(b); });
  sensor::BlobFrame frame;
  for (const sensor::Blob& blob : blobs) {
    if (!frame.blobs.push_back(blob)) ++counts.skipped["blobs beyond 16 in a frame"];
  }
  return frame;
}

/// In order, each at least a tick after the one before; others are left out and counted.
template <class Item>
void put_in_order(std::vector<Item>& items, const char* what, Taken& counts) {
  std::ranges::stable_sort(items, {}, &Item::t);
  std::vector<Item> kept;
  for (Item& item : items) {
    if (!kept.empty() && item.t - kept.back().t < kTick) {
      ++counts.skipped[std::string(what) + " with the time of another"];
    } else {
      kept.push_back(std::move(item));
    }
  }
  items = std::move(kept);
}

void stand_still(Taken& taken) {
  taken.notes.emplace_back("no poses: the robot is taken to stand still; give its poses with --poses");
  // From the first frame: times of a clock since 1970 are too large for exact steps.
  const double begin = taken.frames.front().t;
  for (TakenFrame& frame : taken.frames) frame.t -= begin;
  const int last = static_cast<int>(std::ceil(taken.frames.back().t / kStep));
  for (int i = -kMargin; i <= last; ++i) taken.poses.push_back({i * kStep, 0, 0, 0});
}

sensor::CameraIntrinsics camera_of(const Taken& taken, const TakeSettings& settings, const std::string& source) {
  if (taken.frames.empty()) return settings.camera.value_or(sensor::CameraIntrinsics());
  if (!settings.camera) {
    throw ImportProblem{source, "does not say how its camera sees",
                        "give --camera: a name such as pixy2, or a file with its calibration"};
  }
  if (taken.image && (taken.image->first != settings.camera->width || taken.image->second != settings.camera->height)) {
    throw ImportProblem{source,
                        "is of images of " + std::to_string(taken.image->first) + " x " +
                            std::to_string(taken.image->second) + " px, --camera of " +
                            std::to_string(settings.camera->width) + " x " + std::to_string(settings.camera->height),
                        "give the calibration of these images"};
  }
  return *settings.camera;
}

std::vector<record::Signature> signatures_of(const Taken& taken, const std::string& source) {
  std::map<int, std::string> all = taken.names;
  for (const TakenFrame& frame : taken.frames) {
    for (const ImportedBlob& blob : frame.blobs)
      all.try_emplace(blob.signature, "signature" + std::to_string(blob.signature));
  }
  // Names are numbered from 1 on.
  if (all.size() > kLastSignature && all.rbegin()->first == static_cast<int>(all.size())) {
    throw ImportProblem{source, "has " + std::to_string(all.size()) + " names of colours; there can be 255",
                        "give one name to those that belong together"};
  }
  std::vector<record::Signature> list;
  for (const auto& [number, name] : all) {
    if (number < 0 || number > kLastSignature) {
      throw ImportProblem{source, "has signature " + std::to_string(number) + "; they are 0 to 255",
                          "number the colours anew"};
    }
    list.push_back({static_cast<std::uint8_t>(number), colour_number(list.size(), all.size()), std::string_view(name)});
  }
  return list;
}

sensor::CarSample sample_of(const TakenCar& car, double zero) {
  sensor::CarSample sample;
  sample.t = base::Time::nearest(car.t - zero);
  sample.count = static_cast<std::int32_t>(std::llround(kCounts * car.driven));
  if (car.steering) sample.steering = base::Radians::nearest(*car.steering);
  if (car.yaw_rate) sample.yaw_rate = base::RadiansPerSecond::nearest(*car.yaw_rate);
  return sample;
}

void take_settings(const Taken& taken, LogParts& parts) {
  const auto add = [&](std::string_view key, std::string_view value) { parts.settings.push_back({key, value}); };
  for (const auto& [key, value] : taken.settings) add(key, value);
  if (!taken.car.empty()) add("car.counts", "10000.0");
}

/// s, of the first pose, sample or frame.
double start_of(const Taken& taken) {
  double start = std::numeric_limits<double>::infinity();
  if (!taken.poses.empty()) start = std::min(start, taken.poses.front().t);
  if (!taken.car.empty()) start = std::min(start, taken.car.front().t);
  if (!taken.frames.empty()) start = std::min(start, taken.frames.front().t);
  return start;
}

}  // namespace

Imported log_of(Taken taken, const TakeSettings& settings, const std::string& source, const std::string& target) {
  if (!settings.poses.empty()) taken.poses = settings.poses;
  if (taken.frames.empty() && taken.poses.empty() && taken.car.empty()) {
    throw ImportProblem{source, "has neither blobs nor poses in a form that is known",
                        "share/doc/import.md shows each; is it the right file?"};
  }
  put_in_order(taken.frames, "frames", taken);
  put_in_order(taken.poses, "poses", taken);
  put_in_order(taken.car, "odometry samples", taken);
  check_times(taken, source);
  LogParts parts;
  parts.target = target;
  parts.camera = camera_of(taken, settings, source);
  parts.signatures = signatures_of(taken, source);
  take_settings(taken, parts);
  if (taken.poses.empty() && taken.car.empty()) stand_still(taken);
  const double zero = start_of(taken);
  for (const TakenCar& car : taken.car) parts.car.push_back(sample_of(car, zero));
  for (const TimedPose& pose : taken.poses) {
    parts.odometry.push_back({base::Time::nearest(pose.t - zero), base::Metres::nearest(pose.x),
                              base::Metres::nearest(pose.y), base::Radians::nearest(pose.heading)});
  }
  Imported imported;
  for (const TakenFrame& frame : taken.frames) {
    sensor::BlobFrame made = frame_of(frame, parts.camera, taken);
    made.t = base::Time::nearest(frame.t - zero);
    made.frame = static_cast<std::uint32_t>(parts.frames.size());
    imported.summary.blobs += made.blobs.size();
    parts.frames.push_back(made);
  }
  imported.log = build_log(parts);
  imported.summary.frames = parts.frames.size();
  imported.summary.odometry = parts.odometry.size() + parts.car.size();
  imported.summary.skipped.assign(taken.skipped.begin(), taken.skipped.end());
  imported.summary.notes = taken.notes;
  return imported;
}

}  // namespace fencepost::host
