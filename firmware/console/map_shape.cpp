#include "firmware/console/map_shape.hpp"

#include <algorithm>

namespace fencepost::console {
namespace {

constexpr float kFarthestDrawn = 100.0F;  // m

std::int32_t whole_millimetres(float metres) {
  return static_cast<std::int32_t>(1000 * std::clamp(metres, -kFarthestDrawn, kFarthestDrawn));
}

}  // namespace

MapShape disc_of(const recon::ObjectCore& object) {
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  const MapMillimetres center = millimetres(recon::moved(object.origin, cylinder.center));
  return {center, static_cast<std::int32_t>(1000 * std::min(cylinder.radius, kFarthestDrawn)), {}};
}

MapMillimetres MapShape::place_of(const recon::Vec2& local) const {
  return {middle.x + whole_millimetres(local.x()), middle.y + whole_millimetres(local.y())};
}

void MapShape::include_in(MapExtent& extent) const {
  if (!outlined()) {
    extent.include(middle, radius);
    return;
  }
  const std::size_t quarter = outline.offsets.size() / 4;
  const auto reach = [&](std::size_t k) { return whole_millimetres(outline.offset(k * quarter)); };
  extent.include({middle.x + reach(0), middle.y + reach(1)}, 0);
  extent.include({middle.x - reach(2), middle.y - reach(3)}, 0);
}

void MapShape::draw(char letter, TopViewRow& row) const {
  if (!outlined()) {
    row.disc(middle, radius, letter);
    return;
  }
  row.point(middle, letter);
  const recon::Chord chord = outline.chord_at(0.001F * static_cast<float>(row.x() - middle.x));
  if (chord.empty()) return;
  row.bar(middle.y + whole_millimetres(chord.low), middle.y + whole_millimetres(chord.high), letter);
}

}  // namespace fencepost::console
