#include "firmware/recon/models/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "firmware/recon/models/hash.hpp"
#include "firmware/recon/models/inlier.hpp"
#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {
namespace {

// L D L' of the information. A general solver takes three times as many operations, and a square root in each pivot.
struct Factors {
  float xy, xr, yr;  ///< of L, below its diagonal of ones
  float x, y, r;     ///< one over D
};

// Nothing unless the matrix is positive definite.
std::optional<Factors> factorise(const Symmetric3& m) {
  if (!(m.xx > 0)) return std::nullopt;
  Factors f{};
  f.x = 1.0F / m.xx;
  f.xy = m.xy * f.x;
  f.xr = m.xr * f.x;
  const float pivot_y = m.yy - f.xy * m.xy;
  if (!(pivot_y > 0)) return std::nullopt;
  f.y = 1.0F / pivot_y;
  const float rest = m.yr - f.xr * m.xy;
  f.yr = rest * f.y;
  const float pivot_r = m.rr - f.xr * m.xr - f.yr * rest;
  if (!(pivot_r > 0)) return std::nullopt;
  f.r = 1.0F / pivot_r;
  return f;
}

Symmetric3 inverse(const Factors& f) {
  const float low = f.xy * f.yr - f.xr;  // of L's inverse, left below
  Symmetric3 inverse;
  inverse.rr = f.r;
  inverse.yr = -f.yr * f.r;
  inverse.xr = low * f.r;
  inverse.yy = f.y - f.yr * inverse.yr;
  inverse.xy = -f.xy * f.y - f.yr * inverse.xr;
  inverse.xx = f.x + f.xy * f.xy * f.y + low * inverse.xr;
  return inverse;
}

void solve_for(const Factors& f, const NormalEquations& equations, CylinderEstimate& estimate) {
  const float x = equations.moment.x();
  const float y = equations.moment.y() - f.xy * x;
  const float r = equations.moment_radius - f.xr * x - f.yr * y;
  estimate.radius = r * f.r;
  estimate.center.y() = y * f.y - f.yr * estimate.radius;
  estimate.center.x() = x * f.x - f.xy * estimate.center.y() - f.xr * estimate.radius;
}

CylinderEstimate solve_equations(const NormalEquations& equations, const Vec2& lens) {
  CylinderEstimate estimate;
  if (!(equations.information.rr > 0)) return estimate;
  estimate.refusal = CylinderRefusal::kParallax;
  const std::optional<Factors> factors = factorise(equations.information);
  if (!factors) return estimate;
  estimate.covariance = inverse(*factors);
  solve_for(*factors, equations, estimate);
  const Vec2 away = estimate.center - lens;
  const float distance_squared = away.squared_norm();
  const float limit = kMaxDistanceSigmaShare * distance_squared;
  // position_along(away) = distance^2 times the variance of the distance
  if (!(estimate.covariance.position_along(away) < limit * limit)) return estimate;
  const bool plausible = estimate.radius > 0 && estimate.radius < kLargestRadius;
  estimate.refusal = plausible ? CylinderRefusal::kNone : CylinderRefusal::kImplausible;
  return estimate;
}

NormalEquations with_radius(NormalEquations equations, const RadiusPrior& prior) {
  const float weight = 1.0F / (prior.sigma * prior.sigma);
  equations.information.rr += weight;
  equations.moment_radius += weight * prior.mean;
  return equations;
}

// Without enough parallax a typical radius replaces it.
CylinderEstimate solve_with_typical_radius(const NormalEquations& equations, const Vec2& lens, float sigma) {
  return solve_equations(with_radius(equations, {kTypicalRadius, sigma}), lens);
}

// How much farther than the edges the rows put an object, in sigmas.
float farther_by(const NormalEquations& rows, const CylinderEstimate& from_edges) {
  const float weight = rows.information.rr;
  const Vec2 mean_normal{rows.information.xr / weight, rows.information.yr / weight};
  const float residual = mean_normal.dot(from_edges.center) + from_edges.radius - rows.moment_radius / weight;
  const float variance = 1.0F / weight + from_edges.covariance.along(mean_normal);
  return residual / std::sqrt(variance);
}

void hash_symmetric(base::Fnv1a64& hash, const Symmetric3& m) {
  for (const float value : {m.xx, m.xy, m.yy, m.xr, m.yr, m.rr}) hash.f32(value);
}

void hash_equations(base::Fnv1a64& hash, const NormalEquations& equations) {
  hash_symmetric(hash, equations.information);
  hash_vec(hash, equations.moment);
  hash.f32(equations.moment_radius);
}

}  // namespace

