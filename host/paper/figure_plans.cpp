// Figures 5, 7 and 12b: top views, and the curves that belong to them.
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

PlanArea true_area(const SceneObject& object) { return {{object.footprint}, "#f2d024", "#8a7400", {}, 0.85, 1.2}; }

PlanArea model_area(const MultiPolygon& geometry, const Algorithm& algorithm) {
  return {geometry, std::string(algorithm.colour), std::string(algorithm.colour), std::string(algorithm.dash), 0.10, 2};
}

/// Arrows of the first `images` lenses.
std::vector<PlanLens> first_lenses(const Tour& tour, std::size_t images) {
  std::vector<PlanLens> lenses;
  for (std::size_t f = 0; f < images; ++f) {
    const CameraPose lens = lens_at(tour.scene.camera, tour.frames[f].pose);
    lenses.push_back({{lens.x, lens.y}, lens.heading, "#3b4a5c"});
  }
  return lenses;
}

Plan plan_of(const SequenceData& data, std::size_t landmark, std::size_t images, double side) {
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
                          figure(score.paranoia, 2));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

struct Trade {
  double r = 0;
  double p = 0;
  [[nodiscard]] double sum() const { return r + p; }
};

Trade mean_trade(const std::vector<SequenceData>& data, std::size_t algorithm, std::size_t images) {
  return {mean_score(data, algorithm, images, &Score::recklessness),
          mean_score(data, algorithm, images, &Score::paranoia)};
}

/// How much the printed cylinder's radius differs from its last one, on average from image 8 on.
double radius_change(const SequenceData& data) {
  std::vector<double> radii;
  for (const Snapshot& snapshot : data.models.given[kYellowLandmark].snapshots) {
    if (snapshot.frames < 8) continue;
    for (const ModelResult& model : snapshot.models) {
      if (model.name == "cylinder_paper" && model.circle) radii.push_back(model.circle->radius);
    }
  }
  double sum = 0;
  for (const double radius : radii) sum += std::abs(radius / radii.back() - 1);
  return radii.empty() ? 0 : sum / static_cast<double>(radii.size());
}

void claim_trade_off(const PaperData& data, PaperFigure& fig) {
  const auto cylinder = algorithm_index("cylinder");
  const auto carving = algorithm_index("carving");
  if (!cylinder || !carving) return;
  const Trade few_c = mean_trade(data.noisy, *cylinder, 2);
  const Trade few_k = mean_trade(data.noisy, *carving, 2);
  const std::string over = fmt::format("over {} scenes", data.noisy.size());
  fig.say(
      few_c.p < few_k.p && few_k.r < few_c.r,
      fmt::format("With 2 images triangulation is better in paranoia ({} against {}), space carving in recklessness "
                  "({} against {}; means {}).",
                  percent(few_c.p), percent(few_k.p), percent(few_k.r), percent(few_c.r), over));
  const Trade many_c = mean_trade(data.noisy, *cylinder, 75);
  const Trade many_k = mean_trade(data.noisy, *carving, 75);
  fig.say(many_c.r < many_k.r && many_c.p < many_k.p,
          fmt::format("With all 75 cylinders outperform carving in both: R {} against {}, P {} against {}.",
                      percent(many_c.r), percent(many_k.r), percent(many_c.p), percent(many_k.p)),
          " In recklessness they do by far. The little that carving has left lies within the object, so it is hardly "
          "paranoid; a scene whose object is carved away whole counts 1 for both.");
  const Trade middle_k = mean_trade(data.noisy, *carving, 8);
  fig.say(
      many_k.r > middle_k.r,
      fmt::format("Carving's recklessness grows with the number of imperfect images, from {} after 8 to {} after 75.",
                  percent(middle_k.r), percent(many_k.r)));
  const Trade ideal_few = mean_trade(data.ideal, *carving, 8);
  const Trade ideal_many = mean_trade(data.ideal, *carving, 75);
  fig.say(
      ideal_many.r < 0.05 && ideal_many.p < ideal_few.p,
      fmt::format("With ideal segmentation it would not: R {} after 75 (whole pixels are all the noise), while P falls "
                  "from {} after 8 to {}.",
                  percent(ideal_many.r), percent(ideal_few.p), percent(ideal_many.p)));
  const double change = radius_change(data.shown);
  fig.say(change < 0.10,
          fmt::format("The radius of the cylinder stays about constant: from image 8 on it is off its last "
                      "value by {} on average.",
                      percent(change)));
}

