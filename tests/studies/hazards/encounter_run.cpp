#include "tests/studies/hazards/encounter_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "host/simulate/truth.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/hazards/truth.hpp"

namespace fencepost::test {
namespace {

/// How far along its route the robot is. Its brake is the listener.
class Progress {
 public:
  Progress(const Encounter& encounter, const Listener& listener) : encounter_(encounter), listener_(listener) {}

  /// Steps up to t, with what has been said by now.
  double at(double t) {
    const auto index = static_cast<std::size_t>(std::max(0.0, t / kTruthStep) + kRounding);
    while (steps_.size() <= index + 1) step();
    const double share = std::max(0.0, t / kTruthStep - static_cast<double>(index));
    return steps_[index] + share * (steps_[index + 1] - steps_[index]);
  }
  [[nodiscard]] const std::vector<double>& steps() const { return steps_; }

 private:
  static constexpr double kRounding = 1e-6;

  void step() {
    const Brake& brake = encounter_.brake;
    const bool told = encounter_.obeys && listener_.says_stop();
    told_for_ = told == braking_ ? 0 : told_for_ + kTruthStep;
    if (told_for_ >= brake.reaction) braking_ = told;
    const double wanted = braking_ ? 0 : limited();
    const double most = kTruthStep / brake.full;
    pace_ += std::clamp(wanted - pace_, -most, most);
    steps_.push_back(steps_.back() + pace_ * kTruthStep);
  }
  // The pace that the speed limit allows, by the limit that was in force one reaction time ago.
  double limited() {
    if (!encounter_.slows) return 1;
    const double speed = encounter_.route.speed(steps_.back());
    limits_.push_back(speed > 0 ? std::min(1.0, listener_.speed_limit() / speed) : 1);
    const auto late = static_cast<std::size_t>(encounter_.brake.reaction / kTruthStep + kRounding);
    return limits_[limits_.size() - 1 - std::min(late, limits_.size() - 1)];
  }

  const Encounter& encounter_;
  const Listener& listener_;
  std::vector<double> limits_;
  bool braking_ = false;
  double told_for_ = 0;  ///< s, the opposite of what the brake does
  double pace_ = 1;      ///< of the route's speed
  std::vector<double> steps_ = {0};
};

}  // namespace

History run_encounter(const Encounter& encounter, Listener& listener) {
  History history;
  history.shown.resize(encounter.scene.objects.size());
  history.end = encounter.seconds;
  Progress progress(encounter, listener);
  Truth truth(encounter);
  const std::string configured = encounter.configured ? line_of(*encounter.configured) : "";
  host::Driven driven;
  driven.duration = encounter.seconds;
  driven.pose = [&](double t) {
    host::TimedPose pose = encounter.route.at(progress.at(t));
    pose.t = t;
    return pose;
  };
  driven.ended = [&](double t) {
    if (!truth.touches(t, progress.at(t))) return false;
    history.end = t;
    return true;
  };
  Wire wire(encounter.outage);
  const auto hear = [&](std::string_view sent) {
    const std::string_view line = wire.carry(sent);
    if (line.empty()) return;
    listener.hear(!configured.empty() && line.starts_with("$FPCAM,") ? std::string_view(configured) : line);
  };
  const auto watch = [&](const host::FrameTruth& frame) {
    for (std::size_t o = 0; o < history.shown.size(); ++o) {
      const auto is_of = [&](const host::BlobTruth& blob) { return blob.object == o; };
      if (std::any_of(frame.blobs.begin(), frame.blobs.end(), is_of)) {
        history.shown[o].push_back(frame.frame.t.to_double());
      }
    }
  };
  const auto summary = host::simulate_driven(encounter.scene, driven, hear, watch);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  listener.finish();
  progress.at(history.end);
  history.progress = progress.steps();
  history.alerts = listener.alerts();
  history.objects = listener.objects();
  history.complaints = listener.complaints();
  return history;
}

}  // namespace fencepost::test
