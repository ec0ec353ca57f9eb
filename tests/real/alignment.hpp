// How far a map and a path are off the survey, whatever frame they lie in.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::test {

struct Pair {
  host::Point found;
  host::Point truth;
};

struct Alignment {
  double turn = 0;   // of the truth against what was found, rad
  double scale = 1;  // likewise; the errors are those without it
  std::vector<double> errors;
};

// Least squares over a rotation and a shift.
inline Alignment align(const std::vector<Pair>& pairs) {
  host::Point a;
  host::Point b;
  const auto n = static_cast<double>(pairs.size());
  for (const Pair& p : pairs) {
    a = {a.x + p.found.x / n, a.y + p.found.y / n};
    b = {b.x + p.truth.x / n, b.y + p.truth.y / n};
  }
  double cosine = 0;
  double sine = 0;
  double size = 0;
  for (const Pair& p : pairs) {
    const double fx = p.found.x - a.x, fy = p.found.y - a.y, tx = p.truth.x - b.x, ty = p.truth.y - b.y;
    cosine += fx * tx + fy * ty;
    sine += fx * ty - fy * tx;
    size += fx * fx + fy * fy;
  }
  Alignment alignment;
  alignment.turn = std::atan2(sine, cosine);
  alignment.scale = std::hypot(cosine, sine) / size;
  const double c = std::cos(alignment.turn), s = std::sin(alignment.turn);
  for (const Pair& p : pairs) {
    const double fx = p.found.x - a.x, fy = p.found.y - a.y;
    alignment.errors.push_back(std::hypot(b.x + fx * c - fy * s - p.truth.x, b.y + fx * s + fy * c - p.truth.y));
  }
  std::sort(alignment.errors.begin(), alignment.errors.end());
  return alignment;
}

inline double rms(const std::vector<double>& errors) {
  double sum = 0;
  for (const double error : errors) sum += error * error;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

inline host::Point middle_of(const host::SceneObject& object) {
  host::Point sum;
  const auto n = static_cast<double>(object.footprint.outer.size());
  for (const host::Point& p : object.footprint.outer) sum = {sum.x + p.x / n, sum.y + p.y / n};
  return sum;
}

// Of the objects of a signature the one seen most often.
inline const host::ObjectResult* best_of(const host::ResultDocument& result, std::uint8_t signature) {
  const host::ObjectResult* best = nullptr;
  for (const host::ObjectResult& object : result.objects) {
    if (object.signature != signature || !object.models[0].circle) continue;
    if (best == nullptr || object.views > best->views) best = &object;
  }
  return best;
}

struct PathError {
  double mean = 0;     ///< m
  double worst = 0;    ///< m
  double heading = 0;  ///< rad, mean
  double shape = 0;    ///< m, rms after the rotation and shift that suit the path best
};

// Against the survey's poses, each path sample at the survey's nearest earlier one (100 Hz).
inline PathError path_error(const std::vector<host::PoseResult>& path, const std::vector<host::PoseResult>& survey) {
  PathError error;
  std::size_t at = 0;
  std::vector<Pair> pairs;
  for (const host::PoseResult& pose : path) {
    while (at + 1 < survey.size() && survey[at + 1].t <= pose.t) ++at;
    if (std::fabs(survey[at].t - pose.t) > 0.1) continue;
    const double off = std::hypot(pose.x - survey[at].x, pose.y - survey[at].y);
    error.mean += off;
    error.worst = std::max(error.worst, off);
    error.heading += std::fabs(std::remainder(pose.heading - survey[at].heading, 2 * std::numbers::pi));
    pairs.push_back({{pose.x, pose.y}, {survey[at].x, survey[at].y}});
  }
  if (pairs.empty()) return error;
  error.mean /= static_cast<double>(pairs.size());
  error.heading /= static_cast<double>(pairs.size());
  error.shape = rms(align(pairs).errors);
  return error;
}

}  // namespace fencepost::test
