#include "host/calibrate/odometry_track.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "host/simulate/trajectory.hpp"

namespace fencepost::host {
namespace {

constexpr double kHalfWindow = 0.125;  // s, of the smoothing: a robot's turning rate hardly changes within
constexpr double kRateSpan = 0.1;      // s
// Below these, samples are not smoothed: it is the resolution of wheels.
constexpr PoseNoise kQuiet = {0.0005, 0.001};
// A quadratic through some twelve samples keeps this share of their noise.
constexpr double kLeftAfterSmoothing = 0.45;

/// Sigma of the noise of single samples: their second difference has sqrt(6) times it.
double white_noise(std::span<const TimedPose> samples, double TimedPose::*member) {
  std::vector<double> differences;
  for (std::size_t i = 2; i < samples.size(); ++i) {
    differences.push_back(std::abs(samples[i].*member - 2 * samples[i - 1].*member + samples[i - 2].*member));
  }
  constexpr double kSigmaOfMedian = 1.4826;
  return kSigmaOfMedian * median_of(std::move(differences)) / std::sqrt(6.0);
}

/// The value at t of the quadratic that fits `member` best.
double quadratic_at(std::span<const TimedPose> samples, double t, double TimedPose::*member) {
  double s[5] = {};
  double b[3] = {};
  for (const TimedPose& sample : samples) {
    const double d = (sample.t - t) / kHalfWindow;
    double power = 1;
    for (int k = 0; k < 5; ++k) {
      s[k] += power;
      if (k < 3) b[k] += power * sample.*member;
      power *= d;
    }
  }
  // Cramer's rule for the constant term.
  const double c0 = s[2] * s[4] - s[3] * s[3];
  const double c1 = s[1] * s[4] - s[2] * s[3];
  const double c2 = s[1] * s[3] - s[2] * s[2];
  return (b[0] * c0 - b[1] * c1 + b[2] * c2) / (s[0] * c0 - s[1] * c1 + s[2] * c2);
}

}  // namespace

OdometryTrack::OdometryTrack(std::vector<TimedPose> samples) : samples_(continuous(std::move(samples))) {
  measure_noise();
  if (white_.position > kQuiet.position || white_.heading > kQuiet.heading) smooth();
  add_up();
}

void OdometryTrack::measure_noise() {
  white_.position = std::max(white_noise(samples_, &TimedPose::x), white_noise(samples_, &TimedPose::y));
  white_.heading = white_noise(samples_, &TimedPose::heading);
}

void OdometryTrack::smooth() {
  const std::vector<TimedPose> raw = samples_;
  std::size_t low = 0;
  std::size_t high = 0;
  for (TimedPose& sample : samples_) {
    while (raw[low].t < sample.t - kHalfWindow) ++low;
    while (high < raw.size() && raw[high].t <= sample.t + kHalfWindow) ++high;
    constexpr std::size_t kMin = 6;
    if (high - low < kMin) continue;
    const std::span<const TimedPose> window(&raw[low], high - low);
    const double t = sample.t;
    sample.x = quadratic_at(window, t, &TimedPose::x);
    sample.y = quadratic_at(window, t, &TimedPose::y);
    sample.heading = quadratic_at(window, t, &TimedPose::heading);
  }
  white_.position *= kLeftAfterSmoothing;
  white_.heading *= kLeftAfterSmoothing;
}

void OdometryTrack::add_up() {
  way_.push_back(0);
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    const TimedPose& a = samples_[i - 1];
    const TimedPose& b = samples_[i];
    const double middle = (a.heading + b.heading) / 2;
    const double step = (b.x - a.x) * std::cos(middle) + (b.y - a.y) * std::sin(middle);
    way_.push_back(way_.back() + step);
  }
  // In steps of a second, so that jitter does not count as driving.
  for (double t = begin(); t < end(); t += 1) {
    const TrackPose a = at(t);
    const TrackPose b = at(std::min(t + 1, end()));
    driven_ += std::abs(b.way - a.way);
    turned_ += std::abs(b.heading - a.heading);
  }
}

TrackPose OdometryTrack::at(double t) const {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), t,
                                      [](double time, const TimedPose& sample) { return time < sample.t; });
  if (after == samples_.begin()) return {samples_.front().x, samples_.front().y, samples_.front().heading, 0};
  const auto i = static_cast<std::size_t>(after - samples_.begin()) - 1;
  const TimedPose& a = samples_[i];
  if (i + 1 == samples_.size()) return {a.x, a.y, a.heading, way_[i]};
  const TimedPose& b = samples_[i + 1];
  const double share = (t - a.t) / (b.t - a.t);
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {between(a.x, b.x), between(a.y, b.y), between(a.heading, b.heading), between(way_[i], way_[i + 1])};
}

TrackPose OdometryTrack::rate(double t) const {
  const TrackPose a = at(t - kRateSpan / 2);
  const TrackPose b = at(t + kRateSpan / 2);
  return {(b.x - a.x) / kRateSpan, (b.y - a.y) / kRateSpan, (b.heading - a.heading) / kRateSpan,
          (b.way - a.way) / kRateSpan};
}

}  // namespace fencepost::host
