// Figures 12, 13 and 14: confidence along the sequence and over novelty, recklessness and paranoia over thoroughness.
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

/// Novelty at which two segments of Figure 13 meet.
constexpr double kHalfNew = 0.5;

std::vector<Point> points_of(const std::vector<NoveltySample>& samples, double from, double to) {
  std::vector<Point> points;
  for (const NoveltySample& sample : samples) {
    if (sample.novelty >= from && sample.novelty <= to) points.push_back({sample.novelty, sample.confidence});
  }
  return points;
}

/// (thoroughness, R or P) of the yellow landmark over all scenes and images; P is not a number for an empty model.
std::vector<Point> against_thoroughness(const std::vector<SequenceData>& sequences, std::size_t algorithm,
                                        double Score::*what) {
  std::vector<Point> points;
  for (const SequenceData& data : sequences) {
    for (const std::size_t images : data.after) {
      points.push_back({data.thoroughness[kYellowLandmark][images - 1],
                        measure_of(data.score(algorithm, kYellowLandmark, images), what)});
    }
  }
  return points;
}

/// The points of models that have this measure.
std::vector<Point> known(std::vector<Point> points) {
  std::erase_if(points, [](const Point& p) { return std::isnan(p.y); });
  return points;
}

struct Range {
  double low = 1;
  double high = 0;
  double changes = 0;  ///< mean step from image to image
};

Range range_of(const std::vector<Reacquisition>& sequence) {
  Range range;
  std::optional<double> before;
  double steps = 0;
  for (const Reacquisition& one : sequence) {
    if (!one.match) continue;
    const double value = one.match->match_confidence;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
    if (before) {
      range.changes += std::abs(value - *before);
      steps += 1;
    }
    before = value;
  }
  if (steps > 0) range.changes /= steps;
  return range;
}

/// The lines through the paper's algorithms' points, on both sides of half new.
struct Segments {
  std::size_t fitted = 0;
  std::size_t downward = 0;

  void add(const std::optional<Slope>& slope) {
    if (!slope) return;
    ++fitted;
    if (slope->falls()) ++downward;
  }
};

std::string slope_cell(const std::optional<Slope>& slope) {
  return slope ? fmt::format("{}<small>\u00b1 {}</small>", figure(slope->value, 2), figure(slope->sigma, 2))
               : "nothing to fit";
}

/// "3 of 60": models of Figure 13 that are never rendered.
std::string empty_cell(const PaperData& data, std::size_t algorithm) {
  std::size_t empty = 0;
  std::size_t models = 0;
  for (const std::size_t images : kNoveltySets) {
    if (images > data.shown.tour.frames.size()) continue;
    empty += count_empty(data.noisy, algorithm, images);
    models += data.noisy.size();
  }
  return fmt::format("{} of {}", empty, models);
}

/// "8, 18 and 36", as far as the data has that many images.
std::string novelty_sets(const PaperData& data) {
  std::vector<std::string> sets;
  for (const std::size_t images : kNoveltySets) {
    if (images <= data.shown.tour.frames.size()) sets.push_back(std::to_string(images));
  }
  std::string text;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == sets.size() ? " and " : ", ") + sets[i];
  }
  return text;
}

Chart novelty_chart(const Algorithm& algorithm, const std::vector<NoveltySample>& samples) {
  constexpr std::size_t kShown = 25;  ///< one of this many viewpoints is shown, as a dot
  Chart chart{std::string(algorithm.label), "novelty of the viewpoint", "match confidence", 0, 1, 0, 1, {}};
  ChartSeries dots{"", std::string(algorithm.colour), {}, {}, false, true, 0.35};
  for (std::size_t i = 0; i < samples.size(); i += kShown) {
    dots.points.push_back({samples[i].novelty, samples[i].confidence});
  }
  ChartSeries line{"", std::string(algorithm.colour), {}, {}, true, true, 1};
  line.points = binned_means(points_of(samples, 0, 1), 0, 1, 10, 5);
  chart.series = {dots, line};
  return chart;
}

void say_of_novelty(PaperFigure& fig, const Segments& segments) {
  if (segments.fitted == 0) {
    fig.say("falls", false, "Confidence falls as novelty rises.",
            " All viewpoints on each side of half new are equally new: there is nothing to fit.");
    return;
  }
  fig.say(
      "falls", 2 * segments.downward > segments.fitted,
      fmt::format("Confidence falls as novelty rises, by more than two standard errors, in {} of {} segments of the "
                  "paper\u2019s three algorithms (the paper: in all).",
                  segments.downward, segments.fitted));
}

void say_who_is_least_sure(PaperFigure& fig, const PaperData& data) {
  std::string list;
  std::optional<std::size_t> least;
  std::vector<double> means;
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    std::vector<double> values;
    for (const NoveltySample& sample : data.novelty[a]) values.push_back(sample.confidence);
    means.push_back(mean(values));
    if (!algorithms()[a].paper_average || values.empty()) continue;
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", algorithms()[a].label, figure(means[a], 3));
    if (!least || means[a] < means[*least]) least = a;
  }
  if (!least) return;
  fig.say("least sure", algorithms()[*least].key == "carving",
          fmt::format("Space carving is the least confident of the three (means: {}).", list));
}

