#include "host/paper/figure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/render/png.hpp"
#include "host/report/markup.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

PlanArea true_area(const SceneObject& object) { return {{object.footprint}, "#f2d024", "#8a7400", {}, 0.85, 1.2}; }

PlanArea model_area(const MultiPolygon& geometry, const Algorithm& algorithm) {
  return {geometry, std::string(algorithm.colour), std::string(algorithm.colour), std::string(algorithm.dash), 0.10, 2};
}

}  // namespace

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

void PaperFigure::say(const std::string& key, bool holds, const std::string& text, const std::string& otherwise) {
  claims.push_back({holds ? ClaimKind::kMatches : ClaimKind::kDiffers, key,
                    holds ? text : "Not here: " + text + otherwise, true, 0, 0});
}

void PaperFigure::compare(const std::string& key, bool better, const std::string& text) {
  claims.push_back({better ? ClaimKind::kBeyond : ClaimKind::kWorse, key, text, true, 0, 0});
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

std::string percent(double share, int decimals) {
  return std::isfinite(share) ? markup::figure(100 * share, decimals) + " %" : "\u2013";
}

std::string landmark_name(std::size_t landmark) { return landmark == kRedLandmark ? "red" : "yellow"; }

double axis_end(const PaperData& data) { return static_cast<double>(data.shown.tour.frames.size() + 1); }

std::string scenes_text(const PaperData& data, std::size_t scenes) {
  return data.run.empty() ? plural(scenes, "scene") : std::string("this run");
}

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

std::string shown_empty(const PaperData& data) {
  std::string text;
  for (std::size_t a = 0; a < data.shown.scores.size(); ++a) {
    for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
      if (!data.shown.scores[a][landmark].back().empty) continue;
      text += fmt::format("{}{} by {}", text.empty() ? " Empty, so that nothing is rendered: " : ", ",
                          landmark_name(landmark), markup::escaped(algorithms()[a].label));
    }
  }
  return text.empty() ? text : text + ".";
}

std::vector<PlanLens> first_lenses(const Tour& tour, std::size_t images) {
  std::vector<PlanLens> lenses;
  for (std::size_t f = 0; f < images; ++f) {
    const CameraPose lens = lens_at(tour.scene.camera, tour.frames[f].pose);
    lenses.push_back({{lens.x, lens.y}, lens.heading, "#3b4a5c"});
  }
  return lenses;
}

Plan model_plan(const SequenceData& data, std::size_t landmark, std::size_t images, double side) {
  const SceneObject& object = data.tour.scene.objects[landmark];
  Plan plan{
      fmt::format("{}, {} images", landmark_name(landmark), images), centroid(object.footprint), side, {}, {}, {}};
  plan.areas.push_back(true_area(object));
  for (const Algorithm& algorithm : algorithms()) {
    const MultiPolygon geometry = model_geometry(data, algorithm, landmark, data.snapshot(images));
    plan.areas.push_back(model_area(geometry, algorithm));
  }
  plan.lenses = first_lenses(data.tour, images);
  return plan;
}

}  // namespace fencepost::host
