#include "firmware/view/figure.hpp"

#include <algorithm>

#include "firmware/view/palette.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::view {
namespace {

constexpr std::int32_t kSmallest = 3;  // pixels of radius: less is not seen

// All corners do not fit, but where many sides are short they are near each other: so many, evenly spread.
Polygon make_outline(const console::MapShape& shape, const Window& window) {
  const std::size_t sides = shape.outline.offsets.size();
  Polygon polygon;
  for (std::size_t i = 0; i < Polygon::kMost; ++i) {
    polygon.add(window.pixel_of(shape.place_of(shape.outline.corner(i * sides / Polygon::kMost))));
  }
  return polygon;
}

}  // namespace

void Figure::paint(Row& row) const {
  if (outline.empty()) {
    disc.paint(row);
    return;
  }
  outline.paint_inside(row, disc.colour);
  outline.paint_edges(row, static_cast<std::uint8_t>(disc.colour - kObjects + kOutlines));
}

Figure make_figure(const console::MapShape& shape, std::size_t slot, const Window& window) {
  console::MapExtent extent;
  shape.include_in(extent);
  const std::int32_t radius = std::max(std::max(extent.width(), extent.height()) / 2 / window.mm(), kSmallest);
  const Point center = window.pixel_of(shape.middle);
  Figure figure;
  figure.disc = {center, point_at(radius, 0).x, static_cast<std::uint8_t>(kObjects + slot)};
  if (shape.outlined() && radius > kSmallest) figure.outline = make_outline(shape, window);
  const Point corner = window.pixel_of({extent.high().x, extent.low().y});
  const std::int32_t right = std::max<std::int32_t>(corner.x - center.x, kSmallest);
  const std::int32_t up = std::max<std::int32_t>(center.y - corner.y, kSmallest);
  const char letter = console::letter_of(slot);
  figure.letter = {point_at(center.x + right + 3, center.y - up - 3), 1, kText, std::string_view(&letter, 1)};
  return figure;
}

Polygon make_robot(const recon::MapPose& pose, const Window& window) {
  struct Corner {
    float ahead, left;
  };
  constexpr Corner kArrow[] = {{8, 0}, {-5, 5}, {-5, -5}};  // pixels
  const base::SinCos heading = base::sincos_urad(pose.heading);
  const Point middle = window.pixel_of(console::millimetres(pose.position));
  const auto rounded = [](float value) { return static_cast<std::int32_t>(value < 0 ? value - 0.5F : value + 0.5F); };
  Polygon robot;
  for (const Corner& corner : kArrow) {
    const float x = heading.cos * corner.ahead - heading.sin * corner.left;
    const float y = heading.sin * corner.ahead + heading.cos * corner.left;
    robot.add(point_at(middle.x - rounded(y), middle.y - rounded(x)));
  }
  return robot;
}

}  // namespace fencepost::view