void claim_hybrid(const PaperData& data, PaperFigure& fig) {
  for (const std::string_view key : {"hybrid", "hybrid_inferred"}) {
    const auto hybrid = algorithm_index(key);
    if (!hybrid) continue;
    std::string text = fmt::format("{}, R + P against the best of the paper's three:",
                                   key == "hybrid" ? "The hybrid" : "With the robot\u2019s own flags");
    for (const std::size_t images : {2U, 4U, 8U, 18U, 75U}) {
      double best = 2;
      for (std::size_t a = 0; a < 3; ++a) best = std::min(best, mean_trade(data.noisy, a, images).sum());
      text += fmt::format(" {} against {} after {}{}", percent(mean_trade(data.noisy, *hybrid, images).sum(), 0),
                          percent(best, 0), images, images == 75 ? "." : ",");
    }
    fig.claims.push_back({ClaimKind::kBeyond, text});
  }
}

}  // namespace

PaperFigure figure_5(const PaperData& data) {
  PaperFigure fig{"5", "Top-down projections after two images", {}, {}, {}};
  constexpr std::size_t kImages = 2;
  fig.add(
      "<p>Yellow: the true footprints. The lenses are outside the drawings. R is recklessness, P "
      "paranoia; 1 and 1: the model has nothing to say yet.</p><div class=\"plans\">");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    fig.add_svg(fmt::format("fig05_{}.svg", landmark_name(landmark)),
                draw_plan(plan_of(data.shown, landmark, kImages, 0.9)), "plan");
  }
  fig.add("</div>" + algorithm_legend() + score_table(data.shown, kImages));
  Csv csv("landmark,algorithm,recklessness,paranoia,iou");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      const Score& score = data.shown.score(a, landmark, kImages);
      csv.row({landmark_name(landmark), std::string(algorithms()[a].key), csv_number(score.recklessness),
               csv_number(score.paranoia), csv_number(score.iou)});
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
    fig.say(bold,
            "The two values track the trade-off: the carved region encloses more of each object, the cylinder "
            "claims less free space.",
            " In this scene a lost piece of a segment cuts the carved region at once.");
  }
  return fig;
}

PaperFigure figure_7(const PaperData& data) {
  PaperFigure fig{"7", "Reconstruction of the yellow object along the sequence", {}, {}, {}};
  fig.add("<div class=\"pictures\">");
  for (const std::size_t images : {2U, 4U, 8U, 18U}) {
    fig.add_picture(fmt::format("fig07_image_{}.png", images), real_picture(data.shown.tour, images - 1),
                    fmt::format("image {}", images));
  }
  fig.add("</div><div class=\"plans\">");
  for (const std::size_t images : {2U, 4U, 8U, 18U}) {
    fig.add_svg(fmt::format("fig07_{}.svg", images), draw_plan(plan_of(data.shown, kYellowLandmark, images, 0.5)),
                "plan");
  }
  fig.add("</div>" + algorithm_legend());
  Csv csv("scenes,image,algorithm,recklessness,paranoia,iou");
  const auto add_curves = [&](const std::string& key, const std::string& title, const std::vector<std::size_t>& images,
                              auto value) {
    for (const bool reckless : {true, false}) {
      Chart chart{fmt::format("{}, {}", reckless ? "Recklessness" : "Paranoia", title),
                  "images",
                  reckless ? "R" : "P",
                  0,
                  76,
                  0,
                  1,
                  {}};
      for (std::size_t a = 0; a < algorithms().size(); ++a) {
        ChartSeries series = series_of(algorithms()[a]);
        for (const std::size_t n : images) {
          series.points.push_back(
              {static_cast<double>(n), value(a, n, reckless ? &Score::recklessness : &Score::paranoia)});
        }
        chart.series.push_back(series);
      }
      fig.add_svg(fmt::format("fig07_{}_{}.svg", key, reckless ? "r" : "p"), draw_chart(chart), "chart");
    }
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      for (const std::size_t n : images) {
        csv.row({key, std::to_string(n), std::string(algorithms()[a].key),
                 csv_number(value(a, n, &Score::recklessness)), csv_number(value(a, n, &Score::paranoia)),
                 csv_number(value(a, n, &Score::iou))});
      }
    }
  };
  fig.add("<div class=\"charts\">");
  add_curves("shown", "this scene", data.shown.after, [&](std::size_t a, std::size_t n, double Score::*what) {
    return data.shown.score(a, kYellowLandmark, n).*what;
  });
  add_curves("noisy", fmt::format("mean of {} scenes", data.noisy.size()), kMeanImages,
             [&](std::size_t a, std::size_t n, double Score::*what) { return mean_score(data.noisy, a, n, what); });
  add_curves("ideal", "ideal segmentation", kMeanImages,
             [&](std::size_t a, std::size_t n, double Score::*what) { return mean_score(data.ideal, a, n, what); });
  fig.add("</div>");
  fig.add_file("fig07.csv", csv.text());
  claim_trade_off(data, fig);
  claim_hybrid(data, fig);
  return fig;
}

