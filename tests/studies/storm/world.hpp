// Laps one after the other, and the devices that see and do them.
#pragma once

#include <vector>

#include "tests/studies/storm/far_end.hpp"
#include "tests/studies/storm/laps.hpp"

namespace fencepost::test {

class World {
 public:
  /// `order`: which lap comes next is drawn by it. Time begins at 0; the devices stand until `begin`.
  World(std::vector<Lap> laps, std::uint64_t order, base::Time begin);

  void add(FarEnd& device) { devices_.push_back(&device); }
  /// Everything that is due by `now`, each at its own time.
  void advance(base::Time now);

 private:
  [[nodiscard]] base::Time when(base::Time of_feed) const;
  [[nodiscard]] emulate::Travel travel_at(base::Time now) const;
  void next_lap();
  bool dispatch_next(base::Time now);

  std::vector<Lap> laps_;
  Chance order_;
  std::vector<FarEnd*> devices_;
  std::size_t lap_ = 0;
  base::Time lap_begun_;
  std::size_t frame_ = 0;
  std::size_t pose_ = 0;
  emulate::Travel before_;  ///< the laps that were driven
};

}  // namespace fencepost::test
