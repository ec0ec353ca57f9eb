#include "tests/studies/alerts/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "host/evaluate/evaluate.hpp"
#include "host/evaluate/following.hpp"
#include "host/evaluate/matching.hpp"
#include "host/replay/replay.hpp"
#include "host/simulate/truth.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

// An alert that tells a place this near to a block is about it, whosever blobs its object took (m).
constexpr double kSamePlace = 0.15;
// Well within range: the first estimate may be off by a tenth.
constexpr double kWellWithin = 0.9;

/// Watches which object of the map follows which block.
class Watch final : public host::RunObserver {
 public:
  explicit Watch(const host::Scene& scene) : truths_(scene) {}
  void run_begins() override { following_.clear(); }
  void frame_placed(const host::PlacedFrame& placed) override {
    if (const auto owners = truths_.owners(placed.frame)) following_.add(*owners, placed.sightings);
  }
  [[nodiscard]] const host::Following& following() const { return following_; }

 private:
  host::FrameTruths truths_;
  host::Following following_;
};

/// A run's log and, for each frame, when it arrived and which blocks it showed.
struct Recording {
  std::string log;
  std::vector<double> frames;
  std::vector<std::vector<bool>> shown;   ///< [object][frame]
  std::vector<std::vector<bool>> placed;  ///< the same, foot and one end of it in the image and not behind another
};

bool free(host::BlobEnd end) { return end != host::BlobEnd::kBorder && end != host::BlobEnd::kOccluded; }

/// One frame tells where the block stands: the floor it stands on is there, and one of its ends.
bool tells_place(const sensor::Blob& blob, const host::BlobTruth& truth, const host::Scene& scene) {
  return blob.y2 < scene.camera.height - 2 && (free(truth.left) || free(truth.right));
}

Recording record_run(const Approach& approach, const AlertRequest& request) {
  Recording recording;
  recording.shown.resize(approach.scene.objects.size());
  recording.placed.resize(approach.scene.objects.size());
  const auto line = [&](std::string_view text) { recording.log += text; };
  const auto truth = [&](const host::FrameTruth& frame) {
    recording.frames.push_back(frame.frame.t.to_double());
    for (std::size_t o = 0; o < recording.shown.size(); ++o) {
      bool shown = false;
      bool placed = false;
      for (std::size_t b = 0; b < frame.blobs.size(); ++b) {
        if (frame.blobs[b].object != o) continue;
        shown = true;
        placed = placed || tells_place(frame.frame.blobs[b], frame.blobs[b], approach.scene);
      }
      recording.shown[o].push_back(shown);
      recording.placed[o].push_back(placed);
    }
  };
  const auto summary = host::simulate_with_truth(approach.scene, line, truth);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  for (const record::Setting& setting : request.settings) recording.log = with_setting(recording.log, setting);
  return recording;
}

class Judge {
 public:
  Judge(const Approach& approach, const AlertLimits& limits, const AlertRequest& request)
      : approach_(approach),
        truth_(approach, limits),
        recording_(record_run(approach, request)),
        watch_(approach.scene) {
    host::ReplayOptions options;
    options.profile = request.profile;
    options.observer = &watch_;
    host::ReplayOutcome outcome = host::replay(recording_.log, "approach", options);
    if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
    // Doubts of the robot's own about its camera are no fault of its input.
    if (outcome.complaints.size() > outcome.result.calibration.size()) {
      throw std::runtime_error(outcome.complaints.front());
    }
    verdict_.objects = std::move(outcome.result.objects);
    for (const auto& object : verdict_.objects) verdict_.followed.push_back(watch_.following().follows(object.id));
    verdict_.alerts = std::move(outcome.result.alerts);
    verdict_.seconds = approach.end;
  }

  Verdict judge() {
    for (std::size_t object = 0; object < approach_.scene.objects.size(); ++object) {
      judge_stop(object);
      judge_delay(object);
    }
    judge_false_stops();
    judge_stale();
    judge_map();
    return std::move(verdict_);
  }

 private:
  [[nodiscard]] bool about(const record::AlertReport& alert, std::size_t object) const {
    if (watch_.following().follows(alert.id) == object) return true;
    const host::TimedPose robot = approach_.drive.at(alert.t.to_double());
    const double bearing = robot.heading + alert.bearing.to_double();
    const double distance = alert.distance.to_double();
    const host::Point place{robot.x + distance * std::cos(bearing), robot.y + distance * std::sin(bearing)};
    return distance_to(approach_.scene.objects[object].footprint, place) <= kSamePlace;
  }

  /// The last word about each id up to t.
  [[nodiscard]] bool stop_in_force(std::size_t object, double t) const {
    std::map<std::uint32_t, const record::AlertReport*> last;
    for (const record::AlertReport& alert : verdict_.alerts) {
      if (alert.t.to_double() <= t) last[alert.id] = &alert;
    }
    return std::any_of(last.begin(), last.end(), [&](const auto& entry) {
      return entry.second->level == AlertLevel::kStop && about(*entry.second, object);
    });
  }

