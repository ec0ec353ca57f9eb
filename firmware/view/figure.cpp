#include "firmware/view/figure.hpp"

#include <algorithm>

#include "firmware/app/map_listing.hpp"
#include "firmware/view/palette.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::view {
namespace {

constexpr std::int32_t kSmallest = 3;  // pixels of radius: less is not seen

app::MapMillimetres place_of(const recon::ObjectCore& object, const recon::Vec2& local) {
  return app::millimetres(recon::moved(object.origin, local));
}

// Of more corners than fit, every n-th.
Polygon make_outline(const recon::ObjectCore& object, std::span<const recon::Vec2> corners, const Window& window) {
  Polygon polygon;
  const std::size_t every = (corners.size() + Polygon::kMost - 1) / Polygon::kMost;
  for (std::size_t i = 0; i < corners.size(); i += every) {
    polygon.add(window.pixel_of(place_of(object, corners[i])));
  }
  return polygon;
}

}  // namespace

Figure make_figure(const recon::ObjectCore& object, std::span<const recon::Vec2> outline, std::size_t slot,
                   const Window& window) {
  Figure figure;
  const Point center = window.pixel_of(app::center_of(object));
  const std::int32_t radius = std::max(app::radius_of(object) / window.mm(), kSmallest);
  figure.disc.center = center;
  figure.disc.radius = point_at(radius, 0).x;
  figure.disc.colour = static_cast<std::uint8_t>(kObjects + slot);
  if (object.placed()) figure.outline = make_outline(object, outline, window);
  const char letter = app::letter_of(slot);
  figure.letter = {point_at(center.x + radius + 3, center.y - radius - 3), 1, kText, std::string_view(&letter, 1)};
  return figure;
}

Polygon make_robot(const recon::MapPose& pose, const Window& window) {
  struct Corner {
    float ahead, left;
  };
  constexpr Corner kArrow[] = {{8, 0}, {-5, 5}, {-5, -5}};  // pixels
  const base::SinCos heading = base::sincos_urad(pose.heading);
  const Point middle = window.pixel_of(app::millimetres(pose.position));
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
