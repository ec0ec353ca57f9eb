#include "host/paper/figure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/render/png.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {

void PaperFigure::add_svg(const std::string& name, const std::string& svg, std::string_view css_class) {
  html += fmt::format("<div class=\"{}\">{}</div>\n", css_class, svg);
  files.push_back({name, svg_file(svg)});
}

void PaperFigure::add_picture(const std::string& name, const Picture& picture, const std::string& caption) {
  html += fmt::format(
      "<figure class=\"picture\"><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"\"/><figcaption>{}</figcaption>"
      "</figure>\n",
      name, picture.width, picture.height, caption);
  files.push_back({name, png(picture)});
}

void PaperFigure::say(bool holds, const std::string& text, const std::string& otherwise) {
  claims.push_back({holds ? ClaimKind::kMatches : ClaimKind::kDiffers, holds ? text : text + otherwise});
}

void Csv::row(const std::vector<std::string>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) text_ += ',';
    if (fields[i].find_first_of(",\"\n") == std::string::npos) {
      text_ += fields[i];
      continue;
    }
    text_ += '"';
    for (const char c : fields[i]) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
    text_ += '"';
  }
  text_ += '\n';
}

std::string csv_number(double value, int decimals) {
  if (!std::isfinite(value)) return {};
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

std::string percent(double share, int decimals) { return markup::figure(100 * share, decimals) + " %"; }

std::string landmark_name(std::size_t landmark) { return landmark == kRedLandmark ? "red" : "yellow"; }

std::size_t frame_with_both(const Tour& tour, std::size_t from) {
  const std::size_t count = tour.images.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t frame = (from + i) % count;
    if (is_whole_in(tour.images[frame], kRedLandmark) && is_whole_in(tour.images[frame], kYellowLandmark)) return frame;
  }
  return from;
}

MultiPolygon model_geometry(const SequenceData& data, const Algorithm& algorithm, std::size_t landmark,
                            std::size_t snapshot) {
  for (const ModelResult& model : data.models.of(algorithm, landmark).snapshots[snapshot].models) {
    if (model.name == algorithm.model) return model.geometry;
  }
  return {};
}

}  // namespace fencepost::host
