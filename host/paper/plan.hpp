// Top views as SVG: true footprints, models, lenses.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/polygon.hpp"
#include "host/metrics/perimeter.hpp"

namespace fencepost::host {

struct PlanArea {
  MultiPolygon geometry;
  std::string fill = "none";
  std::string stroke = "none";
  std::string dash;
  double fill_opacity = 1;
  double width = 1.6;  ///< px
};

struct PlanPart {
  PerimeterPart part;  ///< of `outline`
  LinearRing outline;
  std::string colour;
  double width = 5;
};

struct PlanLens {
  Point at;
  double heading = 0;  ///< rad
  std::string colour;
};

/// A square of `side` metres around `centre`, x to the right, y up.
struct Plan {
  std::string title;
  Point centre;
  double side = 0.6;
  std::vector<PlanArea> areas;  ///< in order of drawing
  std::vector<PlanPart> parts;
  std::vector<PlanLens> lenses;
};

/// With a scale bar; needs no stylesheet.
std::string draw_plan(const Plan& plan);

}  // namespace fencepost::host