float CylinderEstimate::outline_sigma() const {
  return std::sqrt(covariance.rr + 0.5F * (covariance.xx + covariance.yy));
}

void Symmetric3::scale(float factor) {
  xx *= factor;
  xy *= factor;
  yy *= factor;
  xr *= factor;
  yr *= factor;
  rr *= factor;
}

void Symmetric3::add(const Symmetric3& other) {
  xx += other.xx;
  xy += other.xy;
  yy += other.yy;
  xr += other.xr;
  yr += other.yr;
  rr += other.rr;
}

void NormalEquations::add(const Vec2& normal, float bound, float weight) {
  const Vec2 weighted = weight * normal;
  information.add({weighted.x() * normal.x(), weighted.x() * normal.y(), weighted.y() * normal.y(), weighted.x(),
                   weighted.y(), weight});
  moment += bound * weighted;
  moment_radius += bound * weight;
}

void NormalEquations::add_through_centre(const Vec2& normal, float bound, float weight) {
  const Vec2 weighted = weight * normal;
  information.add({weighted.x() * normal.x(), weighted.x() * normal.y(), weighted.y() * normal.y(), 0, 0, 0});
  moment += bound * weighted;
}

void NormalEquations::add(const NormalEquations& other) {
  information.add(other.information);
  moment += other.moment;
  moment_radius += other.moment_radius;
}

void NormalEquations::move_origin(const Vec2& shift) {
  // h' = h - n.shift in every row, so the moments change by the information's position columns.
  const Symmetric3& m = information;
  moment.x() -= m.xx * shift.x() + m.xy * shift.y();
  moment.y() -= m.xy * shift.x() + m.yy * shift.y();
  moment_radius -= m.xr * shift.x() + m.yr * shift.y();
}

void NormalEquations::scale(float factor) {
  information.scale(factor);
  moment *= factor;
  moment_radius *= factor;
}

void Cylinder::add(const Sighting& sighting, MapPoint origin, float novelty, const MeasurementNoise& noise) {
  const Vec2 lens = sighting.lens_from(origin);
  known_radius_ = sighting.known_radius;
  if (views_ < kFewestViews) ++views_;
  seen_whole_ = seen_whole_ || sighting.both_edges();
  if (!known_whole())
    whole_views_ = sighting.both_edges() ? static_cast<std::uint8_t>(whole_views_ + 1) : std::uint8_t{0};
  if (estimate_.ok() && agreement_ < kAgreementFloor) {
    scale_edges(kForgetting);
    rows_.scale(kForgetting);
    row_count_ *= kForgetting;
  }
  const float distance =
      estimate_.ok() ? std::max(kNearestLens, (estimate_.center - lens).norm()) : prior_distance(sighting);
  if (is_edge(sighting.left.end))
    add_edge(sighting, sighting.left, left_tangent(sighting, origin), distance, novelty, noise);
  if (is_edge(sighting.right.end))
    add_edge(sighting, sighting.right, right_tangent(sighting, origin), distance, novelty, noise);
  if (sighting.bearing) add_bearing(sighting, origin, distance, novelty, noise);
  RowDepth row = row_depth(sighting, noise);
  if (!row.known && !estimate_.ok()) row = hidden_row_depth(sighting);  // better than no distance at all
  if (row.known) {
    const Vec2 normal = -sighting.axis;
    const HalfPlane front{normal, normal.dot(lens) - row.depth};
    // The nearest point of a cut blob may be outside the image, up to a radius nearer.
    const float outside = sighting.cut_at_side ? usual_radius() : 0.0F;
    const float weight = novelty / (row.variance + shape_variance(noise) + outside * outside);
    rows_.add(front.normal, front.bound, weight);
    row_count_ += novelty;
    // Along a wall that the border cuts the row never changes.
    if (!sighting.cut_at_side && is_edge(sighting.bottom.end) &&
        std::fabs(cross(sighting.axis, sighting.center)) < kSameSide) {
      trend_.add(lens, sighting.center, row.depth / sighting.center.dot(sighting.axis), novelty / row.variance);
    }
  }
}

