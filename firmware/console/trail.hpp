// Where the robot was, in a few places: evenly spaced over the whole run, however long that is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/console/top_view.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::console {

/// When it is full every second place goes, and the others are spaced twice as far from then on.
class Trail {
 public:
  /// In kUnit, of the map.
  struct Place {
    std::int16_t x = 0;
    std::int16_t y = 0;
  };
  static constexpr std::int32_t kUnit = 40;  ///< mm, the finest row of a drawing; reaches +-1310 m
  static constexpr std::size_t kMost = 32;

  static constexpr MapMillimetres millimetres(Place place) { return {place.x * kUnit, place.y * kUnit}; }

  void clear() { *this = {}; }
  /// Where the robot is; nearer than the spacing to the last place, it is passed over.
  void push(MapMillimetres robot);
  [[nodiscard]] std::span<const Place> places() const { return places_.view(); }

 private:
  base::FixedVector<Place, kMost> places_;
  std::int32_t spacing_ = 2;  ///< kUnit
};

}  // namespace fencepost::console
