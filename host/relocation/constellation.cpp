#include "host/relocation/constellation.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::recon {
namespace {

// Chosen on random worlds of the seeds 1 to 400, judged on 50,001 to 50,400 (Constellation.*, accuracy.md).
/// sigmas: farther apart two places are not the same object's.
constexpr float kMatchSigmas = 3.0F;
/// m, sigma of every place beside its own: the error that all views of a map have in common.
constexpr float kPlaceSigma = 0.02F;
/// share of the distance between two objects by which a map may be bent: drift that nothing corrected.
constexpr float kBend = 0.03F;
/// m: whatever the sigmas are, nothing matches from farther away.
constexpr float kWidestGate = 0.75F;
/// m: objects nearer to each other than this give no direction.
constexpr float kNearestPair = 0.25F;
/// Allowed difference of radii, as a share of the larger one: most are seen from one side.
constexpr float kRadiusShare = 0.5F;
constexpr float kRadiusMore = 0.05F;   ///< m, added to that
constexpr float kRegionMargin = 0.5F;  ///< m: the known map reaches this far beyond its farthest object
constexpr int kRefinements = 3;

constexpr std::uint8_t kFewestMatches = 3;
/// Motions as good that two maps of different places are expected to have.
constexpr float kFalseAlarms = 1e-3F;
/// Minimum ratio of the rival's chance to the best one's.
constexpr float kLead = 100.0F;

float square_of(float value) { return value * value; }

float distance(const Vec2& a, const Vec2& b) { return (a - b).norm(); }

bool alike_in_kind(const ConstellationPoint& a, const ConstellationPoint& b) {
  if (a.signature != b.signature) return false;
  const float larger = std::max(a.radius, b.radius);
  return std::fabs(a.radius - b.radius) <= kRadiusShare * larger + kRadiusMore;
}

float variance_of(const ConstellationPoint& a, const ConstellationPoint& b) {
  return square_of(a.sigma) + square_of(b.sigma) + 2 * square_of(kPlaceSigma);
}

// An error of the direction (`turn`, its sine) moves points far from the middle of the matches most.
float gate_of(const ConstellationPoint& a, const ConstellationPoint& b, float from_middle, float turn) {
  const float sigma = std::sqrt(variance_of(a, b) + square_of(turn * from_middle));
  return std::min(kMatchSigmas * sigma, kWidestGate);
}

// Weighted sums of matches.
struct Matches {
  float weight = 0;
  Vec2 known{0, 0};
  Vec2 seen{0, 0};
  Vec2 turn{0, 0};

  void add_places(const ConstellationPoint& k, const ConstellationPoint& s) {
    const float w = 1 / variance_of(k, s);
    weight += w;
    known += w * k.place;
    seen += w * s.place;
  }
  void add_turn(const ConstellationPoint& k, const ConstellationPoint& s) {
    const Vec2 a = k.place - known / weight;
    const Vec2 b = s.place - seen / weight;
    turn += Vec2(a.dot(b), cross(b, a)) / variance_of(k, s);
  }
  // The rigid motion of least squares; none where the matches give no direction.
  bool motion(FrameMotion& out) const {
    const float length = turn.norm();
    if (!(length > 0)) return false;
    out.rotation = turn / length;
    out.shift = known / weight - rotated(out.rotation, seen / weight);
    return true;
  }
};

struct Judge {
  const constellation::Known& known;
  std::span<const ConstellationPoint> seen;
  FrameMotion& motion;
  std::span<std::uint8_t> partners;
  Vec2 middle{0, 0};  ///< of the matches, in the known map
  float turn = kBend;

  [[nodiscard]] std::size_t nearest_known(std::size_t s) const {
    const Vec2 place = motion.of(seen[s].place);
    float least = square_of(kWidestGate);
    std::size_t nearest = constellation::kNone;
    for (std::size_t k = 0; k < known.points.size(); ++k) {
      const float apart = (known.points[k].place - place).squared_norm();
      if (apart >= least || !alike_in_kind(known.points[k], seen[s])) continue;
      if (apart > square_of(gate_of(known.points[k], seen[s], distance(place, middle), turn))) continue;
      least = apart;
      nearest = k;
    }
    return nearest;
  }

