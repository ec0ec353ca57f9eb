#include "firmware/recon/localize/landmark_filter.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/localize/tuning.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

constexpr float kMicroradians = 1e6F;

/// The packed covariances by names of their rows.
class Covariance {
 public:
  explicit Covariance(const FilterView& filter)
      : values_(filter.covariance),
        places_(places_of(filter.landmarks.size())),
        places_in_use_(places_of(filter.in_use)) {}

  [[nodiscard]] std::size_t places() const { return places_; }
  [[nodiscard]] std::size_t places_in_use() const { return places_in_use_; }
  [[nodiscard]] float& at(std::size_t i, std::size_t j) const {
    return i >= j ? values_[i * (i + 1) / 2 + j] : values_[j * (j + 1) / 2 + i];
  }
  /// The row of the radius in `slot`: covariances with the places, then its variance.
  [[nodiscard]] std::span<float> radius(std::size_t slot) const {
    return values_.subspan(places_ * (places_ + 1) / 2 + slot * (places_ + 1), places_ + 1);
  }

 private:
  std::span<float> values_;
  std::size_t places_;
  std::size_t places_in_use_;
};

enum Place : std::size_t { kX, kY, kHeading };
std::size_t x_of(std::size_t slot) { return 3 + 2 * slot; }
std::size_t y_of(std::size_t slot) { return 4 + 2 * slot; }

Vec2 direction_of(std::int64_t microradians) {
  const base::SinCos direction = base::sincos_urad(microradians);
  return {direction.cos, direction.sin};
}

/// d(residual's prediction) / d(state): only these six are not zero.
struct Jacobian {
  Vec2 center{0, 0};  ///< the position's is its negative
  float heading = 0;
  float radius = 1;
};

// The Jacobian of an equation with this normal in map axes.
Jacobian jacobian_of(const Vec2& normal, const Vec2& away, float radii) {
  return {normal, left_of(normal).dot(away), radii};
}

// Covariance of what is measured with the state that has this row; the radius left out.
template <class Row>
float along(const Jacobian& jacobian, std::size_t slot, Row&& row) {
  return jacobian.center.x() * (row(x_of(slot)) - row(kX)) + jacobian.center.y() * (row(y_of(slot)) - row(kY)) +
         jacobian.heading * row(kHeading);
}

/// The step of an equation, as far as it is known: P J', by states.
class Projection {
 public:
  Projection(const FilterView& filter, std::size_t slot, const Jacobian& jacobian, std::span<float> out)
      : covariance_(filter),
        landmarks_(filter.in_use),
        slot_(slot),
        jacobian_(jacobian),
        own_(covariance_.radius(slot)),
        out_(out) {}

  /// Computes the step of the states in the equation and returns J P J'.
  [[nodiscard]] float own() const {
    for (const std::size_t i : {std::size_t{kX}, std::size_t{kY}, std::size_t{kHeading}, x_of(slot_), y_of(slot_)}) {
      project_place(i);
    }
    project_radius(slot_);
    return along(jacobian_, slot_, [&](std::size_t j) { return out_[j]; }) +
           jacobian_.radius * out_[covariance_.places() + slot_];
  }
  /// Computes the step of all other states.
  void others() const {
    for (std::size_t l = 0; l < landmarks_; ++l) {
      if (l == slot_) continue;
      project_place(x_of(l));
      project_place(y_of(l));
      project_radius(l);
    }
  }

 private:
  void project_place(std::size_t i) const {
    out_[i] = along(jacobian_, slot_, [&](std::size_t j) { return covariance_.at(i, j); }) + jacobian_.radius * own_[i];
  }
  void project_radius(std::size_t l) const {
    const std::span<const float> radius = covariance_.radius(l);
    float& part = out_[covariance_.places() + l];
    part = along(jacobian_, slot_, [&](std::size_t j) { return radius[j]; });
    if (l == slot_) part += jacobian_.radius * own_[covariance_.places()];
  }

  Covariance covariance_;
  std::size_t landmarks_;
  std::size_t slot_;
  Jacobian jacobian_;
  std::span<const float> own_;
  std::span<float> out_;
};

bool stays_positive(const FilterView& filter, std::span<const float> projected, float innovation) {
  const Covariance covariance(filter);
  const std::size_t places = covariance.places();
  const float inverse = 1.0F / innovation;
  for (std::size_t i = 0; i < covariance.places_in_use(); ++i) {
    const float variance = covariance.at(i, i);
    if (variance > 0 && !(variance - projected[i] * projected[i] * inverse > 0)) return false;
  }
  for (std::size_t l = 0; l < filter.in_use; ++l) {
    const float variance = covariance.radius(l)[places];
    const float part = projected[places + l];
    if (variance > 0 && !(variance - part * part * inverse > 0)) return false;
  }
  return true;
}

