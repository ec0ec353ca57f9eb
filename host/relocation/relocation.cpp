#include "host/relocation/relocation.hpp"

#include <algorithm>
#include <cmath>

#include "hal/base/exp.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

// Chosen on the relocation study's data set D1, which they hardly move; judged on D4, D6 and D7.
/// Maximum sigma of a sighting's range, as a share of the range.
constexpr float kWorstRange = 0.34F;
/// Candidates all around a thing.
constexpr int kAround = 24;
constexpr float kPlaceStrays = 0.05F;        ///< sigma of the odometry's drift, m per root of a metre
constexpr float kTurnStrays = 0.05F;         ///< rad per root of a metre
constexpr float kTurnStraysTurning = 0.08F;  ///< rad per root of a radian
constexpr float kThingSigma = 0.05F;         ///< m, sigma of a thing's place in the map beside its own: maps are bent
constexpr float kRangeShare = 0.04F;         ///< a further sigma, as a share of the range
/// Factor on the variance of a thing that was met before: repeated sightings share their error.
constexpr float kSeenAgain = 6.0F;
/// Gate, sigmas^2: a thing within it is where the candidate predicts it.
constexpr float kGate = 9.0F;
/// Share of things that are new, moved, or of a wrong colour.
constexpr float kStrangers = 0.05F;
/// Factor on a candidate's weight after a sighting that fits none of the known things it could be.
constexpr float kMissed = 0.7F;
constexpr float kSamePlace = 0.5F;  ///< m within which candidates are the same place
constexpr float kSameTurn = 0.96F;  ///< cosine of the angle within which they are
/// Share of the probability that other places may keep when one is reported.
constexpr float kMaxDoubt = 0.003F;
/// Known things that must have been met before a place is reported.
constexpr int kFewestMet = 3;
constexpr float kWorstPlace = 0.3F;  ///< m, sigma of a reported place
constexpr float kWorstTurn = 0.1F;   ///< rad, sigma of its heading
/// m: the known map reaches this far beyond its farthest thing.
constexpr float kBeyondTheMap = 0.5F;

using Covariance2 = Eigen::Matrix2f;
using Row3 = Eigen::Matrix<float, 2, 3>;

float power2(float value) { return value * value; }

Covariance2 covariance_of(const RangedSighting& sighted, const Vec2& rotation) {
  const Vec2 d = rotated(rotation, sighted.direction);
  const float more = sighted.along - sighted.across;
  Covariance2 c;
  c << sighted.across + more * d.x() * d.x(), more * d.x() * d.y(), more * d.x() * d.y(),
      sighted.across + more * d.y() * d.y();
  return c;
}

// Derivative of the thing's place, by place and rotation.
Row3 jacobian(const Vec2& away) {
  Row3 j;
  j << 1, 0, -away.y(), 0, 1, away.x();
  return j;
}

Covariance2 inverse(const Covariance2& m, float& determinant) {
  determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  Covariance2 out;
  out << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return out / determinant;
}

Vec2 turned_by(const Vec2& rotation, float angle) {
  const Vec2 next = rotation + angle * left_of(rotation);
  return next.normalized();
}

/// How well a thing of the map fits a sighting, as a candidate predicts it.
struct Fit {
  std::size_t known = constellation::kNone;
  float distance = 0;  ///< sigmas^2
  float density = 0;   ///< 1/m^2
  Eigen::Vector2f off = Eigen::Vector2f::Zero();
  Covariance2 weight = Covariance2::Zero();
};

}  // namespace

std::optional<KnownRadius> radius_of(std::span<const ConstellationPoint> known, std::uint8_t signature) {
  float count = 0;
  float sum = 0;
  float squares = 0;
  for (const ConstellationPoint& point : known) {
    if (point.signature != signature || !(point.radius > 0)) continue;
    ++count;
    sum += point.radius;
    squares += power2(point.radius) + power2(point.sigma);
  }
  if (!(count > 0)) return std::nullopt;
  const float mean = sum / count;
  return KnownRadius{mean, std::sqrt(std::max(squares / count - mean * mean, 0.0F))};
}

