#include "host/export/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/label_space.hpp"
#include "host/report/map_frame.hpp"
#include "host/report/palette.hpp"
#include "host/report/ticks.hpp"

namespace fencepost::host::exports {
namespace {

constexpr double kRight = 16;    ///< px beside the plot
constexpr double kBottom = 40;   ///< px under it: labels of the axis
constexpr double kMinGrid = 52;  ///< px between lines
constexpr sensor::Rgb kPaper{0xFF, 0xFF, 0xFF};
constexpr sensor::Rgb kRule{0xDD, 0xE2, 0xE8};
constexpr sensor::Rgb kInk{0x33, 0x3B, 0x45};
constexpr sensor::Rgb kTrack{0x1F, 0x5F, 0xA8};

/// Only the outlines that are drawn: the view fits these.
ResultDocument with_one_model(const ResultDocument& document, const std::string& model) {
  ResultDocument shown = document;
  for (ObjectResult& object : shown.objects) {
    const ModelResult* outline = outline_of(object, model);
    object.models = outline != nullptr ? std::vector<ModelResult>{*outline} : std::vector<ModelResult>{};
  }
  return shown;
}

sensor::Rgb from_hex(const std::string& hex) {
  const auto channel = [&](std::size_t at) {
    return static_cast<std::uint8_t>(std::stoi(hex.substr(at, 2), nullptr, 16));
  };
  return {channel(1), channel(3), channel(5)};
}

class Painter {
 public:
  Painter(const ResultDocument& document, MapFrame frame) : document_(document), f_(frame) {
    drawing_.width = f_.left + f_.width + kRight;
    drawing_.height = f_.top + f_.height + kBottom;
  }

  Drawing paint() {
    Shape paper;
    paper.closed = true;
    paper.width = 0;
    paper.fill = kPaper;
    paper.fill_opacity = 1;
    paper.lines = {{{0, 0}, {drawing_.width, 0}, {drawing_.width, drawing_.height}, {0, drawing_.height}}};
    drawing_.parts.emplace_back(paper);
    grid();
    for (const ObjectResult& object : document_.objects) outline(object);
    path();
    guard();
    for (const ObjectResult& object : document_.objects) name(object);
    return std::move(drawing_);
  }

 private:
  [[nodiscard]] Point at(Point p) const { return {f_.x(p.x), f_.y(p.y)}; }
  void line(Point a, Point b, sensor::Rgb colour, double width) {
    Shape shape;
    shape.lines = {{a, b}};
    shape.stroke = colour;
    shape.width = width;
    drawing_.parts.emplace_back(shape);
  }
  void label(Point where, std::string text, sensor::Rgb colour, Align align) {
    drawing_.parts.emplace_back(Label{where, std::move(text), colour, align});
  }

  void grid() {
    const double step = nice_step(kMinGrid / f_.scale);
    const int decimals = step_decimals(step);
    const double bottom = f_.top + f_.height;
    for (const double x : ticks(f_.x_min(), f_.x_max(), step)) {
      line({f_.x(x), f_.top}, {f_.x(x), bottom}, kRule, x == 0 ? 2 : 1);
      label({f_.x(x), bottom + 18}, fmt::format("{:.{}f}", x + 0.0, decimals), kInk, Align::kMiddle);
    }
    for (const double y : ticks(f_.y_min(), f_.y_max(), step)) {
      line({f_.left, f_.y(y)}, {f_.left + f_.width, f_.y(y)}, kRule, y == 0 ? 2 : 1);
      label({f_.left - 7, f_.y(y) + 4.5}, fmt::format("{:.{}f}", y + 0.0, decimals), kInk, Align::kEnd);
    }
    label({f_.left + f_.width, bottom + 34}, "m; x to the right, y up", kInk, Align::kEnd);
  }

  /// The object's first model; nothing if it reaches out of the picture, as tentative objects may.
  [[nodiscard]] const ModelResult* shown(const ObjectResult& object) const {
    if (object.models.empty()) return nullptr;
    for (const Polygon& polygon : object.models.front().geometry) {
      if (!std::ranges::all_of(polygon.outer, [this](Point p) { return f_.shows(p); })) return nullptr;
    }
    return &object.models.front();
  }

