// The shape of an object from above, for every drawing of the map.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/console/top_view.hpp"
#include "firmware/recon/track/object.hpp"

namespace fencepost::console {

inline MapMillimetres millimetres(recon::MapPoint place) {
  constexpr std::int32_t kPerMillimetre = recon::kMapUnitsPerMetre / 1000;
  return {place.x / kPerMillimetre, place.y / kPerMillimetre};
}

/// Only what has a cylinder is drawn.
inline bool drawn(const recon::ObjectCore& object) { return object.used() && object.cylinder.estimate().ok(); }

/// An outline where that is known well, else the cylinder as a disc. Borrows from the object.
struct MapShape {
  MapMillimetres middle;
  std::int32_t radius = 0;       ///< mm, of the disc
  recon::OutlineView outline{};  ///< around `middle`

  [[nodiscard]] bool outlined() const { return !outline.offsets.empty(); }
  /// The place in the map of a point in the outline's frame.
  [[nodiscard]] MapMillimetres place_of(const recon::Vec2& local) const;
  /// Grows `extent` around it.
  void include_in(MapExtent& extent) const;
  /// The part of it that lies in this row.
  void draw(char letter, TopViewRow& row) const;
};

/// The cylinder's, which is known.
MapShape disc_of(const recon::ObjectCore& object);

/// Nothing if the object is not drawn.
template <class Profile>
std::optional<MapShape> shape_of(const recon::Object<Profile>& object) {
  if (!drawn(object)) return std::nullopt;
  if (!object.hybrid().ok() || !object.hybrid().outline().known_well()) return disc_of(object);
  return MapShape{millimetres(object.hybrid().origin), 0, object.hybrid().outline()};
}

}  // namespace fencepost::console
