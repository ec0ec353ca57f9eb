#include "host/merge/merge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hal/base/fnv1a.hpp"
#include "host/merge/move.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using recon::ConstellationPoint;

/// More objects than any profile has.
constexpr std::size_t kMaxPoints = 128;
/// Views of an object before it counts: fewer may have made it of noise.
constexpr std::uint32_t kMinViews = 8;
/// On its own sigma: its views were taken for independent. As recon::kOverconfidence, of the variance.
constexpr double kOverconfident = 2;
/// m; a place that is known worse would match anything.
constexpr double kWorstSigma = 0.3;

}  // namespace

KnownPoints known_points(const ResultDocument& document) {
  KnownPoints all;
  for (std::size_t i = 0; i < document.objects.size() && all.points.size() < kMaxPoints; ++i) {
    const ObjectResult& object = document.objects[i];
    const Circle* circle = object_circle(object);
    const double sigma = kOverconfident * object.sigma;
    const bool known = circle != nullptr && object.state != record::ObjectState::kTentative;
    if (!known || object.views < kMinViews || !(sigma > 0) || sigma > kWorstSigma) continue;
    ConstellationPoint point;
    point.place = {static_cast<float>(circle->center.x), static_cast<float>(circle->center.y)};
    point.sigma = static_cast<float>(sigma);
    point.radius = static_cast<float>(circle->radius);
    point.signature = object.signature;
    all.points.push_back(point);
    all.objects.push_back(i);
  }
  return all;
}

namespace {

using Points = KnownPoints;

class Merging {
 public:
  explicit Merging(const std::vector<RunMap>& runs) : runs_(runs), digest_(base::Fnv1a64{}) {
    for (const RunMap& run : runs) {
      merged_.runs.push_back({});
      merged_.runs.back().log = run.log;
      points_.push_back(known_points(run.result));
      merged_.runs.back().objects = static_cast<std::uint32_t>(points_.back().points.size());
    }
  }

  MergedMap run() {
    begin();
    // The surest first: it makes the map that judges the others.
    while (const std::optional<Found> best = surest()) take(*best);
    find_starts();
    merged_.map.digest = digest_.value();
    return std::move(merged_);
  }

 private:
  struct Found {
    std::size_t run = 0;
    recon::JoinResult result;
    std::vector<std::uint8_t> partners;
    Points known;
  };

  void begin() {
    const ResultDocument& first = runs_.front().result;
    merged_.map.profile = first.profile;
    merged_.map.pose = first.pose;
    merged_.runs.front().verdict = recon::JoinVerdict::kJoined;
    for (const ObjectResult& object : first.objects) add(object, {0, object.id});
    add_rest(0, Motion{});
  }

  std::optional<Found> surest() {
    std::optional<Found> best;
    const Points known = known_points(merged_.map);
    for (std::size_t i = 1; i < runs_.size(); ++i) {
      RunJoin& join = merged_.runs[i];
      if (join.joined()) continue;
      recon::ConstellationSearch<kMaxPoints> search(known.points, points_[i].points);
      while (search.step()) {
      }
      const recon::JoinResult result = search.result();
      note(join, result);
      if (result.verdict != recon::JoinVerdict::kJoined) continue;
      if (best && best->result.false_alarms <= result.false_alarms) continue;
      best = Found{i, result, {search.partners().begin(), search.partners().end()}, known};
    }
    for (std::size_t i = 1; i < runs_.size(); ++i) {  // the others wait for a larger map
      RunJoin& join = merged_.runs[i];
      if (join.joined() && !taken(i) && !(best && best->run == i)) join.verdict = recon::JoinVerdict::kTooFew;
    }
    return best;
  }
  // A map of few objects may belong nowhere surely, and its run all the same.
  void find_starts() {
    const Points known = known_points(merged_.map);
    for (std::size_t i = 1; i < runs_.size(); ++i) {
      RunJoin& join = merged_.runs[i];
      if (join.joined() || runs_[i].bytes.empty()) continue;
      RelocateOptions options;
      options.camera = runs_[i].camera;
      join.start = relocate(runs_[i].bytes, known.points, options);
    }
  }
  [[nodiscard]] bool taken(std::size_t run) const {
    return std::find(taken_.begin(), taken_.end(), run) != taken_.end();
  }

  static void note(RunJoin& join, const recon::JoinResult& result) {
    const Motion motion = Motion::of(result.motion);
    join.verdict = result.verdict;
    join.frame = {0, motion.shift.x, motion.shift.y, motion.heading()};
    join.matched = result.quality.matched;
    join.missing = static_cast<std::uint32_t>(result.quality.expected - result.quality.matched);
    join.false_alarms = static_cast<double>(result.false_alarms);
    join.misfit = result.quality.matched == 0
                      ? 0
                      : std::sqrt(static_cast<double>(result.quality.misfit) / result.quality.matched);
  }