  void outline(const ObjectResult& object) {
    const ModelResult* model = shown(object);
    if (model == nullptr) return;
    const sensor::Rgb colour = signature_colour(document_, object.signature);
    Shape shape;
    shape.closed = true;
    shape.stroke = from_hex(ink(colour, kLineLuminance));
    shape.width = 2;
    shape.fill = colour;
    shape.fill_opacity = is_solid(object) ? 0.35 : 0.12;
    shape.dashed = !is_solid(object);
    shape.title =
        fmt::format("object {}, {}, {}", title_of(document_, object), model->name, record::name(object.state));
    for (const Polygon& polygon : model->geometry) {
      add_ring(shape, polygon.outer);
      for (const LinearRing& hole : polygon.holes) add_ring(shape, hole);
    }
    drawing_.parts.emplace_back(shape);
  }
  void add_ring(Shape& shape, const LinearRing& ring) {
    std::vector<Point>& points = shape.lines.emplace_back();
    for (const Point& p : ring) points.push_back(at(p));
  }

  void name(const ObjectResult& object) {
    const ModelResult* model = shown(object);
    if (model == nullptr) return;
    double top = HUGE_VAL;
    double bottom = -HUGE_VAL;
    double left = HUGE_VAL;
    double right = -HUGE_VAL;
    for (const Polygon& polygon : model->geometry) {
      for (const Point& p : polygon.outer) {
        top = std::min(top, f_.y(p.y));
        bottom = std::max(bottom, f_.y(p.y));
        left = std::min(left, f_.x(p.x));
        right = std::max(right, f_.x(p.x));
      }
    }
    std::string text = title_of(document_, object);
    const double x = (left + right) / 2;
    const Point named{x, (top + bottom) / 2};
    const Point best{x, std::max(top - 7, f_.top + 14)};
    std::optional<LabelSpace::Placed> placed = space_.place(best, named, text, -1);
    if (!placed) {
      text = std::to_string(object.id);
      placed = space_.place(best, named, text, -1);
    }
    const sensor::Rgb colour = from_hex(ink(signature_colour(document_, object.signature), kTextLuminance));
    if (placed && placed->from) line(named, *placed->from, colour, 1);
    label(placed ? placed->at : best, text, colour, Align::kMiddle);
  }

  void guard() {
    for (const GuardPoint& point : document_.guard) {
      if (!f_.shows({point.x, point.y})) continue;
      const Point p = at({point.x, point.y});
      line({p.x - 3, p.y - 3}, {p.x + 3, p.y + 3}, kInk, 1.5);
      line({p.x - 3, p.y + 3}, {p.x + 3, p.y - 3}, kInk, 1.5);
    }
  }

  void path() {
    constexpr double kFinest = 0.7;  // px
    if (document_.path.empty()) return;
    Shape track;
    track.stroke = kTrack;
    track.width = 1.6;
    track.title = "the robot's path";
    std::vector<Point>& points = track.lines.emplace_back();
    for (const PoseResult& pose : document_.path) {
      const Point p = at({pose.x, pose.y});
      if (points.empty() || std::hypot(p.x - points.back().x, p.y - points.back().y) >= kFinest) points.push_back(p);
    }
    drawing_.parts.emplace_back(track);
    arrow(document_.path.back());
  }
  void arrow(const PoseResult& pose) {
    const double c = std::cos(pose.heading);
    const double s = std::sin(pose.heading);
    const Point centre = at({pose.x, pose.y});
    Shape shape;
    shape.closed = true;
    shape.stroke = shape.fill = kTrack;
    shape.fill_opacity = 1;
    std::vector<Point>& points = shape.lines.emplace_back();
    for (const Point p : {Point{13, 0}, Point{-8, 8}, Point{-4, 0}, Point{-8, -8}}) {
      points.push_back({centre.x + c * p.x - s * p.y, centre.y - s * p.x - c * p.y});
    }
    shape.title = fmt::format("the robot at the end, {:.1f} s", pose.t);
    drawing_.parts.emplace_back(shape);
  }

  const ResultDocument& document_;
  MapFrame f_;
  Drawing drawing_;
  LabelSpace space_{{f_.left, f_.top, f_.left + f_.width, f_.top + f_.height}};
};

}  // namespace

Drawing draw_run(const Run& run, const std::string& model) {
  const ResultDocument shown = with_one_model(run.document, model);
  return Painter(shown, fit_map(shown, std::nullopt)).paint();
}

}  // namespace fencepost::host::exports