std::optional<RangedSighting> ranged(const Sighting& sighting, const KnownRadius& radius,
                                     const MeasurementNoise& noise) {
  if (!sighting.both_edges()) return std::nullopt;
  const float width = cross(sighting.right.direction, sighting.left.direction);
  if (!(width > 0)) return std::nullopt;
  const float direction = direction_variance(sighting, sighting.left, noise);
  RangedSighting ranged;
  ranged.direction = sighting.center;
  ranged.range = 2 * radius.mean / width;
  ranged.along = power2(ranged.range) * (2 * direction / (width * width) + power2(radius.sigma / radius.mean));
  const float ahead = sighting.center.dot(sighting.axis);
  const RowDepth row = row_depth(sighting, noise);
  if (row.known && ahead > 0) {
    const float by_foot = row.depth / ahead + radius.mean;
    const float variance = row.variance / (ahead * ahead);
    ranged.range = (ranged.range * variance + by_foot * ranged.along) / (variance + ranged.along);
    ranged.along *= variance / (variance + ranged.along);
  }
  if (!(ranged.along < power2(kWorstRange * ranged.range))) return std::nullopt;
  ranged.across = edge_variance(direction, ranged.range, noise);
  ranged.from_robot = sighting.lens + ranged.range * ranged.direction;
  return ranged;
}

RelocationFilter::RelocationFilter(std::span<const ConstellationPoint> known)
    : known_(known.first(std::min(known.size(), kMaxKnown))) {
  const constellation::Known all = constellation::make_known(known_);
  area_ = base::kPi * power2(all.reach + kBeyondTheMap);
}

void RelocationFilter::drive(const Vec2& step, float turned) {
  const float way = step.norm();
  const float turn_strays = way * power2(kTurnStrays) + std::fabs(turned) * power2(kTurnStraysTurning);
  for (Candidate& candidate : candidates_) {
    if (!(candidate.weight > 0)) continue;
    const Vec2 moved = rotated(candidate.rotation, step);
    candidate.place += moved;
    Eigen::Matrix3f along = Eigen::Matrix3f::Identity();
    along(0, 2) = -moved.y();
    along(1, 2) = moved.x();
    candidate.covariance = (along * candidate.covariance * along.transpose()).eval();
    candidate.covariance(0, 0) += way * power2(kPlaceStrays);
    candidate.covariance(1, 1) += way * power2(kPlaceStrays);
    candidate.covariance(2, 2) += turn_strays;
  }
}

void RelocationFilter::see(const RangedSighting& sighted, std::uint8_t signature) {
  float most = 0;
  for (Candidate& candidate : candidates_) {
    if (candidate.weight > 0) weigh(candidate, sighted, signature);
    most = std::max(most, candidate.weight);
  }
  constexpr float kLargest = 1e6F;  // beyond it nothing is surer
  for (Candidate& candidate : candidates_) {
    if (most > kLargest) candidate.weight *= kLargest / most;
    if (candidate.weight < 1e-9F) candidate.weight = 0;
  }
  propose(sighted, signature);
}

void RelocationFilter::weigh(Candidate& candidate, const RangedSighting& sighted, std::uint8_t signature) const {
  const Vec2 away = rotated(candidate.rotation, sighted.from_robot);
  const Row3 j = jacobian(away);
  const Covariance2 seen = covariance_of(sighted, candidate.rotation);
  const Covariance2 own = j * candidate.covariance * j.transpose();
  Fit best;
  float density = 0;
  float alike = 0;
  for (std::size_t k = 0; k < known_.size(); ++k) {
    if (known_[k].signature != signature) continue;
    ++alike;
    const bool again = ((candidate.met >> k) & 1U) != 0;
    Covariance2 sum = seen;
    const float place = power2(known_[k].sigma) + power2(kThingSigma) + power2(kRangeShare * sighted.range);
    sum(0, 0) += place;
    sum(1, 1) += place;
    if (again) sum *= kSeenAgain;
    sum += own;
    Fit fit;
    float determinant = 0;
    fit.known = k;
    fit.weight = inverse(sum, determinant);
    const Vec2 off = known_[k].place - candidate.place - away;
    fit.off = {off.x(), off.y()};
    fit.distance = fit.off.dot(fit.weight * fit.off);
    fit.density = base::exp_minus(0.5F * fit.distance) / (2 * base::kPi * std::sqrt(determinant));
    density += fit.density;
    if (best.known == constellation::kNone || fit.density > best.density) best = fit;
  }
  if (best.known == constellation::kNone) return;
  const std::uint32_t bit = 1U << best.known;
  const bool fits = best.distance <= kGate;
  if ((candidate.met & bit) != 0 || !fits) {
    candidate.weight *= fits ? 1.0F : kMissed;
  } else {
    candidate.weight *= (1 - kStrangers) * area_ / alike * density + kStrangers;
    candidate.met |= bit;
  }
  if (!fits) return;
  const Eigen::Matrix<float, 3, 2> gain = candidate.covariance * j.transpose() * best.weight;
  const Eigen::Vector3f correction = gain * best.off;
  candidate.place += Vec2{correction.x(), correction.y()};
  candidate.rotation = turned_by(candidate.rotation, correction.z());
  candidate.covariance = (candidate.covariance - gain * j * candidate.covariance).eval();
  candidate.covariance = (0.5F * (candidate.covariance + candidate.covariance.transpose())).eval();
}

