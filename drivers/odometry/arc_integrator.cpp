#include "drivers/odometry/arc_integrator.hpp"

#include <algorithm>

#include "drivers/odometry/wheel_base.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::odometry {
namespace {

// sin(h) / h. The series has an error below 3e-8 at its end; beyond, the division costs nothing.
double chord_by_arc(std::int64_t half_urad) {
  constexpr std::int64_t kOneRadian = 1'000'000;
  const double h = static_cast<double>(half_urad) * 1e-6;
  if (half_urad > kOneRadian || half_urad < -kOneRadian) {
    return static_cast<double>(base::sincos_urad(half_urad).sin) / h;
  }
  const double q = h * h;
  return 1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0)));
}

std::int64_t nearest(double value) { return static_cast<std::int64_t>(value + (value < 0 ? -0.5 : 0.5)); }

base::Metres to_metres(std::int64_t pm) {
  constexpr std::int64_t kPicometresPerUnit = 1'000 * kPicometresPerMillimetre / base::Metres::kPerUnit;
  constexpr std::int64_t kLimit = std::int64_t{200'000} * base::Metres::kPerUnit;
  return {static_cast<std::int32_t>(std::clamp(divide_nearest(pm, kPicometresPerUnit), -kLimit, kLimit))};
}

base::Radians wrapped(std::int64_t urad) {
  constexpr std::int64_t kPicoPerMicro = 1'000'000;
  const std::int64_t turns = divide_nearest(urad, base::kTwoPiPicoradians / kPicoPerMicro);
  const std::int64_t rest = urad - divide_nearest(turns * base::kTwoPiPicoradians, kPicoPerMicro);
  return {static_cast<std::int32_t>(divide_nearest(rest, kPicoPerMicro / base::Radians::kPerUnit))};
}

}  // namespace

void ArcIntegrator::advance(std::int64_t distance_pm, std::int64_t heading_urad) {
  const std::int64_t turned = heading_urad - heading_urad_;
  const double chord = static_cast<double>(distance_pm) * chord_by_arc(turned / 2);
  const base::SinCos middle = base::sincos_urad(heading_urad_ + turned / 2);
  x_pm_ += nearest(chord * static_cast<double>(middle.cos));
  y_pm_ += nearest(chord * static_cast<double>(middle.sin));
  heading_urad_ = heading_urad;
}

sensor::OdometrySample ArcIntegrator::sample(base::Time t) const {
  return {t, to_metres(x_pm_), to_metres(y_pm_), wrapped(heading_urad_)};
}

}  // namespace fencepost::odometry