double trend(const PaperData& data, std::size_t algorithm, double Score::*what) {
  return rank_correlation(known(against_thoroughness(data.noisy, algorithm, what)));
}

constexpr int kThoroughnessParts = 20;
constexpr std::size_t kMinInPart = 3;

void draw_trends(PaperFigure& fig, const PaperData& data) {
  Csv parts("algorithm,measure,thoroughness,n,mean,deviation");
  fig.add("<div class=\"charts\">");
  for (const bool reckless : {true, false}) {
    Chart chart{reckless ? "Recklessness" : "Paranoia", "thoroughness", reckless ? "R" : "P", 0, 1, 0, 1, {}};
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      ChartSeries series = series_of(algorithms()[a]);
      const auto points =
          known(against_thoroughness(data.noisy, a, reckless ? &Score::recklessness : &Score::paranoia));
      series.points = binned_means(points, 0, 1, kThoroughnessParts, kMinInPart);
      chart.series.push_back(series);
      for (const BinStatistics& bin : bin_statistics(points, 0, 1, kThoroughnessParts)) {
        parts.row({std::string(algorithms()[a].key), reckless ? "recklessness" : "paranoia", csv_number(bin.x),
                   std::to_string(bin.count), csv_number(bin.mean), bin.count > 1 ? csv_number(bin.deviation) : ""});
      }
    }
    fig.add_svg(reckless ? "fig14_r.svg" : "fig14_p.svg", draw_chart(chart), "chart");
  }
  fig.add("</div>");
  fig.add_file("fig14_parts.csv", parts.text());
}

void add_trend_table(PaperFigure& fig, const PaperData& data) {
  Csv csv("algorithm,thoroughness,recklessness,paranoia");
  std::string table;
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const auto r = against_thoroughness(data.noisy, a, &Score::recklessness);
    const auto p = against_thoroughness(data.noisy, a, &Score::paranoia);
    for (std::size_t i = 0; i < r.size(); ++i) {
      csv.row({std::string(algorithms()[a].key), csv_number(r[i].x), csv_number(r[i].y), csv_number(p[i].y)});
    }
    const auto shapes = known(p);
    table +=
        fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{} of {}</td></tr>\n",
                    escaped(algorithms()[a].label), figure(rank_correlation(r), 2), figure(rank_correlation(shapes), 2),
                    p.size() - shapes.size(), p.size());
  }
  fig.add(
      "<div class=\"scroll\"><table class=\"counts\"><thead><tr><th>rank correlation with thoroughness</th>"
      "<th class=\"n\">R</th><th class=\"n\">P</th><th class=\"n\">empty, without P</th></tr></thead><tbody>\n" +
      table + "</tbody></table></div>\n");
  fig.add_file("fig14.csv", csv.text());
}

void say_of_trends(PaperFigure& fig, const PaperData& data, std::size_t cylinder, std::size_t carving) {
  const double cylinder_p = trend(data, cylinder, &Score::paranoia);
  const double carving_p = trend(data, carving, &Score::paranoia);
  fig.say(
      "paranoia", cylinder_p < 0 && carving_p < 0,
      fmt::format("Paranoia decreases as more of the object is seen, by cylinders (rank correlation {}) and by carving "
                  "({}).",
                  figure(cylinder_p, 2), figure(carving_p, 2)));
  const double cylinder_r = trend(data, cylinder, &Score::recklessness);
  fig.say("recklessness of cylinders", cylinder_r < 0,
          fmt::format("Recklessness decreases too for cylinders ({}).", figure(cylinder_r, 2)));
  const double carving_r = trend(data, carving, &Score::recklessness);
  fig.say("recklessness of carving", carving_r > 0,
          fmt::format("For carving it can only increase, since what is cut away never comes back ({}){}.",
                      figure(carving_r, 2),
                      data.run.empty() ? "; here not slowly: 5 % of our segments lose up to half of their width" : ""));
}

bool of_the_paper(const Algorithm& algorithm) { return algorithm.paper_average.has_value(); }

}  // namespace

