#include "host/report/map_objects.hpp"

#include <fmt/format.h>

#include <algorithm>

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

constexpr double kWidest = 420;     ///< px, of a name on the map; the tables have it whole
constexpr double kTruthReach = 60;  ///< px: a true name further away would only be in the way

/// A label, and the line that leads to it if it had to go far.
std::string label(const LabelSpace::Placed& placed, Point named, const std::string& attributes,
                  const std::string& text) {
  std::string svg;
  if (placed.from) {
    svg += fmt::format(R"(<path class="leader" d="M{} {}L{} {}"/>)", px(named.x), px(named.y), px(placed.from->x),
                       px(placed.from->y));
  }
  return svg + fmt::format(R"(<text {} x="{}" y="{}" text-anchor="middle">{}</text>)", attributes, px(placed.at.x),
                           px(placed.at.y), escaped(text));
}

std::string object_labels(const MapFrame& f, const ResultDocument& document, LabelSpace& space) {
  std::string svg;
  for (const ObjectResult& object : document.objects) {
    const std::optional<Point> at = object_position(object);
    if (!at || !f.shows(*at)) continue;
    const Circle* circle = object_circle(object);
    const double above = circle != nullptr ? circle->radius * f.scale : 0;
    std::string text = fmt::format("{} {}", object.id, signature_name(document, object.signature));
    const Point named{f.x(at->x), f.y(at->y)};
    const Point best{named.x, std::max(named.y - above - 9, f.top + 16)};
    auto placed = space.place(best, named, text, -1);
    if (!placed) {
      text = std::to_string(object.id);
      placed = space.place(best, named, text, -1);
    }
    svg += label(placed.value_or(LabelSpace::Placed{best, std::nullopt}), named,
                 fmt::format(R"(class="{}" style="fill:{}")", state_class(object),
                             ink(signature_colour(document, object.signature), kTextLuminance)),
                 text);
  }
  return svg;
}

std::string truth_labels(const MapFrame& f, const Scene& truth, LabelSpace& space) {
  ShortNames names(kWidest);
  std::string svg;
  for (const SceneObject& object : truth.objects) {
    if (object.footprint.outer.empty()) continue;
    const Point centre = middle(object.footprint.outer);
    const Point named{f.x(centre.x), f.y(centre.y)};
    const std::string text = names.shortened(object.name);
    const Point best{named.x, f.y(lowest_y(object.footprint.outer)) + 19};
    const auto placed = space.place(best, named, text, 1, kTruthReach);
    if (placed) svg += label(*placed, named, R"(class="layer-truth")", text);
  }
  return svg;
}

}  // namespace

std::string draw_labels(const MapFrame& f, const ResultDocument& document, const std::optional<Scene>& truth,
                        LabelSpace& space) {
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
