#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/geometry/rings.hpp"
#include "host/result/lookup.hpp"
#include "host/result/text.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

constexpr std::size_t kNameWidth = 10;      ///< at least
constexpr std::size_t kAreaWidth = 7;       ///< a longer name takes room from them
constexpr double kSquareCentimetres = 1e4;  ///< per m^2

std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string name_of(const ResultDocument& document, const ObjectResult& object) {
  return printable(signature_name(document, object.signature));
}

/// Names are whole: two that were cut would read alike.
std::size_t name_width(const ResultDocument& document) {
  std::size_t width = kNameWidth;
  for (const ObjectResult& object : document.objects) {
    const std::string name = name_of(document, object);
    const auto letters =
        std::ranges::count_if(name, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    width = std::max(width, static_cast<std::size_t>(letters));
  }
  return width;
}

/// The models whose area is shown: the most useful ones that the profile has. At most `areas`, and as many as `width`
/// letters of names leave room for.
std::vector<std::string> area_columns(const ResultDocument& document, std::size_t width, std::size_t areas) {
  const std::size_t taken = (width - kNameWidth + kAreaWidth - 1) / kAreaWidth;
  const std::size_t most = areas - std::min(areas, taken);
  const std::vector<std::string> present = model_names(document);
  std::vector<std::string> columns;
  for (const char* name : {"hybrid", "carve", "clip"}) {
    const bool has = std::find(present.begin(), present.end(), name) != present.end();
    if (has && columns.size() < most) columns.emplace_back(name);
  }
  return columns;
}

std::string area_cell(const ObjectResult& object, const std::string& model_name) {
  const ModelResult* model = find_model(object, model_name);
  if (model == nullptr || model->geometry.empty()) return "-";
  return number(area(model->geometry) * kSquareCentimetres, 0);
}

std::string object_row(const ResultDocument& document, const ObjectResult& object,
                       const std::vector<std::string>& areas, std::size_t width) {
  const Circle* circle = object_circle(object);
  std::string row =
      fmt::format("{:>3} {:<{}} {:<9} {:>5} {:>7} {:>7} {:>6} {:>6} {:>5}", object.id, name_of(document, object), width,
                  record::name(object.state), object.views, circle ? number(circle->center.x, 3) : "-",
                  circle ? number(circle->center.y, 3) : "-", circle ? number(circle->radius, 3) : "-",
                  number(object.z_max - object.z_min, 3), number(object.confidence, 2));
  for (const std::string& model : areas) row += fmt::format(" {:>6}", area_cell(object, model));
  return row + "\n";
}

}  // namespace

std::string object_table(const ResultDocument& document, const TextOptions& options) {
  if (document.objects.empty()) return "No objects: no blob was seen from enough places.\n";
  const std::size_t width = name_width(document);
  const std::vector<std::string> areas = area_columns(document, width, options.areas);
  std::string head = fmt::format("{:>3} {:<{}} {:<9} {:>5} {:>7} {:>7} {:>6} {:>6} {:>5}", "id", "name", width, "state",
                                 "views", "x", "y", "radius", "height", "conf");
  std::string units = fmt::format("{:>3} {:<{}} {:<9} {:>5} {:>7} {:>7} {:>6} {:>6} {:>5}", "", "", width, "", "", "m",
                                  "m", "m", "m", "");
  for (const std::string& model : areas) {
    head += fmt::format(" {:>6}", model);
    units += fmt::format(" {:>6}", "cm2");
  }
  std::string table = options.colour ? "\x1b[1m" + head + "\x1b[0m\n" : head + "\n";
  table += units + "\n";
  for (const ObjectResult& object : document.objects) table += object_row(document, object, areas, width);
  return table;
}

}  // namespace fencepost::host