  [[nodiscard]] unsigned frames_before(double t, const std::vector<bool>& flags) const {
    unsigned count = 0;
    for (std::size_t i = 0; i < recording_.frames.size(); ++i) {
      if (recording_.frames[i] <= t && flags[i]) ++count;
    }
    return count;
  }

  void judge_stop(std::size_t object) {
    const std::optional<double> due = truth_.stop_time(object);
    if (!due) return;
    const AlertLimits& limits = truth_.limits();
    ObstacleVerdict verdict{object, *due, truth_.swept(object, *due, limits.half_width),
                            frames_before(*due, recording_.shown[object]),
                            frames_before(*due, recording_.placed[object])};
    if (verdict.visible < static_cast<unsigned>(limits.confirm_k)) return;
    verdict.in_time = stop_in_force(object, *due);
    const auto later = std::find_if(verdict_.alerts.begin(), verdict_.alerts.end(), [&](const auto& alert) {
      return alert.level == AlertLevel::kStop && alert.t.to_double() > *due && about(alert, object);
    });
    if (!verdict.in_time && later != verdict_.alerts.end()) verdict.late_by = later->t.to_double() - *due;
    verdict_.obstacles.push_back(verdict);
  }

  /// The frame that completes k-of-n; the number of frames if none does.
  [[nodiscard]] std::size_t completing_frame(std::size_t object) const {
    const std::vector<bool>& shown = recording_.shown[object];
    const auto n = static_cast<std::size_t>(truth_.limits().confirm_n);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const auto end = shown.begin() + static_cast<std::ptrdiff_t>(i + 1);
      const auto begin = end - static_cast<std::ptrdiff_t>(std::min(n, i + 1));
      if (std::count(begin, end, true) >= truth_.limits().confirm_k) return i;
    }
    return shown.size();
  }

  void judge_delay(std::size_t object) {
    const std::size_t complete = completing_frame(object);
    if (complete == recording_.frames.size()) return;
    const double t = recording_.frames[complete];
    // Nearer than that everything is worth an alert, in the path or not: so no guess about the path is judged here.
    if (truth_.distance(object, t) > kWellWithin * truth_.limits().warn) return;
    const auto first = std::find_if(verdict_.alerts.begin(), verdict_.alerts.end(), [&](const auto& alert) {
      return alert.level != AlertLevel::kClear && about(alert, object);
    });
    std::size_t frame = complete;
    const double said = first == verdict_.alerts.end() ? approach_.end : first->t.to_double();
    while (frame < recording_.frames.size() && recording_.frames[frame] < said) ++frame;
    verdict_.delays.push_back({object, t, static_cast<unsigned>(frame - complete)});
  }

  void judge_false_stops() {
    std::map<std::uint32_t, AlertLevel> level;
    for (const record::AlertReport& alert : verdict_.alerts) {
      const bool rises = alert.level == AlertLevel::kStop && level[alert.id] != AlertLevel::kStop;
      level[alert.id] = alert.level;
      const double t = alert.t.to_double();
      if (!rises || truth_.stop_is_right(t, 0)) continue;
      verdict_.false_stops.push_back({alert, truth_.stop_is_right(t, kGrace), watch_.following().follows(alert.id)});
    }
  }

  void judge_stale() {
    std::map<std::uint32_t, AlertLevel> level;
    for (const record::AlertReport& alert : verdict_.alerts) level[alert.id] = alert.level;
    for (const host::ObjectResult& object : verdict_.objects) level.erase(object.id);
    level.erase(record::kNoObject);
    verdict_.stale = static_cast<unsigned>(std::count_if(
        level.begin(), level.end(), [](const auto& entry) { return entry.second != AlertLevel::kClear; }));
  }

  void judge_map() {
    const auto& objects = verdict_.objects;
    const auto matches = host::match_objects(objects, approach_.scene);
    const auto confirmed = [&](std::size_t i) { return objects[i].state != record::ObjectState::kTentative; };
    std::set<std::size_t> known;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (matches[i] && confirmed(i)) known.insert(*matches[i]);
    }
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (matches[i] || !confirmed(i)) continue;
      const std::optional<std::size_t> followed = verdict_.followed[i];
      const bool only_one = followed && known.insert(*followed).second;
      ++(only_one ? verdict_.misplaced : verdict_.phantoms);
    }
    for (std::size_t object = 0; object < approach_.scene.objects.size(); ++object) {
      if (watch_.following().visible(object) < host::kVisibleFrames) continue;
      ++verdict_.seen;
      if (!known.contains(object)) ++verdict_.missed;
    }
  }

  const Approach& approach_;
  GroundTruth truth_;
  Recording recording_;
  Watch watch_;
  Verdict verdict_;
};

}  // namespace

Verdict judge_approach(const Approach& approach, const AlertLimits& limits, const AlertRequest& request) {
  return Judge(approach, limits, request).judge();
}

}  // namespace fencepost::test