float Cylinder::usual_radius() const { return estimate_.ok() ? estimate_.radius : radius_prior(known_radius_).mean; }

float Cylinder::shape_variance(const MeasurementNoise& noise) const {
  const float shape = noise.roundness * usual_radius();
  return shape * shape;
}

void Cylinder::add_edge(const Sighting& sighting, const Ray& ray, const HalfPlane& tangent, float distance,
                        float novelty, const MeasurementNoise& noise) {
  const float direction = direction_variance(sighting, ray, noise);
  const float variance = edge_variance(direction, distance, noise) + shape_variance(noise);
  float weight = novelty / variance;
  if (estimate_.ok()) {
    const float residual = tangent.bound - tangent.normal.dot(estimate_.center) - estimate_.radius;
    const float expected = variance + estimate_.covariance.along(tangent.normal);
    const float inlier = inlier_share(residual, std::sqrt(expected), 1.0F);
    agreement_ += kAgreementGain * (inlier - agreement_);
    weight *= inlier;
  }
  edges_.add(tangent.normal, tangent.bound, weight);
  false_depth_ += weight * direction;
  if (edges_.information.rr > kMaxInformation) scale_edges(0.5F);
}

void Cylinder::add_bearing(const Sighting& sighting, MapPoint origin, float distance, float novelty,
                           const MeasurementNoise& noise) {
  const Vec2 normal = left_of(sighting.center);
  const float bound = normal.dot(sighting.lens_from(origin));
  const float direction = bearing_variance(sighting, noise);
  const float variance = edge_variance(direction, distance, noise);
  float weight = novelty / variance;
  if (estimate_.ok()) {
    const float residual = bound - normal.dot(estimate_.center);
    const float expected = variance + estimate_.covariance.position_along(normal);
    const float inlier = inlier_share(residual, std::sqrt(expected), 1.0F);
    agreement_ += kAgreementGain * (inlier - agreement_);
    weight *= inlier;
  }
  edges_.add_through_centre(normal, bound, weight);
  false_depth_ += weight * direction;
  if (edges_.information.xx + edges_.information.yy > kMaxInformation) scale_edges(0.5F);
}

void Cylinder::scale_edges(float factor) {
  edges_.scale(factor);
  false_depth_ *= factor;
}

void Cylinder::solve(const Vec2& lens, const Vec2& bearing, const MeasurementNoise& noise) {
  trend_.judge();
  estimate_ = solve(lens, noise);
  const bool in_front = bearing.dot(estimate_.center - lens) > 0;
  if (estimate_.ok() && !in_front) estimate_.refusal = CylinderRefusal::kImplausible;
}

NormalEquations Cylinder::edges_and_radius() const {
  const bool any = edges_.information.rr > 0 || only_bearings();
  if (known_radius_ > 0 && any) return with_radius(edges_, radius_prior(known_radius_));
  return only_bearings() ? with_radius(edges_, {kPointRadius, kPointRadius}) : edges_;
}

CylinderEstimate Cylinder::by_edges(const Vec2& lens) const { return solve_equations(edges_and_radius(), lens); }

