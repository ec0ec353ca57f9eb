#include "host/evaluate/evaluate.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

#include "host/evaluate/cut.hpp"
#include "host/evaluate/following.hpp"
#include "host/evaluate/matching.hpp"
#include "host/evaluate/simulated_truths.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

/// Observes the run: keeps a snapshot of each object at each number of views, and which true object it follows.
class Watch final : public RunObserver {
 public:
  using Owners = std::function<std::optional<BlobOwners>(const recon::WaitingFrame&)>;

  /// `again`: the next frame is the first one of the scene.
  Watch(Owners owners, std::function<void()> again, const std::vector<std::uint32_t>& views)
      : owners_(std::move(owners)), again_(std::move(again)), views_(views) {}

  void run_begins() override {
    again_();
    following_.clear();
    snapshots_.clear();
    signature_frames_.fill(0);
    frames_ = 0;
    labelled_ = 0;
  }

  void frame_placed(const PlacedFrame& placed) override {
    const bool same_so_far = labelled_ == frames_++;
    std::array<bool, 256> seen{};
    for (const recon::WaitingBlob& blob : placed.frame.blobs) seen[blob.signature] = true;
    for (std::size_t s = 0; s < seen.size(); ++s) signature_frames_[s] += seen[s] ? 1U : 0U;
    if (const auto owners = same_so_far ? owners_(placed.frame) : std::nullopt) {
      ++labelled_;
      following_.add(*owners, placed.sightings);
      following_.forget_deleted(placed.in_map);
    }
    if (snapshots_.size() >= kManyObjects) {
      std::erase_if(snapshots_, [&](const auto& one) { return !placed.in_map(one.first); });
    }
    for (const PlacedSighting& sighting : placed.sightings) {
      if (!std::binary_search(views_.begin(), views_.end(), sighting.views)) continue;
      snapshots_[sighting.id].push_back(placed.describe(sighting.id));
    }
  }

  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] bool frame_truth() const { return frames_ > 0 && labelled_ == frames_; }
  [[nodiscard]] const Following& following() const { return following_; }
  [[nodiscard]] std::uint64_t visible(std::size_t truth, std::uint8_t signature) const {
    return frame_truth() ? following_.visible(truth) : signature_frames_[signature];
  }
  /// The object's snapshots by views, ascending.
  [[nodiscard]] std::vector<ObjectResult> snapshots(std::uint32_t id) const {
    const auto found = snapshots_.find(id);
    return found == snapshots_.end() ? std::vector<ObjectResult>{} : found->second;
  }

 private:
  Owners owners_;
  std::function<void()> again_;
  const std::vector<std::uint32_t>& views_;
  Following following_;
  std::map<std::uint32_t, std::vector<ObjectResult>> snapshots_;
  std::array<std::uint64_t, 256> signature_frames_{};
  std::uint64_t frames_ = 0;
  std::uint64_t labelled_ = 0;
};

bool is_confirmed(const ObjectResult& object) { return object.state != record::ObjectState::kTentative; }

void measure_found(const ObjectResult& object, const Polygon& footprint, const Watch& watch, ObjectEvaluation& result) {
  result.found = {object.id, object.state, object.views};
  if (watch.frame_truth()) result.swaps = watch.following().swaps(object.id);
  for (const ObjectResult& snapshot : watch.snapshots(object.id)) {
    result.cuts.push_back(cut_of(snapshot, footprint, false));
  }
  result.cuts.push_back(cut_of(object, footprint, true));
}

/// An object that was not found counts as a model without area, at each number of views that it offered.
void measure_absent(const std::vector<std::uint32_t>& views, ObjectEvaluation& result) {
  for (const std::uint32_t count : views) {
    if (count <= result.visible) result.cuts.push_back({count, false, std::nullopt, {}});
  }
  result.cuts.push_back({static_cast<std::uint32_t>(result.visible), true, std::nullopt, {}});
}