  [[nodiscard]] bool is_nearest_seen(std::size_t s, std::size_t k) const {
    const float apart = (known.points[k].place - motion.of(seen[s].place)).squared_norm();
    for (std::size_t other = 0; other < seen.size(); ++other) {
      if (other == s || !alike_in_kind(known.points[k], seen[other])) continue;
      if ((known.points[k].place - motion.of(seen[other].place)).squared_norm() < apart) return false;
    }
    return true;
  }

  void match() {
    for (std::size_t s = 0; s < seen.size(); ++s) {
      const std::size_t k = nearest_known(s);
      partners[s] =
          k != constellation::kNone && is_nearest_seen(s, k) ? static_cast<std::uint8_t>(k) : constellation::kNone;
    }
  }

  // Refines by all matches: then only the bend of the map limits the direction.
  void refine() {
    Matches matches;
    for (std::size_t s = 0; s < seen.size(); ++s) {
      if (partners[s] != constellation::kNone) matches.add_places(known.points[partners[s]], seen[s]);
    }
    if (!(matches.weight > 0)) return;
    for (std::size_t s = 0; s < seen.size(); ++s) {
      if (partners[s] != constellation::kNone) matches.add_turn(known.points[partners[s]], seen[s]);
    }
    if (!matches.motion(motion)) return;
    middle = matches.known / matches.weight;
    turn = kBend;
  }

  // Probability that a place drawn at random in the known map's region comes as near to one of its kind.
  [[nodiscard]] float chance_of(std::size_t s, const Vec2& place) const {
    float area = 0;
    for (const ConstellationPoint& point : known.points) {
      if (alike_in_kind(point, seen[s])) area += square_of(gate_of(point, seen[s], distance(place, middle), turn));
    }
    return std::min(1.0F, area / square_of(known.reach + kRegionMargin));
  }

  // Binomial over the expected ones, each by its chance, without the two whose match made the motion.
  [[nodiscard]] JoinQuality quality() const {
    JoinQuality result;
    float largest[2] = {0, 0};  // the two that made it are taken for the likeliest
    for (std::size_t s = 0; s < seen.size(); ++s) {
      const Vec2 place = motion.of(seen[s].place);
      const bool matched = partners[s] != constellation::kNone;
      if (matched || distance(place, known.middle) < known.reach) ++result.expected;
      if (!matched) continue;
      ++result.matched;
      const float chance = chance_of(s, place);
      result.chance *= chance;
      if (chance > largest[0]) {
        largest[1] = largest[0];
        largest[0] = chance;
      } else if (chance > largest[1]) {
        largest[1] = chance;
      }
      result.misfit += (known.points[partners[s]].place - place).squared_norm();
    }
    if (result.matched < 2) return {1, 0, result.matched, result.expected};
    result.chance /= largest[0] * largest[1];
    for (int i = 1; i <= result.expected - result.matched; ++i) {  // n - 2 over k - 2
      result.chance *= static_cast<float>(result.matched - 2 + i) / static_cast<float>(i);
    }
    return result;
  }
};

}  // namespace