// P - p p' / S, plus what rounding may have taken from the variances.
void reduce(const FilterView& filter, std::span<const float> projected, float innovation) {
  const Covariance covariance(filter);
  const std::size_t places = covariance.places();
  const std::size_t in_use = covariance.places_in_use();
  const float inverse = 1.0F / innovation;
  float radii = 0;
  for (std::size_t l = 0; l < filter.in_use; ++l) radii += std::fabs(projected[places + l]);
  float* value = filter.covariance.data();
  for (std::size_t i = 0; i < in_use; ++i) {
    const float gain = projected[i] * inverse;
    const float rounding = kRounding * value[i];
    if (gain != 0) {
      for (std::size_t j = 0; j <= i; ++j) value[j] -= gain * projected[j];
    }
    value[i] += rounding;
    value += i + 1;
  }
  for (std::size_t l = 0; l < filter.in_use; ++l) {
    const float part = projected[places + l];
    const float gain = part * inverse;
    if (gain == 0) continue;
    value = covariance.radius(l).data();
    const float rounding = kRounding * value[places];
    for (std::size_t j = 0; j < in_use; ++j) value[j] -= gain * projected[j];
    // Its own share, and the covariances with other radii that are not kept.
    const float others = radii - std::fabs(part);
    value[places] += std::fabs(gain) * others - gain * part + rounding;
  }
}

// Moves all states by step[] = gain * residual.
void move_states(const FilterView& filter, std::span<const float> step) {
  MapPose& pose = filter.at.pose;
  pose.position = moved(pose.position, {step[kX], step[kY]});
  const float turn = step[kHeading] * kMicroradians;
  pose.heading += static_cast<std::int32_t>(turn < 0 ? turn - 0.5F : turn + 0.5F);
  const std::size_t places = places_of(filter.landmarks.size());
  for (std::size_t l = 0; l < filter.in_use; ++l) {
    Landmark& landmark = filter.landmarks[l];
    if (!landmark.used()) continue;
    landmark.center = moved(landmark.center, {step[x_of(l)], step[y_of(l)]});
    landmark.radius = std::max(kPointRadius, landmark.radius + step[places + l]);
  }
}

// False if the tangent would move any state by kFarthestStep or more: it is not trusted then.
bool is_plausible(std::span<const float> projected, float gain) {
  return std::all_of(projected.begin(), projected.end(),
                     [gain](float part) { return std::fabs(part * gain) < kFarthestStep; });
}

// Adapts the drift factor: a step up the likelihood's gradient. A residual above the expected one raises it, one below
// lowers it. The step is weighted by the share that the driving since the last equation has in the innovation.
void compare(DriftGauge& gauge, const Jacobian& jacobian, float squared, float innovation) {
  const float driven =
      gauge.position * jacobian.center.squared_norm() + gauge.heading * jacobian.heading * jacobian.heading;
  const float share = std::min(1.0F, driven / innovation);
  gauge.surprise = squared < kMaxSurprise ? squared : kMaxSurprise;
  gauge.usual += kAgreementGain * (gauge.surprise - gauge.usual);
  gauge.factor = std::clamp(gauge.factor * (1 + kDriftGain * share * (gauge.surprise - 1)), 1.0F, kMaxDrift);
  gauge.position *= 1 - share;
  gauge.heading *= 1 - share;
}

// The heading's error moves what comes after it sideways by `moved` turned left.
void shear(const FilterView& filter, const Vec2& driven) {
  const Covariance p(filter);
  const Vec2 lever = left_of(driven);
  const float turn = p.at(kHeading, kHeading);
  p.at(kX, kX) += lever.x() * (2 * p.at(kHeading, kX) + lever.x() * turn);
  p.at(kY, kX) += lever.x() * p.at(kHeading, kY) + lever.y() * (p.at(kHeading, kX) + lever.x() * turn);
  p.at(kY, kY) += lever.y() * (2 * p.at(kHeading, kY) + lever.y() * turn);
  p.at(kHeading, kX) += lever.x() * turn;
  p.at(kHeading, kY) += lever.y() * turn;
  const auto follow = [&](std::span<float> row) {
    row[kX] += lever.x() * row[kHeading];
    row[kY] += lever.y() * row[kHeading];
  };
  for (std::size_t i = kHeading + 1; i < p.places_in_use(); ++i) follow({&p.at(i, 0), 3});
  for (std::size_t l = 0; l < filter.in_use; ++l) follow(p.radius(l).first(3));
}

}  // namespace