// All around each thing of the colour.
void RelocationFilter::propose(const RangedSighting& sighted, std::uint8_t signature) {
  float alike = 0;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < known_.size(); ++k) {
    if (known_[k].signature != signature) continue;
    ++alike;
    bits |= 1U << k;
  }
  if (bits == 0 || (proposed_ & bits) != 0 || alike * kAround > static_cast<float>(kCandidates)) return;
  proposed_ |= bits;
  constexpr float kStep = 2 * base::kPi / kAround;
  for (std::size_t k = 0; k < known_.size(); ++k) {
    if (((bits >> k) & 1U) == 0) continue;
    for (int i = 0; i < kAround; ++i) {
      const base::SinCos turn = base::sincos_urad(static_cast<std::int64_t>(1e6F * kStep * static_cast<float>(i)));
      Candidate candidate;
      candidate.rotation = {turn.cos, turn.sin};
      const Vec2 away = rotated(candidate.rotation, sighted.from_robot);
      candidate.place = known_[k].place - away;
      const Covariance2 seen = covariance_of(sighted, candidate.rotation);
      const float place = power2(known_[k].sigma) + power2(kThingSigma) + power2(kRangeShare * sighted.range);
      constexpr float kTurn = kStep * kStep / 4;
      const Eigen::Vector3f lever(away.y(), -away.x(), 1);  // of an error of the rotation
      candidate.covariance = kTurn * lever * lever.transpose();
      candidate.covariance.topLeftCorner<2, 2>() += seen + place * Covariance2::Identity();
      candidate.weight = 1 / (alike * kAround);
      candidate.met = 1U << k;
      put(candidate);
    }
  }
}

// In the place of the least likely one.
void RelocationFilter::put(const Candidate& candidate) {
  const auto least = std::min_element(candidates_.begin(), candidates_.end(),
                                      [](const Candidate& a, const Candidate& b) { return a.weight < b.weight; });
  if (least->weight < candidate.weight) *least = candidate;
}

std::optional<Relocation> RelocationFilter::found() const {
  const auto best = std::max_element(candidates_.begin(), candidates_.end(),
                                     [](const Candidate& a, const Candidate& b) { return a.weight < b.weight; });
  float same = 0;
  float all = 1;  // a place that is not in the map
  for (const Candidate& candidate : candidates_) {
    all += candidate.weight;
    const bool there = (candidate.place - best->place).squared_norm() < power2(kSamePlace) &&
                       candidate.rotation.dot(best->rotation) > kSameTurn;
    if (there) same += candidate.weight;
  }
  const Eigen::Matrix3f& covariance = best->covariance;
  const Relocation found{best->place, best->rotation, 1 - same / all, __builtin_popcount(best->met)};
  const bool sure = found.doubt <= kMaxDoubt && found.met >= kFewestMet &&
                    covariance(0, 0) + covariance(1, 1) <= 2 * power2(kWorstPlace) &&
                    covariance(2, 2) <= power2(kWorstTurn);
  if (!sure) return std::nullopt;
  return found;
}

}  // namespace fencepost::recon