  void take(const Found& found) {
    taken_.push_back(found.run);
    const Motion motion = Motion::of(found.result.motion);
    const ResultDocument& from = runs_[found.run].result;
    std::vector<std::optional<std::size_t>> same(from.objects.size());
    for (std::size_t p = 0; p < found.partners.size(); ++p) {
      if (found.partners[p] == recon::constellation::kNone) continue;
      same[points_[found.run].objects[p]] = found.known.objects[found.partners[p]];
    }
    for (std::size_t i = 0; i < from.objects.size(); ++i) {
      const ObjectResult moved = motion.of(from.objects[i]);
      const MergeSource source{found.run, from.objects[i].id};
      if (same[i]) {
        join_object(*same[i], moved, source);
      } else {
        add(moved, source);
      }
    }
    add_rest(found.run, motion);
  }

  void add(ObjectResult object, MergeSource source) {
    object.id = static_cast<std::uint32_t>(merged_.map.objects.size() + 1);
    merged_.map.objects.push_back(std::move(object));
    merged_.sources.push_back({source});
  }

  // The mean of both places by their sigmas, with the models of the one that was seen more often moved there.
  void join_object(std::size_t at, const ObjectResult& other, MergeSource source) {
    ObjectResult& known = merged_.map.objects[at];
    const Circle a = *object_circle(known);
    const Circle b = *object_circle(other);
    const double wa = 1 / (known.sigma * known.sigma);
    const double wb = 1 / (other.sigma * other.sigma);
    const Point mean = {(wa * a.center.x + wb * b.center.x) / (wa + wb),
                        (wa * a.center.y + wb * b.center.y) / (wa + wb)};
    const bool others = other.views > known.views;
    const Circle& kept = others ? b : a;
    ObjectResult joined = Motion{{1, 0}, {mean.x - kept.center.x, mean.y - kept.center.y}}.of(others ? other : known);
    joined.id = known.id;
    joined.views = known.views + other.views;
    joined.sigma = 1 / std::sqrt(wa + wb);
    joined.confidence = std::max(known.confidence, other.confidence);
    if (other.state == record::ObjectState::kConfirmed) joined.state = other.state;
    known = std::move(joined);
    merged_.sources[at].push_back(source);
  }

  void add_rest(std::size_t run, const Motion& motion) {
    const ResultDocument& from = runs_[run].result;
    add_counts(from.log);
    for (const PoseResult& pose : from.path) merged_.map.path.push_back(motion.of(pose));
    for (const GuardPoint& point : from.guard) {
      const Point moved = motion.of(Point{point.x, point.y});
      merged_.map.guard.push_back({moved.x, moved.y, point.signature});
    }
    for (const record::Signature& signature : from.signatures) add_signature(signature, run);
    digest_.i64(static_cast<std::int64_t>(from.digest));
  }

  void add_counts(const LogCounts& log) {
    LogCounts& sum = merged_.map.log;
    sum.records += log.records;
    sum.frames += log.frames;
    sum.odometry += log.odometry;
    sum.foreign += log.foreign;
    sum.refused.no_pose += log.refused.no_pose;
    sum.refused.odometry_gap += log.refused.odometry_gap;
    sum.refused.no_camera += log.refused.no_camera;
    sum.refused.queue += log.refused.queue;
    for (std::size_t i = 0; i < sum.rejected.size(); ++i) sum.rejected[i].count += log.rejected[i].count;
  }

  void add_signature(const record::Signature& signature, std::size_t run) {
    const record::Signature* known = find_signature(merged_.map, signature.signature);
    if (known == nullptr) {
      merged_.map.signatures.push_back(signature);
    } else if (known->name.view() != signature.name.view()) {
      merged_.notes.push_back("signature " + std::to_string(signature.signature) + " is \"" +
                              std::string(known->name.view()) + "\" in the first logs and \"" +
                              std::string(signature.name.view()) + "\" in " + runs_[run].log +
                              "; it was taken for one, by its number");
    }
  }

  const std::vector<RunMap>& runs_;
  std::vector<Points> points_;
  std::vector<std::size_t> taken_{0};
  MergedMap merged_;
  base::Fnv1a64 digest_;
};

}  // namespace

MergedMap merge(const std::vector<RunMap>& runs) { return Merging(runs).run(); }

}  // namespace fencepost::host
