#include "host/report/map_objects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/label_space.hpp"
#include "host/report/markup.hpp"
#include "host/report/palette.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::px;

std::string ring_path(const MapFrame& f, const LinearRing& ring) {
  std::string d;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    d += fmt::format("{}{} {}", i == 0 ? "M" : "L", px(f.x(ring[i].x)), px(f.y(ring[i].y)));
  }
  return d.empty() ? d : d + "z";
}

std::string area_path(const MapFrame& f, const MultiPolygon& areas) {
  std::string d;
  for (const Polygon& polygon : areas) {
    d += ring_path(f, polygon.outer);
    for (const LinearRing& hole : polygon.holes) d += ring_path(f, hole);
  }
  return d;
}

std::string line_path(const MapFrame& f, const std::vector<Polyline>& lines) {
  std::string d;
  for (const Polyline& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      d += fmt::format("{}{} {}", i == 0 ? "M" : "L", px(f.x(line[i].x)), px(f.y(line[i].y)));
    }
  }
  return d;
}

Point middle(const LinearRing& ring) {
  Point sum;
  for (const Point& p : ring) sum = {sum.x + p.x, sum.y + p.y};
  const auto n = static_cast<double>(ring.size());
  return {sum.x / n, sum.y / n};
}

/// Bottom and top of a ring in the drawing, for labels that keep clear of it.
double lowest_y(const LinearRing& ring) {
  return std::min_element(ring.begin(), ring.end(), [](Point a, Point b) { return a.y < b.y; })->y;
}

const char* state_class(const ObjectResult& object) {
  switch (object.state) {
    case record::ObjectState::kTentative: return "is-tentative";
    case record::ObjectState::kConfirmed: return "is-confirmed";
    case record::ObjectState::kLost: return "is-lost";
  }
  return "is-tentative";
}

}  // namespace

std::string draw_truth(const MapFrame& f, const Scene& truth) {
  std::string svg = R"(<g class="layer-truth">)";
  for (const SceneObject& object : truth.objects) {
    if (object.footprint.outer.empty()) continue;
    const std::string name = escaped(object.name);
    svg += fmt::format(R"(<g><title>{}, true footprint</title><path class="footprint" d="{}"/>)", name,
                       area_path(f, {object.footprint}));
    svg += "</g>";
  }
  return svg + "</g>\n";
}

std::string draw_model(const MapFrame& f, const ResultDocument& document, const std::string& name) {
  const ModelStyle style = model_style(name);
  const std::string dash = style.dash.empty() ? "" : fmt::format(R"( stroke-dasharray="{}")", style.dash);
  std::string svg = fmt::format(R"(<g class="layer-{}" stroke-width="{}" fill-opacity="{}"{}>)", markup::slug(name),
                                px(style.width), px(style.fill_opacity), dash);
  for (const ObjectResult& object : document.objects) {
    const ModelResult* model = find_model(object, name);
    if (model == nullptr || model->geometry.empty()) continue;
    const sensor::Rgb colour = signature_colour(document, object.signature);
    svg += fmt::format(
        R"(<path class="{}" fill-rule="evenodd" fill="{}" stroke="{}" d="{}"><title>object {} {}, {}, {}</title></path>)",
        state_class(object), hex(colour), ink(colour, kLineLuminance), area_path(f, model->geometry), object.id,
        escaped(signature_name(document, object.signature)), escaped(name), record::name(object.state));
    if (model->open.empty()) continue;
    svg +=
        fmt::format(R"(<path class="open" d="{}"><title>object {}: no edge was seen here, it may go on</title></path>)",
                    line_path(f, model->open), object.id);
  }
  return svg + "</g>\n";
}

namespace {

std::string object_labels(const MapFrame& f, const ResultDocument& document, LabelSpace& space) {
  std::string svg;
  for (const ObjectResult& object : document.objects) {
    const std::optional<Point> at = object_position(object);
    if (!at || !f.shows(*at)) continue;
    const Circle* circle = object_circle(object);
    const double above = circle != nullptr ? circle->radius * f.scale : 0;
    const std::string text = fmt::format("{} {}", object.id, signature_name(document, object.signature));
    const double y = space.place(f.x(at->x), std::max(f.y(at->y) - above - 9, f.top + 16), text, -1);
    svg += fmt::format(R"(<text class="{}" x="{}" y="{}" style="fill:{}" text-anchor="middle">{}</text>)",
                       state_class(object), px(f.x(at->x)), px(y),
                       ink(signature_colour(document, object.signature), kTextLuminance), escaped(text));
  }
  return svg;
}

std::string truth_labels(const MapFrame& f, const Scene& truth, LabelSpace& space) {
  std::string svg;
  for (const SceneObject& object : truth.objects) {
    if (object.footprint.outer.empty()) continue;
    const double x = f.x(middle(object.footprint.outer).x);
    const double y = space.place(x, f.y(lowest_y(object.footprint.outer)) + 19, object.name, 1);
    svg += fmt::format(R"(<text class="layer-truth" x="{}" y="{}" text-anchor="middle">{}</text>)", px(x), px(y),
                       escaped(object.name));
  }
  return svg;
}

}  // namespace

std::string draw_labels(const MapFrame& f, const ResultDocument& document, const std::optional<Scene>& truth) {
  LabelSpace space;
  std::string svg = R"(<g class="labels">)" + object_labels(f, document, space);
  if (truth) svg += truth_labels(f, *truth, space);
  return svg + "</g>\n";
}

std::optional<Point> object_position(const ObjectResult& object) {
  if (const Circle* circle = object_circle(object)) return circle->center;
  for (const ModelResult& model : object.models) {
    if (!model.geometry.empty() && !model.geometry.front().outer.empty()) return middle(model.geometry.front().outer);
  }
  return std::nullopt;
}

}  // namespace fencepost::host