MapPose corrected(const FilterPose& at, const MapPose& odometry) {
  if (at.pose == at.odometry) return odometry;
  const std::int32_t turn = at.pose.heading - at.odometry.heading;
  const Vec2 driven = rotated(direction_of(turn), offset_from(at.odometry.position, odometry.position));
  return {moved(at.pose.position, driven), odometry.heading + turn};
}

Vec2 turned(const Vec2& v, std::int32_t angle) { return rotated(direction_of(angle), v); }

void start(const FilterView& filter) {
  std::fill(filter.landmarks.begin(), filter.landmarks.end(), Landmark{});
  std::fill(filter.covariance.begin(), filter.covariance.end(), 0.0F);
  const Covariance covariance(filter);
  for (const std::size_t i : {kX, kY, kHeading}) covariance.at(i, i) = kStartVariance;
  filter.gauge = {};
}

void drive_to(const FilterView& filter, const MapPose& odometry, const DriftNoise& noise) {
  FilterPose& at = filter.at;
  if (odometry == at.odometry) return;
  const Vec2 driven = rotated(direction_of(at.pose.heading - at.odometry.heading),
                              offset_from(at.odometry.position, odometry.position));
  const auto turned = static_cast<float>(
      short_way(static_cast<std::int64_t>(odometry.heading) - static_cast<std::int64_t>(at.odometry.heading)));
  at.pose = corrected(at, odometry);
  at.odometry = odometry;
  shear(filter, driven);
  const Covariance covariance(filter);
  const float distance = driven.norm();
  DriftGauge& gauge = filter.gauge;
  const float position = gauge.factor * noise.position * noise.position * distance;
  const float heading = gauge.factor * (noise.heading * noise.heading * distance +
                                        noise.turning * noise.turning * std::fabs(turned) / kMicroradians);
  covariance.at(kX, kX) += position;
  covariance.at(kY, kY) += position;
  covariance.at(kHeading, kHeading) += heading;
  gauge.position += position;
  gauge.heading += heading;
}

void add_landmark(const FilterView& filter, std::size_t slot, const LandmarkGuess& guess) {
  forget_landmark(filter, slot);
  const Covariance p(filter);
  filter.landmarks[slot] = {moved(filter.at.pose.position, guess.away), guess.radius};
  // It goes where the pose goes, and turns with it.
  const Vec2 lever = left_of(guess.away);
  const std::size_t x = x_of(slot);
  const std::size_t y = y_of(slot);
  const auto inherit = [&](float along_x, float along_y, float heading, float& own_x, float& own_y) {
    own_x = along_x + lever.x() * heading;
    own_y = along_y + lever.y() * heading;
  };
  for (std::size_t i = 0; i < p.places(); ++i) {
    if (i == x || i == y) continue;
    inherit(p.at(kX, i), p.at(kY, i), p.at(kHeading, i), p.at(x, i), p.at(y, i));
  }
  for (std::size_t l = 0; l < filter.landmarks.size(); ++l) {
    const std::span<float> row = p.radius(l);
    inherit(row[kX], row[kY], row[kHeading], row[x], row[y]);
  }
  // And is as uncertain as it was seen.
  const Symmetric3& c = guess.covariance;
  p.at(x, x) = p.at(x, kX) + lever.x() * p.at(x, kHeading) + c.xx;
  p.at(y, x) = p.at(x, kY) + lever.y() * p.at(x, kHeading) + c.xy;
  p.at(y, y) = p.at(y, kY) + lever.y() * p.at(y, kHeading) + c.yy;
  const std::span<float> radius = p.radius(slot);
  radius[x] = c.xr;
  radius[y] = c.yr;
  radius[p.places()] = c.rr;
}

void forget_landmark(const FilterView& filter, std::size_t slot) {
  filter.landmarks[slot] = {};  // of other states the covariances are those of the others alone: nothing to do
  const Covariance covariance(filter);
  for (const std::size_t gone : {x_of(slot), y_of(slot)}) {
    for (std::size_t i = 0; i < covariance.places(); ++i) covariance.at(gone, i) = 0;
    for (std::size_t l = 0; l < filter.landmarks.size(); ++l) covariance.radius(l)[gone] = 0;
  }
  const std::span<float> radius = covariance.radius(slot);
  std::fill(radius.begin(), radius.end(), 0.0F);
}

