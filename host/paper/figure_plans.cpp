// Figures 5 and 12b: top views.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/paper/figure.hpp"
#include "host/paper/figure_curves.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;

std::string score_table(const SequenceData& data, std::size_t images) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th>model</th>";
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    html += fmt::format("<th class=\"n\">R, {0}</th><th class=\"n\">P, {0}</th>", landmark_name(landmark));
  }
  html += "</tr></thead><tbody>\n";
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    html += fmt::format("<tr><td>{}</td>", escaped(algorithms()[a].label));
    for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
      const Score& score = data.score(a, landmark, images);
      html += fmt::format("<td class=\"n\">{}</td><td class=\"n\">{}</td>", figure(score.recklessness, 2),
                          score.empty ? "\u2013" : figure(score.paranoia, 2));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// The first image behind the `images` of the set that shows about as much new as known.
std::size_t half_new_image(const SequenceData& shown, const ViewSet& set, std::size_t images) {
  std::size_t next = images;
  double nearest = 2;
  for (std::size_t f = images; f < shown.tour.frames.size(); ++f) {
    const auto novelty = set.novelty(shown.shown[kYellowLandmark][f]);
    if (novelty && std::abs(*novelty - 0.5) < nearest) {
      nearest = std::abs(*novelty - 0.5);
      next = f;
    }
  }
  return std::min(next, shown.tour.frames.size() - 1);
}

/// Draws the part of the yellow landmark that the set has seen, and the part that image `next` shows.
void draw_perimeters(PaperFigure& fig, const SequenceData& shown, const ViewSet& set, std::size_t images,
                     std::size_t next) {
  const LinearRing& outline = shown.tour.scene.objects[kYellowLandmark].footprint.outer;
  Plan plan{fmt::format("{} images and one more", images), centroid({outline, {}}), 2.2, {}, {}, {}};
  plan.lenses = first_lenses(shown.tour, images);
  const CameraPose lens = lens_at(shown.tour.scene.camera, shown.tour.frames[next].pose);
  plan.lenses.push_back({{lens.x, lens.y}, lens.heading, "#d98200"});
  plan.areas.push_back({{{outline, {}}}, "#f2d024", "none", {}, 0.6, 0});
  plan.parts = {{set.seen(), outline, "#3b4a5c", 6}, {shown.shown[kYellowLandmark][next], outline, "#d98200", 2.5}};
  Plan close = plan;
  close.title = "the object from near";
  close.side = 0.3;
  fig.add("<div class=\"plans\">");
  fig.add_svg("fig12b_plan.svg", draw_plan(plan), "plan");
  fig.add_svg("fig12b_close.svg", draw_plan(close), "plan");
  fig.add("</div>");
}

/// Both measures of both landmarks over the sequence.
void chart_perimeters(PaperFigure& fig, const PaperData& data) {
  const SequenceData& shown = data.shown;
  Csv csv("image,landmark,thoroughness,novelty");
  fig.add("<div class=\"charts\">");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    Chart chart{fmt::format("The {} landmark", landmark_name(landmark)),
                "image",
                "share of the perimeter",
                0,
                axis_end(data),
                0,
                1,
                {}};
    ChartSeries thorough{"thoroughness so far", "#3b4a5c", {}, {}, true, false, 1};
    ChartSeries novel{"novelty of the image", "#d98200", {}, {}, true, false, 1};
    for (std::size_t f = 0; f < shown.tour.frames.size(); ++f) {
      const auto& value = shown.novelty[landmark][f];
      thorough.points.push_back({static_cast<double>(f + 1), shown.thoroughness[landmark][f]});
      novel.points.push_back({static_cast<double>(f + 1), value.value_or(std::nan(""))});
      csv.row({std::to_string(f + 1), landmark_name(landmark), csv_number(shown.thoroughness[landmark][f]),
               value ? csv_number(*value) : ""});
    }
    chart.series = {thorough, novel};
    fig.add_svg(fmt::format("fig12b_{}.svg", landmark_name(landmark)), draw_chart(chart), "chart");
  }
  fig.add("</div>");
  fig.add_file("fig12b.csv", csv.text());
}

}  // namespace

PaperFigure figure_5(const PaperData& data) {
  PaperFigure fig{"5", "Top-down projections after two images", {}, {}, {}};
  constexpr std::size_t kImages = 2;
  fig.add(
      "<p>Yellow: the true footprints. The lenses are outside the drawings. R is recklessness, P "
      "paranoia; a model without area has no P.</p><div class=\"plans\">");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    fig.add_svg(fmt::format("fig05_{}.svg", landmark_name(landmark)),
                draw_plan(model_plan(data.shown, landmark, kImages, 0.9)), "plan");
  }
  fig.add("</div>" + algorithm_legend() + score_table(data.shown, kImages));
  Csv csv("landmark,algorithm,recklessness,paranoia,iou");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      const Score& score = data.shown.score(a, landmark, kImages);
      csv.row({landmark_name(landmark), std::string(algorithms()[a].key), csv_number(score.recklessness),
               csv_number(measure_of(score, &Score::paranoia)), csv_number(score.iou)});
    }
  }
  fig.add_file("fig05.csv", csv.text());
  const auto cylinder = algorithm_index("cylinder");
  const auto carving = algorithm_index("carving");
  if (cylinder && carving) {
    bool bold = true;
    for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
      bold = bold && data.shown.score(*carving, landmark, kImages).recklessness <=
                         data.shown.score(*cylinder, landmark, kImages).recklessness;
    }
    fig.say("trade-off", bold,
            "The two values track the trade-off: the carved region encloses more of each object, the cylinder "
            "claims less free space.",
            " In this scene a lost piece of a segment cuts the carved region at once.");
  }
  return fig;
}

PaperFigure figure_12b(const PaperData& data) {
  PaperFigure fig{"12b", "Thoroughness and novelty", {}, {}, {}};
  const SequenceData& shown = data.shown;
  const LinearRing& outline = shown.tour.scene.objects[kYellowLandmark].footprint.outer;
  const std::size_t images = std::min<std::size_t>(8, shown.tour.frames.size() / 2);
  ViewSet set(outline);
  for (std::size_t f = 0; f < images; ++f) set.add(shown.shown[kYellowLandmark][f]);
  const std::size_t next = half_new_image(shown, set, images);
  draw_perimeters(fig, shown, set, images, next);
  const auto novelty = set.novelty(shown.shown[kYellowLandmark][next]);
  fig.add(
      fmt::format("<p>Dark: what the first {} images show of the perimeter, a thoroughness of {}. Orange: what image "
                  "{} shows, with a novelty of {} over them. Both are exact; no model has a part in them.</p>",
                  images, percent(set.thoroughness()), next + 1, percent(novelty.value_or(0))));
  chart_perimeters(fig, data);
  return fig;
}

}  // namespace fencepost::host
