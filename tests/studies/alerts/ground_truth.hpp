// The things truly in the way, how far and how soon: from footprints and the drive alone, no model of the robot's.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tests/studies/alerts/approach.hpp"

namespace fencepost::test {

/// The settings' defaults: host/share/doc/console.md.
struct AlertLimits {
  double stop = 0.25;        ///< m
  double warn = 0.50;        ///< m
  double notice = 1.00;      ///< m
  double ttc_stop = 0.8;     ///< s
  double half_width = 0.10;  ///< m, of the body
  double margin = 0.05;      ///< m
  int confirm_k = 3;
  int confirm_n = 5;
};

/// The distances of all blocks during one approach, sampled every 10 ms until one metre past its end.
class GroundTruth {
 public:
  GroundTruth(const Approach& approach, const AlertLimits& limits);

  /// From the robot's origin to the nearest point of the footprint, m.
  [[nodiscard]] double distance(std::size_t object, double t) const { return samples_[object][index(t)]; }
  /// Will the disc around the robot's origin, `half_width` in radius, touch it from t on?
  [[nodiscard]] bool swept(std::size_t object, double t, double half_width) const;
  /// Swept by the body and its margin: it is in the path.
  [[nodiscard]] bool in_path(std::size_t object, double t) const {
    return swept(object, t, limits_.half_width + limits_.margin);
  }
  /// When a block in the path comes within the stop distance; nothing if the run ends before, or begins there.
  [[nodiscard]] std::optional<double> stop_time(std::size_t object) const;
  /// A stop at t has a reason if something is in the path, widened by `grace` on either side. It has to be within 1.5
  /// times the stop distance, or 1.5 times as soon as alert.ttc_stop. Contact is when the body, half its width ahead of
  /// the origin, is there at the true speed.
  [[nodiscard]] bool stop_is_right(double t, double grace) const;
  [[nodiscard]] const AlertLimits& limits() const { return limits_; }

 private:
  [[nodiscard]] std::size_t index(double t) const;

  const Approach& approach_;
  AlertLimits limits_;
  std::vector<std::vector<double>> samples_;  ///< [object][time]
  std::vector<std::vector<double>> nearest_;  ///< the least of samples_ from then on
};

}  // namespace fencepost::test