namespace constellation {

Known make_known(std::span<const ConstellationPoint> points) {
  Known known{points, {0, 0}, 0};
  if (points.empty()) return known;
  for (const ConstellationPoint& point : points) known.middle += point.place;
  known.middle /= static_cast<float>(points.size());
  for (const ConstellationPoint& point : points)
    known.reach = std::max(known.reach, distance(point.place, known.middle));
  return known;
}

bool alike(const Known& known, PairOf k, std::span<const ConstellationPoint> seen, PairOf s) {
  const ConstellationPoint& ka = known.points[k.a];
  const ConstellationPoint& kb = known.points[k.b];
  if (!alike_in_kind(ka, seen[s.a]) || !alike_in_kind(kb, seen[s.b])) return false;
  const float known_length = distance(ka.place, kb.place);
  const float seen_length = distance(seen[s.a].place, seen[s.b].place);
  if (std::min(known_length, seen_length) < kNearestPair) return false;
  const float variance = variance_of(ka, seen[s.a]) + variance_of(kb, seen[s.b]) + square_of(kBend * seen_length);
  return square_of(known_length - seen_length) <= square_of(kMatchSigmas) * variance;
}

JoinQuality judge(const Known& known, PairOf k, std::span<const ConstellationPoint> seen, PairOf s, FrameMotion& motion,
                  std::span<std::uint8_t> partners) {
  const ConstellationPoint& ka = known.points[k.a];
  const ConstellationPoint& kb = known.points[k.b];
  Matches pair;
  pair.add_places(ka, seen[s.a]);
  pair.add_places(kb, seen[s.b]);
  pair.add_turn(ka, seen[s.a]);
  pair.add_turn(kb, seen[s.b]);
  if (!pair.motion(motion)) return {};
  Judge judge{known, seen, motion, partners, pair.known / pair.weight, kBend};
  const float across = std::sqrt(variance_of(ka, seen[s.a]) + variance_of(kb, seen[s.b]));
  judge.turn = std::max(kBend, across / distance(ka.place, kb.place));
  judge.match();
  for (int i = 0; i < kRefinements; ++i) {
    judge.refine();
    judge.match();
  }
  return judge.quality();
}

bool same(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  std::size_t both = 0;
  std::size_t either = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == kNone && b[i] == kNone) continue;
    ++either;
    if (a[i] == b[i]) ++both;
  }
  return 2 * both > either;
}

std::size_t in_common(std::span<const ConstellationPoint> a, std::span<const ConstellationPoint> b) {
  const auto of_other = [](std::span<const ConstellationPoint> these, std::span<const ConstellationPoint> others) {
    return static_cast<std::size_t>(std::count_if(these.begin(), these.end(), [&](const ConstellationPoint& point) {
      return std::any_of(others.begin(), others.end(),
                         [&](const ConstellationPoint& other) { return other.signature == point.signature; });
    }));
  };
  return std::min(of_other(a, b), of_other(b, a));
}

bool sharper(const JoinQuality& a, const JoinQuality& b) {
  return a.matched != b.matched ? a.matched > b.matched : a.misfit < b.misfit;
}

bool better(const JoinQuality& a, const JoinQuality& b) {
  if (b.matched < kFewestMatches || a.matched < kFewestMatches) {
    return sharper(a, b);
  }
  return a.chance != b.chance ? a.chance < b.chance : a.misfit < b.misfit;
}

}  // namespace constellation

JoinResult verdict_of(std::size_t in_common, const JoinQuality& best, const JoinQuality& rival, std::uint32_t motions,
                      const FrameMotion& motion) {
  JoinResult result{JoinVerdict::kTooFew, motion, best, 1, 0};
  if (in_common < kFewestMatches) return result;
  result.verdict = JoinVerdict::kNoMatch;
  if (best.matched < kFewestMatches) return result;
  result.false_alarms = std::min(1.0F, best.chance * static_cast<float>(motions));
  const float beside = rival.matched < kFewestMatches ? 1.0F : std::min(1.0F, rival.chance);
  result.lead = beside / std::max(best.chance, 1e-30F);
  result.verdict = JoinVerdict::kJoined;
  // More expected objects are missing than matched.
  const bool contradicted = 2 * best.matched < best.expected;
  if (contradicted) result.verdict = JoinVerdict::kContradicted;
  if (result.false_alarms > kFalseAlarms) result.verdict = JoinVerdict::kChance;
  if (result.lead < kLead && rival.matched >= kFewestMatches) result.verdict = JoinVerdict::kAmbiguous;
  return result;
}

}  // namespace fencepost::recon