TangentFate correct_by(const FilterView& filter, std::size_t slot, const CircleEquation& seen, float variance,
                       std::span<float> step, float min_share) {
  const MapPose& pose = filter.at.pose;
  const Landmark& landmark = filter.landmarks[slot];
  const Vec2 map_R_robot = direction_of(pose.heading);
  const Vec2 normal = rotated(map_R_robot, seen.normal);
  const Vec2 away = offset_from(pose.position, landmark.center);
  const Jacobian jacobian = jacobian_of(rotated(map_R_robot, seen.slope), away, seen.radii);
  const float residual = seen.bound - normal.dot(away) - seen.radii * landmark.radius;
  const Projection projection(filter, slot, jacobian, step);
  const float known = projection.own();
  float innovation = known + variance;
  if (!(innovation > 0.5F * variance) || !(innovation < kFarthestStep * kFarthestStep)) return TangentFate::kRefused;
  const float squared = residual * residual / innovation;
  compare(filter.gauge, jacobian, squared, innovation);
  if (!(squared <= kFilterGateSigmas * kFilterGateSigmas)) return TangentFate::kGated;
  if (known < min_share * variance) return TangentFate::kKnown;
  projection.others();
  if (squared > kUsualSigmas * kUsualSigmas) innovation *= std::sqrt(squared) / kUsualSigmas;
  if (!stays_positive(filter, step, innovation)) return TangentFate::kRefused;
  const float gain = residual / innovation;
  const std::span<float> places = step.first(places_of(filter.in_use));
  const std::span<float> radii = step.subspan(places_of(filter.landmarks.size()), filter.in_use);
  if (!is_plausible(places, gain) || !is_plausible(radii, gain)) return TangentFate::kRefused;
  reduce(filter, step, innovation);
  for (float& part : places) part *= gain;
  for (float& part : radii) part *= gain;
  move_states(filter, step);
  return TangentFate::kUsed;
}

CylinderEstimate seen_from_robot(const FilterView& filter, std::size_t slot) {
  const Covariance p(filter);
  const Landmark& landmark = filter.landmarks[slot];
  CylinderEstimate seen;
  seen.center = offset_from(filter.at.pose.position, landmark.center);
  seen.radius = landmark.radius;
  // In the robot's frame a turn of the heading moves the centre the other way.
  const Vec2 lever = -left_of(seen.center);
  const auto x = [&](auto&& row) { return row(x_of(slot)) - row(kX) + lever.x() * row(kHeading); };
  const auto y = [&](auto&& row) { return row(y_of(slot)) - row(kY) + lever.y() * row(kHeading); };
  const auto of_x = [&](std::size_t i) { return x([&](std::size_t j) { return p.at(i, j); }); };
  const auto of_y = [&](std::size_t i) { return y([&](std::size_t j) { return p.at(i, j); }); };
  const std::span<const float> radius = p.radius(slot);
  const auto of_radius = [&](std::size_t i) { return radius[i]; };
  seen.covariance = {x(of_x), x(of_y), y(of_y), x(of_radius), y(of_radius), radius[p.places()]};
  seen.refusal = CylinderRefusal::kNone;
  return seen;
}

PoseSigma pose_sigma(std::span<const float> covariance) {
  constexpr std::size_t kXx = 0;
  constexpr std::size_t kYy = 2;
  constexpr std::size_t kHeadingHeading = 5;
  return {std::sqrt(0.5F * (covariance[kXx] + covariance[kYy])), std::sqrt(covariance[kHeadingHeading])};
}

float distance_to(const FilterView& filter, const MapPose& other) {
  const Covariance p(filter);
  const MapPose& pose = filter.at.pose;
  const Vec2 off = offset_from(pose.position, other.position);
  const float turn =
      static_cast<float>(short_way(static_cast<std::int64_t>(other.heading) - pose.heading)) / kMicroradians;
  // Three equations in turn; each has the correlation with the ones before removed (a Cholesky factorisation).
  const float xx = p.at(kX, kX), xy = p.at(kY, kX), xh = p.at(kHeading, kX);
  if (!(xx > 0)) return 0;
  const float y = off.y() - xy / xx * off.x();
  const float h = turn - xh / xx * off.x();
  const float yy = p.at(kY, kY) - xy * xy / xx;
  const float yh = p.at(kHeading, kY) - xy * xh / xx;
  if (!(yy > 0)) return 0;
  const float h2 = h - yh / yy * y;
  const float hh = p.at(kHeading, kHeading) - xh * xh / xx - yh * yh / yy;
  if (!(hh > 0)) return 0;
  return off.x() * off.x() / xx + y * y / yy + h2 * h2 / hh;
}

}  // namespace fencepost::recon
