#include "tests/studies/world/kitti_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "host/evaluate/evaluate.hpp"
#include "host/import/import.hpp"
#include "host/import/kitti/kitti_files.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

// A STOP is justified by a labelled thing in a strip ahead. Lengths are those of the world.
constexpr double kHalfWay = 1.5;  // m, half the strip's width: less than half a lane
constexpr double kMinReach = 4;   // m, the strip's minimum length
constexpr double kReachTime = 2;  // s, of driving that the strip covers
constexpr double kBehind = -0.5;  // m, what is just beside the lens counts

/// Found cars with fewer views have hardly an outline.
constexpr std::uint32_t kMinViews = 15;

struct Way {
  double reach = 0;  // m
  double curve = 0;  // 1/m, left positive
};

Way way_at(const host::KittiDrive& drive, std::size_t frame) {
  constexpr std::size_t kFrames = 3;  // of which the speed is a mean
  const std::size_t before = frame - std::min(frame, kFrames);
  const host::TimedPose& a = drive.frames[before].pose;
  const host::TimedPose& b = drive.frames[frame].pose;
  const double driven = std::hypot(b.x - a.x, b.y - a.y);
  const double speed = driven / std::max(b.t - a.t, 1 / host::kKittiRate);
  Way way{std::max(kMinReach, kReachTime * speed), 0};
  constexpr double kMinDriven = 0.3;  // m; a curvature of less is noise
  if (driven > kMinDriven) way.curve = std::remainder(b.heading - a.heading, 2 * std::numbers::pi) / driven;
  return way;
}

// Any of 15 points of the thing's rectangle lies in the strip, straight ahead or along the arc.
bool in_the_way(const host::KittiLabel& label, const Way& way) {
  const double c = std::cos(label.yaw);
  const double s = std::sin(label.yaw);
  for (const double along : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    for (const double across : {-1.0, 0.0, 1.0}) {
      const double u = along * label.length / 2;
      const double v = across * label.width / 2;
      const double right = label.x + c * u + s * v;
      const double ahead = label.z - s * u + c * v;
      if (ahead <= kBehind || ahead >= way.reach) continue;
      if (std::abs(right) < kHalfWay || std::abs(right + way.curve * ahead * ahead / 2) < kHalfWay) return true;
    }
  }
  return false;
}

bool something_in_the_way(const host::KittiDrive& drive, double t) {
  const auto last = static_cast<long>(drive.frames.size()) - 1;
  const long frame = std::clamp(std::lround(t * host::kKittiRate), 0L, last);
  const Way way = way_at(drive, static_cast<std::size_t>(frame));
  for (long i = std::max(frame - 1, 0L); i <= std::min(frame + 1, last); ++i) {
    const auto& labels = drive.frames[static_cast<std::size_t>(i)].labels;
    if (std::ranges::any_of(labels, [&](const auto& label) { return in_the_way(label, way); })) return true;
  }
  return false;
}

void count_stops(const host::KittiDrive& drive, const std::vector<record::AlertReport>& alerts, KittiScore& score) {
  std::map<std::uint32_t, record::AlertLevel> levels;
  for (const record::AlertReport& alert : alerts) {
    const record::AlertLevel before = std::exchange(levels[alert.id], alert.level);
    if (alert.level != record::AlertLevel::kStop || before == alert.level) continue;
    ++score.stops;
    if (!something_in_the_way(drive, alert.t.to_double())) ++score.empty_stops;
  }
}

// Frames whose labels show each car, by name.
std::map<std::string, std::size_t> shown_frames(const host::KittiDrive& drive) {
  std::map<std::string, std::size_t> frames;
  for (const host::KittiFrame& frame : drive.frames)
    for (const host::KittiLabel& label : frame.labels)
      if (label.is_car() && label.is_shown()) ++frames[label.name()];
  return frames;
}

void count_objects(const host::KittiDrive& drive, const host::Evaluation& evaluation, const host::Scene& truth,
                   bool identity, KittiScore& score) {
  std::map<std::string, std::size_t> shown = shown_frames(drive);
  for (const host::ObjectEvaluation& object : evaluation.objects) {
    if (!object.found || object.found->state == record::ObjectState::kTentative) {
      if (shown[object.name] >= host::kVisibleFrames) ++score.missed;
      continue;
    }
    ++score.found;
    if (object.cuts.empty() || object.found->views < kMinViews) continue;
    for (const host::ModelScore& model : object.cuts.back().models) {
      if (model.model != "hybrid") continue;
      score.recklessness.push_back(model.score.recklessness);
      score.paranoia.push_back(model.score.paranoia);
    }
  }
  score.phantoms += evaluation.phantoms.size();
  if (!identity) return;
  std::set<std::uint8_t> parked;
  for (const host::SceneObject& object : truth.objects) parked.insert(object.signature);
  for (const host::Phantom& phantom : evaluation.phantoms)
    if (!parked.contains(phantom.signature)) ++score.moving;
}

void run_drive(const std::string& folder, const KittiConfigured& configured,
               const std::vector<std::pair<std::string, std::string>>& settings, KittiScore& score) {
  host::KittiOptions options;
  options.pitch = configured.pitch;
  options.identity = configured.identity && !configured.detector;
  options.ids = configured.ids;
  if (configured.detector) options.detections = folder + "/detections_car.txt";
  const host::ImportResult imported = host::import_kitti(folder, options);
  if (!imported.ok()) throw std::runtime_error(imported.error().message());
  std::string log = imported->log;
  for (const auto& [key, value] : settings)
    log = with_setting(log, record::Setting{std::string_view(key), std::string_view(value)});
  const host::EvaluateOutcome outcome = host::evaluate(log, folder, *imported->truth, {});
  if (outcome.replay.unreadable) throw std::runtime_error(outcome.replay.unreadable->message);
  const host::KittiDrive drive = host::read_kitti(folder);
  const host::TimedPose& end = drive.frames.back().pose;
  const host::PoseResult& pose = outcome.replay.result.pose.value();
  score.end_error.push_back(std::hypot(pose.x / options.scale - end.x, pose.y / options.scale - end.y));
  score.seconds += static_cast<double>(drive.frames.size()) / host::kKittiRate;
  count_stops(drive, outcome.replay.result.alerts, score);
  count_objects(drive, outcome.evaluation, *imported->truth, options.identity, score);
  ++score.drives;
}

}  // namespace

std::vector<std::string> kitti_drives(const std::string& folder) {
  std::vector<std::string> drives;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) drives.push_back(entry.path());
  std::ranges::sort(drives);
  return drives;
}

KittiScore run_kitti(const std::vector<std::string>& drives, const KittiConfigured& configured,
                     const std::vector<std::pair<std::string, std::string>>& settings) {
  KittiScore score;
  for (const std::string& drive : drives) run_drive(drive, configured, settings, score);
  return score;
}

}  // namespace fencepost::test
