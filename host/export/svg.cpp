#include <fmt/format.h>

#include "host/export/drawing.hpp"
#include "host/report/markup.hpp"
#include "host/report/palette.hpp"

namespace fencepost::host::exports {
namespace {

using markup::escaped;
using markup::px;

std::string path_data(const Shape& shape) {
  std::string d;
  for (const std::vector<Point>& line : shape.lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      d += fmt::format("{}{} {}", i == 0 ? "M" : "L", px(line[i].x), px(line[i].y));
    }
    if (shape.closed) d += "z";
  }
  return d;
}

std::string element(const Shape& shape) {
  const bool filled = shape.closed && shape.fill_opacity > 0;
  std::string svg = fmt::format(R"(<path d="{}" fill="{}")", path_data(shape), filled ? hex(shape.fill) : "none");
  if (filled && shape.fill_opacity < 1) svg += fmt::format(R"( fill-opacity="{}")", px(shape.fill_opacity));
  if (filled && shape.lines.size() > 1) svg += R"( fill-rule="evenodd")";
  if (shape.width > 0) {
    svg += fmt::format(R"( stroke="{}" stroke-width="{}" stroke-linejoin="round")", hex(shape.stroke), px(shape.width));
  }
  if (shape.dashed) svg += R"( stroke-dasharray="4 3")";
  return shape.title.empty() ? svg + "/>\n" : svg + fmt::format("><title>{}</title></path>\n", escaped(shape.title));
}

std::string element(const Label& label) {
  const char* anchor = label.anchor == Align::kStart ? "start" : label.anchor == Align::kEnd ? "end" : "middle";
  return fmt::format(R"(<text x="{}" y="{}" text-anchor="{}" font-size="{}" fill="{}">{}</text>)", px(label.at.x),
                     px(label.at.y), anchor, px(label.size), hex(label.colour), escaped(label.text)) +
         "\n";
}

}  // namespace

std::string svg_of(const Drawing& drawing, const std::string& title) {
  std::string svg =
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
                  R"(font-family="system-ui, sans-serif" role="img">)",
                  px(drawing.width), px(drawing.height));
  svg += fmt::format("\n<title>{}</title>\n", escaped(title));
  for (const auto& part : drawing.parts) {
    svg += std::visit([](const auto& known) { return element(known); }, part);
  }
  return R"(<?xml version="1.0" encoding="UTF-8"?>)"
         "\n" +
         svg + "</svg>\n";
}

}  // namespace fencepost::host::exports
