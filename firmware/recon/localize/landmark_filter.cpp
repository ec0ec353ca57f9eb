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

// How a place moves with each radian of the heading's error.
Vec2 lever_of(const FilterView& filter, const MapPoint& place) { return left_of(offset_from(filter.origin, place)); }

/// An equation's derivatives: `normal` by the landmark's centre, its negative by the position, `radius` by the radius.
struct Jacobian {
  Vec2 normal{0, 0};  ///< map axes
  float radius = 1;
};

// Covariance of what is measured with the state that has this row; the radius left out.
template <class Row>
float along(const Jacobian& jacobian, std::size_t slot, Row&& row) {
  return jacobian.normal.x() * (row(x_of(slot)) - row(kX)) + jacobian.normal.y() * (row(y_of(slot)) - row(kY));
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
    for (const std::size_t i : {std::size_t{kX}, std::size_t{kY}, x_of(slot_), y_of(slot_)}) project_place(i);
    project_radius(slot_);
    return along(jacobian_, slot_, [&](std::size_t j) { return out_[j]; }) +
           jacobian_.radius * out_[covariance_.places() + slot_];
  }
  /// Computes the step of all other states.
  void others() const {
    project_place(kHeading);
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

/// The step of all states: `projected` times `gain`. A place moves by its own step, and turns about the origin with the
/// heading.
class Step {
 public:
  Step(const FilterView& filter, std::span<const float> projected, float gain)
      : filter_(filter), projected_(projected), gain_(gain) {}

  /// False if it would move any state by kFarthestStep or more: the equation is not trusted then.
  [[nodiscard]] bool is_plausible() const {
    const auto near = [](float step) { return std::fabs(step) < kFarthestStep; };
    const auto moves_near = [&](const Vec2& step) { return near(step.x()) && near(step.y()); };
    if (!near(turn()) || !moves_near(of_place(kX, filter_.at.pose.position))) return false;
    for (std::size_t l = 0; l < filter_.in_use; ++l) {
      const Landmark& landmark = filter_.landmarks[l];
      if (landmark.used() && !(moves_near(of_place(x_of(l), landmark.center)) && near(of_radius(l)))) return false;
    }
    return true;
  }
  void take() const {
    for (std::size_t l = 0; l < filter_.in_use; ++l) {
      Landmark& landmark = filter_.landmarks[l];
      if (!landmark.used()) continue;
      landmark.center = moved(landmark.center, of_place(x_of(l), landmark.center));
      landmark.radius = std::max(kPointRadius, landmark.radius + of_radius(l));
    }
    MapPose& pose = filter_.at.pose;
    pose.position = moved(pose.position, of_place(kX, pose.position));
    const float turned = turn() * kMicroradians;
    pose.heading += static_cast<std::int32_t>(turned < 0 ? turned - 0.5F : turned + 0.5F);
  }

 private:
  [[nodiscard]] float turn() const { return gain_ * projected_[kHeading]; }
  [[nodiscard]] Vec2 of_place(std::size_t x, const MapPoint& place) const {
    return gain_ * Vec2{projected_[x], projected_[x + 1]} + turn() * lever_of(filter_, place);
  }
  [[nodiscard]] float of_radius(std::size_t l) const {
    return gain_ * projected_[places_of(filter_.landmarks.size()) + l];
  }

  const FilterView& filter_;
  std::span<const float> projected_;
  float gain_;
};

// Adapts the drift factor: a step up the likelihood's gradient. A residual above the expected one raises it, one below
// lowers it. The step is weighted by the share that the driving since the last equation has in the innovation.
void compare(DriftGauge& gauge, const Vec2& normal, const Vec2& away, float squared, float innovation) {
  const float lever = left_of(normal).dot(away);
  const float driven = gauge.position * normal.squared_norm() + gauge.heading * lever * lever;
  const float share = std::min(1.0F, driven / innovation);
  gauge.surprise = squared < kMaxSurprise ? squared : kMaxSurprise;
  gauge.usual += kAgreementGain * (gauge.surprise - gauge.usual);
  gauge.factor = std::clamp(gauge.factor * (1 + kDriftGain * share * (gauge.surprise - 1)), 1.0F, kMaxDrift);
  gauge.position *= 1 - share;
  gauge.heading *= 1 - share;
}

// The heading has become uncertain by `variance` (rad^2) while all places stay where they are.
void doubt_heading(const FilterView& filter, float variance, std::span<float> lever) {
  const Covariance p(filter);
  const auto set = [&](std::size_t x, const Vec2& of_place) {
    lever[x] = -of_place.x();
    lever[x + 1] = -of_place.y();
  };
  set(kX, lever_of(filter, filter.at.pose.position));
  lever[kHeading] = 1;
  for (std::size_t l = 0; l < filter.in_use; ++l) {
    const Landmark& landmark = filter.landmarks[l];
    set(x_of(l), landmark.used() ? lever_of(filter, landmark.center) : Vec2{0, 0});
  }
  float* value = filter.covariance.data();
  for (std::size_t i = 0; i < p.places_in_use(); ++i) {
    const float part = variance * lever[i];
    for (std::size_t j = 0; j <= i; ++j) *value++ += part * lever[j];
  }
}

// Moves the origin to the robot. There each place's error is the one before plus `lever` times the heading's.
void move_origin(const FilterView& filter, std::span<float> heading) {
  const Covariance p(filter);
  const Vec2 lever = lever_of(filter, filter.at.pose.position);
  filter.origin = filter.at.pose.position;
  const auto for_each_place = [&](auto&& apply) {
    const auto both = [&](std::size_t x) {
      apply(x, lever.x());
      apply(x + 1, lever.y());
    };
    both(kX);
    for (std::size_t l = 0; l < filter.in_use; ++l) {
      if (filter.landmarks[l].used()) both(x_of(l));
    }
  };
  const std::size_t places = p.places_in_use();
  for (std::size_t i = 0; i < places; ++i) heading[i] = p.at(kHeading, i);
  for_each_place([&](std::size_t i, float part) { heading[i] += 0.5F * part * heading[kHeading]; });
  for_each_place([&](std::size_t i, float part) {
    for (std::size_t j = 0; j < places; ++j) p.at(i, j) += part * heading[j];
    p.at(i, i) += part * heading[i];
    for (std::size_t l = 0; l < filter.in_use; ++l) p.radius(l)[i] += part * p.radius(l)[kHeading];
  });
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
  filter.origin = filter.at.pose.position;
  filter.gauge = {};
}

void drive_to(const FilterView& filter, const MapPose& odometry, const DriftNoise& noise, std::span<float> scratch) {
  FilterPose& at = filter.at;
  if (odometry == at.odometry) return;
  const float distance = offset_from(at.odometry.position, odometry.position).norm();
  const auto turned = static_cast<float>(
      short_way(static_cast<std::int64_t>(odometry.heading) - static_cast<std::int64_t>(at.odometry.heading)));
  at.pose = corrected(at, odometry);
  at.odometry = odometry;
  const Covariance covariance(filter);
  DriftGauge& gauge = filter.gauge;
  const float position = gauge.factor * noise.position * noise.position * distance;
  const float heading = gauge.factor * (noise.heading * noise.heading * distance +
                                        noise.turning * noise.turning * std::fabs(turned) / kMicroradians);
  covariance.at(kX, kX) += position;
  covariance.at(kY, kY) += position;
  doubt_heading(filter, heading, scratch);
  if (offset_from(filter.origin, at.pose.position).squared_norm() > kFarthestStep * kFarthestStep) {
    move_origin(filter, scratch);
  }
  gauge.position += position;
  gauge.heading += heading;
}

void add_landmark(const FilterView& filter, std::size_t slot, const LandmarkGuess& guess) {
  forget_landmark(filter, slot);
  const Covariance p(filter);
  filter.landmarks[slot] = {moved(filter.at.pose.position, guess.away), guess.radius};
  // Its error is the pose's, and what it was seen with.
  const std::size_t x = x_of(slot);
  const std::size_t y = y_of(slot);
  for (std::size_t i = 0; i < p.places(); ++i) {
    if (i == x || i == y) continue;
    p.at(x, i) = p.at(kX, i);
    p.at(y, i) = p.at(kY, i);
  }
  for (std::size_t l = 0; l < filter.landmarks.size(); ++l) {
    const std::span<float> row = p.radius(l);
    row[x] = row[kX];
    row[y] = row[kY];
  }
  const Symmetric3& c = guess.covariance;
  p.at(x, x) = p.at(kX, kX) + c.xx;
  p.at(y, x) = p.at(kY, kX) + c.xy;
  p.at(y, y) = p.at(kY, kY) + c.yy;
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
                       std::span<float> scratch, float min_share) {
  const MapPose& pose = filter.at.pose;
  const Landmark& landmark = filter.landmarks[slot];
  const Vec2 map_R_robot = direction_of(pose.heading);
  const Vec2 normal = rotated(map_R_robot, seen.normal);
  const Vec2 away = offset_from(pose.position, landmark.center);
  const Jacobian jacobian{rotated(map_R_robot, seen.slope), seen.radii};
  const float residual = seen.bound - normal.dot(away) - seen.radii * landmark.radius;
  const Projection projection(filter, slot, jacobian, scratch);
  const float known = projection.own();
  float innovation = known + variance;
  if (!(innovation > 0.5F * variance) || !(innovation < kFarthestStep * kFarthestStep)) return TangentFate::kRefused;
  const float squared = residual * residual / innovation;
  compare(filter.gauge, jacobian.normal, away, squared, innovation);
  if (!(squared <= kFilterGateSigmas * kFilterGateSigmas)) return TangentFate::kGated;
  if (known < min_share * variance) return TangentFate::kKnown;
  projection.others();
  if (squared > kUsualSigmas * kUsualSigmas) innovation *= std::sqrt(squared) / kUsualSigmas;
  if (!stays_positive(filter, scratch, innovation)) return TangentFate::kRefused;
  const Step step(filter, scratch, residual / innovation);
  if (!step.is_plausible()) return TangentFate::kRefused;
  reduce(filter, scratch, innovation);
  step.take();
  return TangentFate::kUsed;
}

CylinderEstimate seen_from_robot(const FilterView& filter, std::size_t slot) {
  const Covariance p(filter);
  const Landmark& landmark = filter.landmarks[slot];
  CylinderEstimate seen;
  seen.center = offset_from(filter.at.pose.position, landmark.center);
  seen.radius = landmark.radius;
  // Both errors leave out the heading's turn: their difference is the error in the robot's frame.
  const auto x = [&](auto&& row) { return row(x_of(slot)) - row(kX); };
  const auto y = [&](auto&& row) { return row(y_of(slot)) - row(kY); };
  const auto of_x = [&](std::size_t i) { return x([&](std::size_t j) { return p.at(i, j); }); };
  const auto of_y = [&](std::size_t i) { return y([&](std::size_t j) { return p.at(i, j); }); };
  const std::span<const float> radius = p.radius(slot);
  const auto of_radius = [&](std::size_t i) { return radius[i]; };
  seen.covariance = {x(of_x), x(of_y), y(of_y), x(of_radius), y(of_radius), radius[p.places()]};
  seen.refusal = CylinderRefusal::kNone;
  return seen;
}

PoseSigma pose_sigma(std::span<const float> covariance, const Vec2& from_origin) {
  constexpr std::size_t kXx = 0, kYy = 2, kXHeading = 3, kYHeading = 4, kHeadingHeading = 5;
  const Vec2 lever = left_of(from_origin);
  const float with_heading = lever.x() * covariance[kXHeading] + lever.y() * covariance[kYHeading];
  const float heading = covariance[kHeadingHeading];
  const float sum = covariance[kXx] + covariance[kYy] + 2 * with_heading + lever.squared_norm() * heading;
  return {std::sqrt(std::max(0.0F, 0.5F * sum)), std::sqrt(heading)};
}

float distance_to(const FilterView& filter, const MapPose& other) {
  const Covariance p(filter);
  const MapPose& pose = filter.at.pose;
  const std::int64_t turned = short_way(static_cast<std::int64_t>(other.heading) - pose.heading);
  const float turn = static_cast<float>(turned) / kMicroradians;
  const Vec2 off = offset_from(filter.origin, other.position) -
                   rotated(direction_of(turned), offset_from(filter.origin, pose.position));
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