std::vector<ObjectEvaluation> measure_objects(const std::vector<ObjectResult>& objects,
                                              const std::vector<std::optional<std::size_t>>& matches,
                                              const Scene& scene, const Watch& watch,
                                              const std::vector<std::uint32_t>& views) {
  std::vector<ObjectEvaluation> results;
  for (std::size_t truth = 0; truth < scene.objects.size(); ++truth) {
    const SceneObject& object = scene.objects[truth];
    ObjectEvaluation& result = results.emplace_back();
    result.truth = truth;
    result.name = object.name;
    result.signature = object.signature;
    result.visible = watch.visible(truth, object.signature);
    const auto match = std::find(matches.begin(), matches.end(), std::optional(truth));
    const ObjectResult* found =
        match == matches.end() ? nullptr : &objects[static_cast<std::size_t>(match - matches.begin())];
    result.missed = result.visible >= kVisibleFrames && (found == nullptr || !is_confirmed(*found));
    if (found != nullptr) {
      measure_found(*found, object.footprint, watch, result);
    } else if (result.missed) {
      measure_absent(views, result);
    }
  }
  return results;
}

using Replay = std::function<ReplayOutcome(const ReplayOptions&)>;

EvaluateOutcome evaluate_by(const Replay& replay, Watch& watch, const Scene& truth, const EvaluateOptions& options) {
  ReplayOptions replay_options;
  replay_options.profile = options.profile;
  replay_options.camera = options.camera;
  replay_options.observer = &watch;
  EvaluateOutcome outcome{{}, replay(replay_options)};
  if (outcome.replay.unreadable) return outcome;

  const ResultDocument& result = outcome.replay.result;
  const auto matches = match_objects(result.objects, truth);
  Evaluation& evaluation = outcome.evaluation;
  evaluation.frame_truth = watch.frame_truth();
  evaluation.frames = watch.frames();
  evaluation.digest = result.digest;
  evaluation.profile = result.profile;
  evaluation.models = model_names(result);
  evaluation.objects = measure_objects(result.objects, matches, truth, watch, options.views);
  for (std::size_t i = 0; i < result.objects.size(); ++i) {
    const ObjectResult& object = result.objects[i];
    if (matches[i] || !is_confirmed(object)) continue;
    evaluation.phantoms.push_back({object.id, object.signature, object.views, std::nullopt});
    if (watch.frame_truth()) evaluation.phantoms.back().follows = watch.following().follows(object.id);
  }
  if (watch.frame_truth()) evaluation.swaps = watch.following().swaps();
  return outcome;
}

/// Where nobody reads the alerts.
class NoAlerts final : public AlertSink {
 public:
  void run_begins() override {}
  void hear(const record::AlertReport& /*alert*/) override {}
};

EvaluateOutcome evaluate_simulated(const Replay& replay, const Scene& truth, const EvaluateOptions& options) {
  SimulatedTruths truths(truth);
  Watch watch([&](const recon::WaitingFrame& frame) { return truths.owners(frame); }, [&] { truths.restart(); },
              options.views);
  return evaluate_by(replay, watch, truth, options);
}

}  // namespace

EvaluateOutcome evaluate(const LogSource& log, const std::string& name, const Scene& truth,
                         const EvaluateOptions& options) {
  NoAlerts nobody;
  const Replay by_source = [&](ReplayOptions replay_options) {
    replay_options.alerts = &nobody;
    replay_options.most_poses = 2;
    return replay(log, name, replay_options);
  };
  return evaluate_simulated(by_source, truth, options);
}

EvaluateOutcome evaluate(std::string_view log, const std::string& name, const Scene& truth,
                         const EvaluateOptions& options) {
  return evaluate_simulated([&](const ReplayOptions& replay_options) { return replay(log, name, replay_options); },
                            truth, options);
}

EvaluateOutcome evaluate(std::string_view log, const std::string& name, const Scene& truth,
                         const FrameTruths& frame_truths, const EvaluateOptions& options) {
  Watch watch([&](const recon::WaitingFrame& frame) { return frame_truths.owners(frame); }, [] {}, options.views);
  return evaluate_by([&](const ReplayOptions& replay_options) { return replay(log, name, replay_options); }, watch,
                     truth, options);
}

}  // namespace fencepost::host
