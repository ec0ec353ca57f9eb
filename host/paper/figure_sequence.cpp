// Figure 7: the yellow object along the sequence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/planar.hpp"
#include "host/paper/figure.hpp"
#include "host/paper/figure_curves.hpp"
#include "host/paper/figure_pictures.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

struct Trade {
  double r = 0;
  double p = 0;  ///< of models that are not empty
  [[nodiscard]] double sum() const { return r + p; }
};

Trade mean_trade(const std::vector<SequenceData>& data, std::size_t algorithm, std::size_t images) {
  return {mean_score(data, algorithm, images, &Score::recklessness),
          mean_score(data, algorithm, images, &Score::paranoia)};
}

/// " Empty, and without P: 3 of 20 by space carving."
std::string empty_text(const PaperData& data, const std::vector<std::size_t>& shown, std::size_t images) {
  std::string text;
  for (const std::size_t a : shown) {
    const std::size_t empty = count_empty(data.noisy, a, images);
    if (empty == 0) continue;
    text += fmt::format("{}{} of {} by {}", text.empty() ? " Empty, and without P: " : ", ", empty, data.noisy.size(),
                        algorithms()[a].label);
  }
  return text.empty() ? " No model is empty." : text + ".";
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

/// Angle of the lens around the object, between its first two images, degrees.
double angle_between_first_two(const Tour& tour) {
  const Point middle = centroid(tour.scene.objects[kYellowLandmark].footprint);
  const auto bearing = [&](std::size_t frame) {
    const CameraPose lens = lens_at(tour.scene.camera, tour.frames[frame].pose);
    return std::atan2(lens.y - middle.y, lens.x - middle.x);
  };
  return std::abs(std::remainder(bearing(1) - bearing(0), 2 * std::numbers::pi)) * 180 / std::numbers::pi;
}

void claim_trade_off(const PaperData& data, PaperFigure& fig, std::size_t cylinder, std::size_t carving) {
  const Trade few_c = mean_trade(data.noisy, cylinder, 2);
  const Trade few_k = mean_trade(data.noisy, carving, 2);
  const std::string over = scenes_text(data, data.noisy.size());
  const std::size_t last = data.mean_images.back();
  fig.say(
      "few images", few_c.p < few_k.p && few_k.r < few_c.r,
      fmt::format("With 2 images triangulation is better in paranoia ({} against {}), space carving in recklessness "
                  "({} against {}; {}).{}",
                  percent(few_c.p), percent(few_k.p), percent(few_k.r), percent(few_c.r), over,
                  empty_text(data, {cylinder, carving}, 2)),
      fmt::format(" The first two views are {} degrees apart.",
                  markup::figure(angle_between_first_two(data.noisy.front().tour), 0)));
  const Trade many_c = mean_trade(data.noisy, cylinder, last);
  const Trade many_k = mean_trade(data.noisy, carving, last);
  fig.say("many images", many_c.r < many_k.r && many_c.p < many_k.p,
          fmt::format("With all {} cylinders outperform carving in both: R {} against {}, P {} against {}.{}", last,
                      percent(many_c.r), percent(many_k.r), percent(many_c.p), percent(many_k.p),
                      empty_text(data, {cylinder, carving}, last)));
  if (const auto sheaf = algorithm_index("sheaf")) {
    const Trade many_s = mean_trade(data.noisy, *sheaf, last);
    fig.say(
        "plane sheaf", many_s.r < many_k.r && many_s.p < many_k.p,
        fmt::format("So do plane sheaves, the paper concludes: R {} against {}, P {} against {}.{}", percent(many_s.r),
                    percent(many_k.r), percent(many_s.p), percent(many_k.p), empty_text(data, {*sheaf, carving}, last)),
        many_s.r < many_k.r ? " In recklessness they do." : "");
  }
  const Trade middle_k = mean_trade(data.noisy, carving, 8);
  fig.say(
      "carving grows reckless", many_k.r > middle_k.r,
      fmt::format("Carving's recklessness grows with the number of imperfect images, from {} after 8 to {} after {}.",
                  percent(middle_k.r), percent(many_k.r), last));
  if (data.ideal.empty()) return;
  const Trade ideal_few = mean_trade(data.ideal, carving, 8);
  const Trade ideal_many = mean_trade(data.ideal, carving, last);
  fig.say("ideal segmentation", ideal_many.r < 0.05 && ideal_many.p < ideal_few.p,
          fmt::format("With ideal segmentation it would not: R {} after {} (whole pixels are all the noise), while P "
                      "falls from {} after 8 to {}.",
                      percent(ideal_many.r), last, percent(ideal_few.p), percent(ideal_many.p)));
}

void claim_radius(const PaperData& data, PaperFigure& fig) {
  const double change = radius_change(data.shown);
  fig.say("radius", change < 0.10,
          fmt::format("The radius of the cylinder stays about constant: from image 8 on it is off its last "
                      "value by {} on average.",
                      percent(change)));
}

void claim_hybrid(const PaperData& data, PaperFigure& fig) {
  const std::size_t last = data.mean_images.back();
  for (const std::string_view key : {"hybrid", "hybrid_inferred"}) {
    const auto hybrid = algorithm_index(key);
    if (!hybrid) continue;
    bool better = true;
    std::string text = fmt::format("{}, R + P against the best of the paper's three:",
                                   key == "hybrid" ? "The hybrid" : "With the robot\u2019s own flags");
    for (const std::size_t images : data.mean_images) {
      if (images != last && images != 2 && images != 4 && images != 8 && images != 18) continue;
      double best = 2;
      for (std::size_t a = 0; a < 3; ++a) best = std::min(best, mean_trade(data.noisy, a, images).sum());
      const double ours = mean_trade(data.noisy, *hybrid, images).sum();
      better = better && ours <= best;
      text += fmt::format(" {} against {} after {}{}", percent(ours, 0), percent(best, 0), images,
                          images == last ? "." : ",");
    }
    fig.compare(std::string(key), better, text + empty_text(data, {0, 1, 2, *hybrid}, last));
  }
}

/// The paper's 2, 4, 8 and 18, as far as the tour has that many images.
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
                    fmt::format("image {}, {}", images, real_picture_name(data.shown.tour)));
  }
  fig.add("</div><div class=\"plans\">");
  for (const std::size_t images : shown_images(data)) {
    fig.add_svg(fmt::format("fig07_{}.svg", images), draw_plan(model_plan(data.shown, kYellowLandmark, images, 0.5)),
                "plan");
  }
  fig.add("</div>" + algorithm_legend());
  Csv csv("scenes,image,algorithm,recklessness,paranoia,iou,empty,models");
  const auto add_curves = [&](const std::string& key, const std::string& title, const std::vector<std::size_t>& images,
                              std::span<const SequenceData> sequences) {
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
          series.points.push_back({static_cast<double>(n),
                                   mean_score(sequences, a, n, reckless ? &Score::recklessness : &Score::paranoia)});
        }
        chart.series.push_back(series);
      }
      fig.add_svg(fmt::format("fig07_{}_{}.svg", key, reckless ? "r" : "p"), draw_chart(chart), "chart");
    }
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      for (const std::size_t n : images) {
        csv.row({key, std::to_string(n), std::string(algorithms()[a].key),
                 csv_number(mean_score(sequences, a, n, &Score::recklessness)),
                 csv_number(mean_score(sequences, a, n, &Score::paranoia)),
                 csv_number(mean_score(sequences, a, n, &Score::iou)), std::to_string(count_empty(sequences, a, n)),
                 std::to_string(sequences.size())});
      }
    }
  };
  fig.add("<div class=\"charts\">");
  add_curves("shown", "this scene", data.shown.after, {&data.shown, 1});
  if (data.run.empty()) {
    add_curves("noisy", "mean of " + scenes_text(data, data.noisy.size()), data.mean_images, data.noisy);
    add_curves("ideal", "ideal segmentation", data.mean_images, data.ideal);
  }
  fig.add("</div><p class=\"note\">Paranoia is of models that are not empty; fig07.csv counts the empty ones.</p>");
  fig.add_file("fig07.csv", csv.text());
  const auto cylinder = algorithm_index("cylinder");
  const auto carving = algorithm_index("carving");
  if (cylinder && carving) claim_trade_off(data, fig, *cylinder, *carving);
  claim_radius(data, fig);
  claim_hybrid(data, fig);
  return fig;
}

}  // namespace fencepost::host
