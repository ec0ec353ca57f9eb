#include "host/render/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "host/geometry/rings.hpp"

namespace fencepost::host {
namespace {

/// Vertices are drawn to 1/16 px.
constexpr int kSubpixelBits = 4;
/// Farther outside, vertices are cut to this: OpenCV counts in 32 bits.
constexpr double kFarthestPixel = 1e5;

cv::Mat canvas_of(Picture& picture) { return {picture.height, picture.width, CV_8UC3, picture.rgb.data()}; }

cv::Scalar paint(sensor::Rgb colour, double light) {
  return {std::round(colour.red * light), std::round(colour.green * light), std::round(colour.blue * light)};
}

std::vector<cv::Point> fixed_points(const LinearRing& ring) {
  std::vector<cv::Point> points;
  const auto fixed = [](double v) {
    return static_cast<int>(std::lround(std::clamp(v, -kFarthestPixel, kFarthestPixel) * (1 << kSubpixelBits)));
  };
  for (const Point& p : ring) points.emplace_back(fixed(p.x), fixed(p.y));
  return points;
}

void fill(cv::Mat& canvas, const Face& face, const cv::Scalar& colour, int line) {
  std::vector<std::vector<cv::Point>> rings;
  for (const LinearRing& ring : face.rings) rings.push_back(fixed_points(ring));
  cv::fillPoly(canvas, rings, colour, line, kSubpixelBits);
}

double distance_of(const Solid& solid, const CameraPose& lens) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Polygon& polygon : solid.footprint) {
    if (!polygon.outer.empty()) nearest = std::min(nearest, distance_to_outline({lens.x, lens.y}, polygon.outer));
  }
  return nearest;
}

/// Row of the horizon: floor below, wall above, each a little brighter towards the viewer.
void draw_room(cv::Mat& canvas, const Projection& projection) {
  const double horizon = projection.cy - projection.fy * std::tan(projection.pitch);
  for (int v = 0; v < canvas.rows; ++v) {
    const double below = v - horizon;
    const double share = std::clamp(std::abs(below) / canvas.rows, 0.0, 1.0);
    const double grey = below > 0 ? 196 - 34 * share : 222 + 16 * share;
    canvas.row(v).setTo(cv::Scalar(grey, grey, below > 0 ? grey - 6 : grey + 2));
  }
}

}  // namespace

Projection PictureView::projection() const {
  return {lens,
          pitch,
          camera.fx.to_double() * scale,
          camera.fy.to_double() * scale,
          enlarged(camera.cx.to_double()),
          enlarged(camera.cy.to_double())};
}

Picture draw_picture(std::span<const Solid> solids, const PictureView& view, PictureStyle style) {
  Picture picture{view.camera.width * view.scale, view.camera.height * view.scale, {}};
  picture.rgb.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 255);
  cv::Mat canvas = canvas_of(picture);
  const Projection projection = view.projection();
  const bool shaded = style == PictureStyle::kShaded;
  if (shaded) draw_room(canvas, projection);
  std::vector<const Solid*> order;
  for (const Solid& solid : solids) {
    if (!encloses(solid, view.lens.x, view.lens.y, view.lens.z)) order.push_back(&solid);
  }
  std::stable_sort(order.begin(), order.end(), [&](const Solid* a, const Solid* b) {
    return distance_of(*a, view.lens) > distance_of(*b, view.lens);
  });
  for (const Solid* solid : order) {
    for (const Face& face : visible_faces(*solid, projection)) {
      fill(canvas, face, paint(solid->colour, shaded ? face.light : 1), shaded ? cv::LINE_AA : cv::LINE_8);
    }
  }
  return picture;
}

void draw_box(Picture& picture, const PictureView& view, const Region& region, sensor::Rgb colour, bool dashed) {
  cv::Mat canvas = canvas_of(picture);
  const auto place = [&](double u, double v) {
    return cv::Point(static_cast<int>(std::lround(view.enlarged(u))), static_cast<int>(std::lround(view.enlarged(v))));
  };
  const cv::Point low = place(region.left, region.top);
  const cv::Point high = place(region.right, region.bottom);
  const std::array<cv::Point, 5> corners{low, {high.x, low.y}, high, {low.x, high.y}, low};
  const int thickness = std::max(1, view.scale / 2 + 1);
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point from = corners[i];
    const cv::Point step = corners[i + 1] - from;
    const int length = std::max(std::abs(step.x), std::abs(step.y));
    const int dash = dashed ? 8 : std::max(length, 1);
    for (int at = 0; at < length; at += 2 * dash) {
      const int to = std::min(at + dash, length);
      cv::line(canvas, from + step * at / length, from + step * to / length, paint(colour, 1), thickness);
    }
  }
}

}  // namespace fencepost::host
