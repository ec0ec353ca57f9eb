// From map metres to the drawing's pixels: x to the right, y up, the same scale both ways.
#pragma once

#include <optional>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

struct MapFrame {
  // The plot's rectangle inside the drawing, px.
  double left = 58;
  double top = 14;
  double width = 886;
  double height = 560;
  // The part of the map that it shows, m.
  Point centre;
  double scale = 100;  ///< px/m

  [[nodiscard]] double x(double metres) const { return left + width / 2 + (metres - centre.x) * scale; }
  [[nodiscard]] double y(double metres) const { return top + height / 2 - (metres - centre.y) * scale; }
  [[nodiscard]] double x_min() const { return centre.x - width / 2 / scale; }
  [[nodiscard]] double x_max() const { return centre.x + width / 2 / scale; }
  [[nodiscard]] double y_min() const { return centre.y - height / 2 / scale; }
  [[nodiscard]] double y_max() const { return centre.y + height / 2 / scale; }
  [[nodiscard]] bool shows(Point p) const {
    return p.x >= x_min() && p.x <= x_max() && p.y >= y_min() && p.y <= y_max();
  }
};

/// Fits the path, the truth and the confirmed objects; tentative objects may fall outside.
MapFrame fit_map(const ResultDocument& document, const std::optional<Scene>& truth);

}  // namespace fencepost::host
