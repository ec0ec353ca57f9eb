#include "firmware/view/figure.hpp"

#include <algorithm>
#include <array>

#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/view/palette.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::view {
namespace {

constexpr std::int32_t kSmallest = 3;  // pixels of radius: less is not seen

// The corners of the polygon that all sides of an outline enclose. A side beyond the corner of its neighbours has none.
class Corners {
 public:
  explicit Corners(const recon::OutlineView& outline) : outline_(outline) {
    for (std::size_t k = 0; k < outline.offsets.size(); ++k) {
      trim(k);
      sides_[end_++] = static_cast<std::uint8_t>(k);
    }
    while (size() > 2 && beyond(sides_[begin_], meet(end_ - 2))) --end_;
  }

  [[nodiscard]] std::size_t size() const { return end_ - begin_; }
  [[nodiscard]] recon::Vec2 at(std::size_t i) const { return meet(begin_ + i); }

 private:
  static constexpr float kTouches = 1e-4F;  // m

  // Removes the sides of which the next side leaves no edge.
  void trim(std::size_t next) {
    while (size() > 1 && beyond(next, meet(end_ - 2))) --end_;
    while (size() > 1 && beyond(next, meet(begin_))) ++begin_;
  }
  [[nodiscard]] bool beyond(std::size_t side, const recon::Vec2& point) const {
    return recon::node_direction(side, outline_.offsets.size()).dot(point) > outline_.offset(side) + kTouches;
  }
  // The corner between the side at this place and the next one.
  [[nodiscard]] recon::Vec2 meet(std::size_t place) const {
    const std::size_t nodes = outline_.offsets.size();
    const std::size_t first = sides_[place];
    const std::size_t second = sides_[place + 1 == end_ ? begin_ : place + 1];
    const recon::Vec2 turn = recon::node_direction((second + nodes - first) % nodes, nodes);
    const recon::Vec2 normal = recon::node_direction(first, nodes);
    const float reach = outline_.offset(first);
    const float along = turn.y() > 0 ? (outline_.offset(second) - turn.x() * reach) / turn.y() : 0.0F;
    return reach * normal + along * recon::left_of(normal);
  }

  recon::OutlineView outline_;
  std::array<std::uint8_t, recon::kDirections> sides_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

// If all corners do not fit, evenly spread ones are kept: many short sides have their corners near each other.
Polygon make_outline(const console::MapShape& shape, const Window& window) {
  const Corners corners(shape.outline);
  const std::size_t most = std::min(corners.size(), Polygon::kMax);
  Polygon polygon;
  for (std::size_t i = 0; i < most; ++i) {
    polygon.add(window.pixel_of(shape.place_of(corners.at(i * corners.size() / most))));
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