CylinderEstimate Cylinder::solve(const Vec2& lens, const MeasurementNoise& noise) {
  const NormalEquations edges = edges_and_radius();
  const CylinderEstimate from_edges = solve_equations(edges, lens);
  const bool edges_know = this->edges_know(from_edges, lens);
  NormalEquations both = independent_rows();
  const bool rows_known = both.information.rr > 0;
  float farther = edges_know && rows_known ? farther_by(both, from_edges) : 0.0F;
  rows_beyond_edges_ = farther > kGateSigmas;
  if (!rows_known) return from_edges;
  if (trend_.verdict() == RowVerdict::kTooFar) {
    both = trend_line(noise);
    if (edges_know) farther = farther_by(both, from_edges);
  }
  if (from_edges.ok() && std::fabs(farther) > kGateSigmas) return from_edges;
  both.add(edges);
  CylinderEstimate estimate = solve_equations(both, lens);
  if (!seen_whole_ && views_ < kFewestViews) return estimate;
  if (!estimate.ok()) estimate = solve_with_typical_radius(both, lens, kRadiusSigma);
  if (!estimate.ok()) estimate = solve_with_typical_radius(both, lens, kRadiusGuess);
  return estimate;
}

bool Cylinder::rows_put_farther() const {
  const NormalEquations rows = independent_rows();
  const CylinderEstimate from_edges = by_edges({0, 0});  // only the refusal depends on the lens
  if (!(rows.information.rr > 0 && from_edges.covariance.xx > 0)) return false;
  return farther_by(rows, from_edges) > kGateSigmas;
}

NormalEquations Cylinder::trend_line(const MeasurementNoise& noise) const {
  NormalEquations line;
  const RowTrend::Front front = trend_.front();
  line.add(front.plane.normal, front.plane.bound, 1 / (front.variance + shape_variance(noise)));
  return line;
}

NormalEquations Cylinder::independent_rows() const {
  NormalEquations rows = rows_;
  if (row_count_ > kIndependentRows) rows.scale(kIndependentRows / row_count_);
  return rows;
}

bool Cylinder::edges_know(const CylinderEstimate& from_edges, const Vec2& lens) const {
  if (!(from_edges.covariance.xx > 0)) return false;
  const Vec2 away = from_edges.center - lens;
  const float variance = from_edges.covariance.position_along(away) / away.squared_norm();
  return variance * false_depth_ * kTrueDepth < 1.0F;
}

RangeBounds Cylinder::range_along(const Vec2& lens, const Vec2& bearing) const {
  const Symmetric3& m = edges_.information;
  const Vec2 row{m.xx * bearing.x() + m.xy * bearing.y(), m.xy * bearing.x() + m.yy * bearing.y()};
  // Noisy directions have parallax to themselves.
  const float known = row.dot(bearing) - false_depth_;
  if (!only_bearings() || !(known > 0)) return {};
  const float range = (bearing.dot(edges_.moment) - row.dot(lens)) / known;
  const float reach = kGateSigmas / std::sqrt(known);
  const RangeBounds bounds{std::max(kNearestObject, range - reach), range + reach};
  return bounds.least < bounds.most ? bounds : RangeBounds{};
}

void Cylinder::move_origin(const Vec2& shift) {
  edges_.move_origin(shift);
  rows_.move_origin(shift);
  trend_.move_origin(shift);
  estimate_.center -= shift;
}

void Cylinder::hash(base::Fnv1a64& hash) const {
  hash_equations(hash, edges_);
  hash_equations(hash, rows_);
  hash.f32(row_count_);
  trend_.hash(hash);
  hash.f32(agreement_);
  hash.f32(false_depth_);
  if (known_radius_ > 0) hash.f32(known_radius_);
  hash.u8(views_);
  hash.u8(static_cast<std::uint8_t>((seen_whole_ ? 1U : 0U) | (rows_beyond_edges_ ? 2U : 0U)));
  hash.u8(whole_views_);
  hash.u8(static_cast<std::uint8_t>(estimate_.refusal));
  if (!estimate_.ok()) return;
  hash_vec(hash, estimate_.center);
  hash.f32(estimate_.radius);
  hash_symmetric(hash, estimate_.covariance);
}

float prior_distance(const Sighting& sighting) {
  // sin of the half angle between the rays; a censored end makes the object look smaller, that is farther.
  const float sine = cross(sighting.right.direction, sighting.left.direction);
  const float half = std::max(0.5F * sine, 1e-3F);
  return std::clamp(radius_prior(sighting.known_radius).mean / half, kNearestObject, kRowMaxDepth);
}

}  // namespace fencepost::recon
