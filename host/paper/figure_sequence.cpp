// Figure 7: the yellow object along the sequence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/paper/figure.hpp"
#include "host/paper/figure_curves.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

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
  const std::string over = scenes_text(data, data.noisy.size());
  const std::size_t last = data.mean_images.back();
  fig.say(
      few_c.p < few_k.p && few_k.r < few_c.r,
      fmt::format("With 2 images triangulation is better in paranoia ({} against {}), space carving in recklessness "
                  "({} against {}; {}).",
                  percent(few_c.p), percent(few_k.p), percent(few_k.r), percent(few_c.r), over),
      " Two views so close together do not fix the place of a cylinder.");
  const Trade many_c = mean_trade(data.noisy, *cylinder, last);
  const Trade many_k = mean_trade(data.noisy, *carving, last);
  fig.say(many_c.r < many_k.r && many_c.p < many_k.p,
          fmt::format("With all {} cylinders outperform carving in both: R {} against {}, P {} against {}.", last,
                      percent(many_c.r), percent(many_k.r), percent(many_c.p), percent(many_k.p)),
          many_c.r < many_k.r
              ? " In recklessness they do. The little that carving has left lies within the object, so it is hardly "
                "paranoid; a scene whose object is carved away whole counts 1 for both."
              : " The segments are good enough for carving to lose little, and it has the right shape.");
  const Trade middle_k = mean_trade(data.noisy, *carving, 8);
  fig.say(
      many_k.r > middle_k.r,
      fmt::format("Carving's recklessness grows with the number of imperfect images, from {} after 8 to {} after {}.",
                  percent(middle_k.r), percent(many_k.r), last),
      " Here hardly any segment was too small.");
  if (!data.ideal.empty()) {
    const Trade ideal_few = mean_trade(data.ideal, *carving, 8);
    const Trade ideal_many = mean_trade(data.ideal, *carving, last);
    fig.say(ideal_many.r < 0.05 && ideal_many.p < ideal_few.p,
            fmt::format(
                "With ideal segmentation it would not: R {} after {} (whole pixels are all the noise), while P falls "
                "from {} after 8 to {}.",
                percent(ideal_many.r), last, percent(ideal_few.p), percent(ideal_many.p)),
            " Whole pixels alone are enough to cut something away.");
  }
  const double change = radius_change(data.shown);
  fig.say(change < 0.10,
          fmt::format("The radius of the cylinder stays about constant: from image 8 on it is off its last "
                      "value by {} on average.",
                      percent(change)),
          " Until much of it has been seen, its centre moves, and the radius with it.");
}

void claim_hybrid(const PaperData& data, PaperFigure& fig) {
  const std::size_t last = data.mean_images.back();
  for (const std::string_view key : {"hybrid", "hybrid_inferred"}) {
    const auto hybrid = algorithm_index(key);
    if (!hybrid) continue;
    std::string text = fmt::format("{}, R + P against the best of the paper's three:",
                                   key == "hybrid" ? "The hybrid" : "With the robot\u2019s own flags");
    for (const std::size_t images : data.mean_images) {
      if (images != last && images != 2 && images != 4 && images != 8 && images != 18) continue;
      double best = 2;
      for (std::size_t a = 0; a < 3; ++a) best = std::min(best, mean_trade(data.noisy, a, images).sum());
      text += fmt::format(" {} against {} after {}{}", percent(mean_trade(data.noisy, *hybrid, images).sum(), 0),
                          percent(best, 0), images, images == last ? "." : ",");
    }
    fig.claims.push_back({ClaimKind::kBeyond, text});
  }
}

/// The paper's 2, 4, 8 and 18, as far as there are so many.
std::vector<std::size_t> shown_images(const PaperData& data) {
  std::vector<std::size_t> images{2, 4, 8, 18};
  std::erase_if(images, [&](std::size_t n) { return n > data.shown.tour.frames.size(); });
  return images;
}

}  // namespace

PaperFigure figure_7(const PaperData& data) {
  PaperFigure fig{"7", "Reconstruction of the yellow object along the sequence", {}, {}, {}};
  fig.add("<div class=\"pictures\">");
  for (const std::size_t images : shown_images(data)) {
    fig.add_picture(fmt::format("fig07_image_{}.png", images), real_picture(data.shown.tour, images - 1),
                    fmt::format("image {}", images));
  }
  fig.add("</div><div class=\"plans\">");
  for (const std::size_t images : shown_images(data)) {
    fig.add_svg(fmt::format("fig07_{}.svg", images), draw_plan(model_plan(data.shown, kYellowLandmark, images, 0.5)),
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
                  axis_end(data),
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
  if (data.run.empty()) {
    add_curves("noisy", "mean of " + scenes_text(data, data.noisy.size()), data.mean_images,
               [&](std::size_t a, std::size_t n, double Score::*what) { return mean_score(data.noisy, a, n, what); });
    add_curves("ideal", "ideal segmentation", data.mean_images,
               [&](std::size_t a, std::size_t n, double Score::*what) { return mean_score(data.ideal, a, n, what); });
  }
  fig.add("</div>");
  fig.add_file("fig07.csv", csv.text());
  claim_trade_off(data, fig);
  claim_hybrid(data, fig);
  return fig;
}

}  // namespace fencepost::host
