#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/export/drawing.hpp"
#include "host/render/png.hpp"

namespace fencepost::host::exports {
namespace {

constexpr int kShift = 4;  ///< bits of a pixel's fraction in OpenCV's coordinates

class Canvas {
 public:
  Canvas(const Drawing& drawing, double scale)
      : scale_(scale),
        image_(static_cast<int>(std::ceil(drawing.height * scale)), static_cast<int>(std::ceil(drawing.width * scale)),
               CV_8UC3, cv::Scalar(255, 255, 255)) {}

  void paint(const Shape& shape) {
    std::vector<std::vector<cv::Point>> lines;
    for (const std::vector<Point>& line : shape.lines) {
      std::vector<cv::Point>& points = lines.emplace_back();
      for (const Point& p : line) points.push_back(fine(p));
    }
    if (shape.closed && shape.fill_opacity > 0) fill(lines, shape);
    if (shape.width <= 0) return;
    const int width = std::max(1, static_cast<int>(std::lround(shape.width * scale_)));
    if (shape.dashed) return dash(shape, width);
    cv::polylines(image_, lines, shape.closed, colour(shape.stroke), width, cv::LINE_AA, kShift);
  }

  void paint(const Label& label) {
    constexpr double kLetterHeight = 22;  // px, of Hershey's letters at scale 1
    std::string text = label.text;
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '?';
    }
    const double size = 0.72 * label.size * scale_ / kLetterHeight;
    const int width = std::max(1, static_cast<int>(std::lround(scale_)));
    int base = 0;
    const cv::Size box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, width, &base);
    const double left = label.anchor == Align::kStart ? 0 : label.anchor == Align::kEnd ? box.width : box.width / 2.0;
    const cv::Point at(static_cast<int>(std::lround(label.at.x * scale_ - left)),
                       static_cast<int>(std::lround(label.at.y * scale_)));
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour(label.colour), width, cv::LINE_AA);
  }

  [[nodiscard]] Picture picture() const {
    Picture picture{image_.cols, image_.rows, {}};
    picture.rgb.assign(image_.data, image_.data + image_.total() * image_.elemSize());
    return picture;
  }

 private:
  static cv::Scalar colour(sensor::Rgb rgb) { return {double(rgb.red), double(rgb.green), double(rgb.blue)}; }
  [[nodiscard]] cv::Point fine(Point p) const {
    constexpr double kFine = 1 << kShift;
    return {static_cast<int>(std::lround(p.x * scale_ * kFine)), static_cast<int>(std::lround(p.y * scale_ * kFine))};
  }

  void fill(const std::vector<std::vector<cv::Point>>& lines, const Shape& shape) {
    if (shape.fill_opacity >= 1) {
      cv::fillPoly(image_, lines, colour(shape.fill), cv::LINE_AA, kShift);
      return;
    }
    cv::Mat covered = image_.clone();
    cv::fillPoly(covered, lines, colour(shape.fill), cv::LINE_AA, kShift);
    cv::addWeighted(covered, shape.fill_opacity, image_, 1 - shape.fill_opacity, 0, image_);
  }

  void dash(const Shape& shape, int width) {
    constexpr double kDash = 4;
    constexpr double kPeriod = 7;  // px
    for (const std::vector<Point>& line : shape.lines) {
      double along = 0;
      for (std::size_t i = 0; i + (shape.closed ? 0 : 1) < line.size(); ++i) {
        const Point a = line[i];
        const Point b = line[(i + 1) % line.size()];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        for (double at = 0; at < length;) {
          const double phase = std::fmod(along + at, kPeriod);
          const double next = std::min(length, at + (phase < kDash ? kDash - phase : kPeriod - phase) + 1e-9);
          if (phase < kDash) {
            const auto on = [&](double s) {
              return fine({a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)});
            };
            cv::line(image_, on(at), on(next), colour(shape.stroke), width, cv::LINE_AA, kShift);
          }
          at = next;
        }
        along += length;
      }
    }
  }

  double scale_;
  cv::Mat image_;  ///< red, green, blue
};

}  // namespace

std::string png_of(const Drawing& drawing, double scale) {
  Canvas canvas(drawing, scale);
  for (const auto& part : drawing.parts) {
    std::visit([&](const auto& known) { canvas.paint(known); }, part);
  }
  return png(canvas.picture());
}

}  // namespace fencepost::host::exports