PaperFigure figure_12b(const PaperData& data) {
  PaperFigure fig{"12b", "Thoroughness and novelty", {}, {}, {}};
  const SequenceData& shown = data.shown;
  const LinearRing& outline = shown.tour.scene.objects[kYellowLandmark].footprint.outer;
  constexpr std::size_t kImages = 8;
  ViewSet set(outline);
  for (std::size_t f = 0; f < kImages; ++f) set.add(shown.shown[kYellowLandmark][f]);
  // The next image that shows about as much new as known.
  std::size_t next = kImages;
  double nearest = 2;
  for (std::size_t f = kImages; f < shown.tour.frames.size(); ++f) {
    const auto novelty = set.novelty(shown.shown[kYellowLandmark][f]);
    if (novelty && std::abs(*novelty - 0.5) < nearest) {
      nearest = std::abs(*novelty - 0.5);
      next = f;
    }
  }
  next = std::min(next, shown.tour.frames.size() - 1);
  const PerimeterPart& image = shown.shown[kYellowLandmark][next];
  Plan plan{fmt::format("{} images and one more", kImages), centroid({outline, {}}), 2.2, {}, {}, {}};
  plan.lenses = first_lenses(shown.tour, kImages);
  const CameraPose lens = lens_at(shown.tour.scene.camera, shown.tour.frames[next].pose);
  plan.lenses.push_back({{lens.x, lens.y}, lens.heading, "#d98200"});
  plan.areas.push_back({{{outline, {}}}, "#f2d024", "none", {}, 0.6, 0});
  plan.parts = {{set.seen(), outline, "#3b4a5c", 6}, {image, outline, "#d98200", 2.5}};
  Plan close = plan;
  close.title = "the object from near";
  close.side = 0.3;
  fig.add("<div class=\"plans\">");
  fig.add_svg("fig12b_plan.svg", draw_plan(plan), "plan");
  fig.add_svg("fig12b_close.svg", draw_plan(close), "plan");
  fig.add("</div>");
  const auto novelty = set.novelty(image);
  fig.add(
      fmt::format("<p>Dark: what the first {} images show of the perimeter, a thoroughness of {}. Orange: what image "
                  "{} shows, with a novelty of {} over them. Both are exact; no model has a part in them.</p>",
                  kImages, percent(set.thoroughness()), next + 1, percent(novelty.value_or(0))));
  Csv csv("image,landmark,thoroughness,novelty");
  fig.add("<div class=\"charts\">");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    Chart chart{
        fmt::format("The {} landmark", landmark_name(landmark)), "image", "share of the perimeter", 0, 76, 0, 1, {}};
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
  return fig;
}

}  // namespace fencepost::host