PaperFigure figure_12(const PaperData& data) {
  PaperFigure fig{"12", "Match confidence over the sequence", {}, {}, {}};
  fig.add(
      "<p>Models of all images, rendered from each of their poses; the second best match score minus the best "
      "one." +
      shown_empty(data) + "</p><div class=\"charts\">");
  Csv csv("image,landmark,algorithm,error,match_confidence,margin,outcome");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    Chart chart{fmt::format("The {} landmark", landmark_name(landmark)),
                "image",
                "match confidence",
                0,
                axis_end(data),
                0,
                1,
                {}};
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      ChartSeries series = series_of(algorithms()[a]);
      for (std::size_t f = 0; f < data.sequence[a][landmark].size(); ++f) {
        const Reacquisition& one = data.sequence[a][landmark][f];
        series.points.push_back({static_cast<double>(f + 1), one.match ? one.match->match_confidence : std::nan("")});
        csv.row({std::to_string(f + 1), landmark_name(landmark), std::string(algorithms()[a].key),
                 one.match ? csv_number(one.match->error) : "",
                 one.match ? csv_number(one.match->match_confidence) : "",
                 one.match ? csv_number(one.match->margin) : "", std::string(name(one.outcome))});
      }
      chart.series.push_back(series);
    }
    fig.add_svg(fmt::format("fig12_{}.svg", landmark_name(landmark)), draw_chart(chart), "chart");
  }
  fig.add("</div>");
  fig.add_file("fig12.csv", csv.text());
  if (const auto cylinder = algorithm_index("cylinder")) {
    const Range range = range_of(data.sequence[*cylinder][kYellowLandmark]);
    fig.say(
        "varies", range.high - range.low > 0.2,
        fmt::format("The confidence varies hugely with the pose of the camera, whatever the algorithm: by cylinders, "
                    "for yellow, between {} and {}, by {} from one image to the next. What else is in the image "
                    "decides it.",
                    figure(range.low, 2), figure(range.high, 2), figure(range.changes, 2)),
        " In this scene the background hardly changes.");
  }
  return fig;
}

PaperFigure figure_13(const PaperData& data) {
  PaperFigure fig{"13", "Match confidence against novelty", {}, {}, {}};
  fig.add(
      fmt::format("<p>Models of the first {} images ({}), rendered from all poses that show the yellow "
                  "landmark. Novelty is that of the viewpoint over the images of the model. Lines: means over tenths "
                  "of novelty; dots: every 25th viewpoint.</p><div class=\"charts\">",
                  novelty_sets(data), scenes_text(data, data.noisy.size())));
  Csv csv("algorithm,images,novelty,match_confidence");
  Segments segments;
  std::string slopes;
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const Algorithm& algorithm = algorithms()[a];
    const std::vector<NoveltySample>& samples = data.novelty[a];
    for (const NoveltySample& sample : samples) {
      csv.row({std::string(algorithm.key), std::to_string(sample.images), csv_number(sample.novelty),
               csv_number(sample.confidence)});
    }
    fig.add_svg(fmt::format("fig13_{}.svg", algorithm.key), draw_chart(novelty_chart(algorithm, samples)), "chart");
    const auto low = slope(points_of(samples, 0, kHalfNew));
    const auto high = slope(points_of(samples, kHalfNew, 1));
    slopes += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
                          escaped(algorithm.label), slope_cell(low), slope_cell(high), empty_cell(data, a));
    if (!of_the_paper(algorithm)) continue;
    segments.add(low);
    segments.add(high);
  }
  fig.add(
      "</div><div class=\"scroll\"><table class=\"counts\"><thead><tr><th>model</th><th class=\"n\">slope below "
      "half new, its standard error</th><th class=\"n\">slope above</th><th class=\"n\">empty models</th></tr></thead>"
      "<tbody>\n" +
      slopes + "</tbody></table></div>\n");
  fig.add_file("fig13.csv", csv.text());
  say_of_novelty(fig, segments);
  say_who_is_least_sure(fig, data);
  return fig;
}

PaperFigure figure_14(const PaperData& data) {
  PaperFigure fig{"14", "Recklessness and paranoia against thoroughness", {}, {}, {}};
  fig.add(
      fmt::format("<p>The data of Figure 7 (yellow, {}) by the share of the perimeter that the images have "
                  "shown: means over parts of 5 % with at least {} points; how many and how far apart these are stands "
                  "in fig14_parts.csv.</p>",
                  scenes_text(data, data.noisy.size()), kMinInPart));
  draw_trends(fig, data);
  add_trend_table(fig, data);
  const auto cylinder = algorithm_index("cylinder");
  const auto carving = algorithm_index("carving");
  if (!cylinder || !carving) return fig;
  say_of_trends(fig, data, *cylinder, *carving);
  const auto hybrid = algorithm_index("hybrid");
  if (!hybrid) return fig;
  const double hybrid_r = trend(data, *hybrid, &Score::recklessness);
  const double hybrid_p = trend(data, *hybrid, &Score::paranoia);
  fig.compare(
      "hybrid", hybrid_r < 0 && hybrid_p < 0,
      fmt::format("The hybrid: rank correlation of its recklessness with thoroughness {}, of its paranoia {}{}.",
                  figure(hybrid_r, 2), figure(hybrid_p, 2),
                  hybrid_r < 0 && hybrid_p < 0 ? "; both fall, it takes back what a bad segment cut away" : ""));
  return fig;
}

}  // namespace fencepost::host
