// Which objects the robot has driven past, and on which side.
#pragma once

#include <map>
#include <vector>

#include "host/result/result.hpp"

namespace fencepost::host {

/// An object that was confirmed ahead and is now behind the robot's origin, at most kWidest to its side, was passed. It
/// need not be seen then: the map remembers it. Further on it may be passed again.
class PassWatch {
 public:
  /// Where an object is from the robot, now: x forward, y left, m; `radius` of its cylinder.
  void look(double t, std::uint32_t id, std::uint8_t signature, Point relative, double radius);

  [[nodiscard]] const std::vector<PassResult>& passes() const { return passes_; }
  /// No further pass is noted.
  [[nodiscard]] bool full() const { return passes_.size() == kMax; }

  /// Forgets objects ahead that the map has no more, once there are more of them than the map holds.
  template <class InMap>
  void forget_lost(std::size_t map_size, InMap in_map) {
    if (ahead_.size() > map_size) std::erase_if(ahead_, [&](const auto& known) { return !in_map(known.first); });
  }

  static constexpr std::size_t kMax = 1U << 16U;  ///< 5 MB

  static constexpr double kWidest = 0.8;  ///< m, to its nearest point: the lane of an arena is 1 m wide
  static constexpr double kAhead = 0.05;  ///< m, it counts as ahead from there on, and as passed from as far behind
  static constexpr double kFarthest = 3;  ///< m, first known no farther off than that

 private:
  std::map<std::uint32_t, PassResult> ahead_;  ///< by id: objects ahead, with the data of their first sight
  std::vector<PassResult> passes_;
};

}  // namespace fencepost::host
