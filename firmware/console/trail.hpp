// The robot's trail in a few places, evenly spaced over the whole run, however long that is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/console/top_view.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::console {

/// In kUnit, of the map.
struct TrailPlace {
  static constexpr std::int32_t kUnit = 40;  ///< mm, the finest row of a drawing; reaches +-1310 m

  std::int16_t x = 0;
  std::int16_t y = 0;

  static TrailPlace of(MapMillimetres place);
  [[nodiscard]] constexpr MapMillimetres millimetres() const { return {x * kUnit, y * kUnit}; }
};

/// True if they are at least `spacing` apart, in kUnit, along one axis.
bool apart(TrailPlace a, TrailPlace b, std::int32_t spacing);

/// When it is full every second place goes, and the others are spaced twice as far from then on. Even `kMax`.
template <std::size_t kMax>
class Trail {
 public:
  void clear() { *this = {}; }
  /// Adds the robot's place, unless it is nearer than the spacing to the last one.
  void push(MapMillimetres robot) {
    const TrailPlace place = TrailPlace::of(robot);
    if (!places_.empty() && !apart(place, places_[places_.size() - 1], spacing_)) return;
    if (places_.size() == kMax) {
      base::FixedVector<TrailPlace, kMax> kept;
      for (std::size_t i = 0; i < kMax; i += 2) static_cast<void>(kept.push_back(places_[i]));
      places_ = kept;
      if (spacing_ < INT16_MAX / 2) spacing_ *= 2;
    }
    static_cast<void>(places_.push_back(place));
  }
  [[nodiscard]] std::span<const TrailPlace> places() const { return places_.view(); }

 private:
  base::FixedVector<TrailPlace, kMax> places_;
  std::int32_t spacing_ = 2;  ///< kUnit
};

}  // namespace fencepost::console
