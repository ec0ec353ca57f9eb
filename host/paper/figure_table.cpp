// Figure 10: the table of landmarks found again.
#include <fmt/format.h>

#include <algorithm>

#include "host/paper/figure.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;

struct PaperRow {
  std::string_view landmark;
  std::array<double, 3> accuracy;
};
/// Rows All of the paper's table, cylinders, plane sheaves, space carving; of 73 images, 146 for the average.
constexpr std::array<PaperRow, 3> kPaperRows{
    {{"Red", {100.00, 97.26, 91.78}}, {"Yellow", {97.26, 98.63, 98.63}}, {"Average", {98.63, 97.95, 95.21}}}};

std::string cell(const OutcomeCounts& counts, std::optional<MatchOutcome> type) {
  const std::size_t wrong = type ? counts.incorrect(*type) : counts.incorrect();
  const std::size_t all = type ? counts.total(*type) : counts.total();
  const double accuracy = type ? counts.accuracy(*type) : counts.accuracy();
  const std::string share = percent(accuracy, 2);
  return fmt::format("<td class=\"n\">{}<small>{} of {}</small></td>", type ? share : "<b>" + share + "</b>", wrong,
                     all);
}

std::string head() {
  std::string html = "<thead><tr><th>landmark</th><th>result</th>";
  for (const Algorithm& algorithm : algorithms())
    html += fmt::format("<th class=\"n\">{}</th>", escaped(algorithm.label));
  return html + "</tr></thead>\n";
}

std::string paper_row(const PaperRow& row) {
  std::string html = fmt::format("<tr class=\"soft\"><td>{}</td><td>the paper</td>", row.landmark);
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const bool known = algorithms()[a].paper_average.has_value();
    html += fmt::format("<td class=\"n\">{}</td>", known ? percent(row.accuracy[a] / 100, 2) : "\u2013");
  }
  return html + "</tr>\n";
}

std::string landmark_rows(const PaperData& data, std::size_t landmark, Csv& csv) {
  std::string html;
  const std::string title(kPaperRows[landmark].landmark);
  for (const MatchOutcome type : {MatchOutcome::kMatched, MatchOutcome::kUnmatched, MatchOutcome::kUnseen}) {
    html += fmt::format("<tr><td>{}</td><td>{}</td>", title, name(type));
    for (const ReacquisitionScore& score : data.table) html += cell(score.landmarks[landmark], type);
    html += "</tr>\n";
  }
  html += fmt::format("<tr><td>{}</td><td>empty models</td>", title);
  for (std::size_t a = 0; a < data.table.size(); ++a) {
    const std::size_t empty = data.table[a].empty[landmark];
    html += fmt::format("<td class=\"n\">{} of {}</td>", empty, data.table_scenes);
    csv.row({landmark_name(landmark), "empty models", std::string(algorithms()[a].key), std::to_string(empty),
             std::to_string(data.table_scenes), "", ""});
  }
  html += "</tr>\n";
  html += fmt::format("<tr><td>{}</td><td>all</td>", title);
  for (std::size_t a = 0; a < data.table.size(); ++a) {
    const OutcomeCounts& counts = data.table[a].landmarks[landmark];
    html += cell(counts, std::nullopt);
    for (const MatchOutcome type : {MatchOutcome::kMatched, MatchOutcome::kUnmatched, MatchOutcome::kUnseen}) {
      csv.row({landmark_name(landmark), std::string(name(type)), std::string(algorithms()[a].key),
               std::to_string(counts.incorrect(type)), std::to_string(counts.total(type)),
               csv_number(100 * counts.accuracy(type), 2), ""});
    }
    const auto& paper = landmark == kRedLandmark ? algorithms()[a].paper_red : algorithms()[a].paper_yellow;
    csv.row({landmark_name(landmark), "all", std::string(algorithms()[a].key), std::to_string(counts.incorrect()),
             std::to_string(counts.total()), csv_number(100 * counts.accuracy(), 2),
             paper ? csv_number(*paper, 2) : ""});
  }
  return html + "</tr>\n" + paper_row(kPaperRows[landmark]);
}

void claim(const PaperData& data, PaperFigure& fig) {
  std::vector<double> of_the_paper;
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const Algorithm& algorithm = algorithms()[a];
    const double right = 100 * data.table[a].all().accuracy();
    const double sigma = 100 * standard_error(data.table[a].scene_accuracies);
    const bool many = data.table[a].scene_accuracies.size() > 1;
    const std::string text =
        fmt::format("{}: {} % of the decisions are right{}", algorithm.label, figure(right, 2),
                    many ? fmt::format(" (standard error over scenes {})", figure(sigma, 2)) : std::string());
    if (!algorithm.paper_average) {
      const double best = of_the_paper.empty() ? 0 : *std::max_element(of_the_paper.begin(), of_the_paper.end());
      fig.compare(std::string(algorithm.key), right >= best,
                  fmt::format("{}; the best of the paper\u2019s three here: {} %.", text, figure(best, 2)));
      continue;
    }
    of_the_paper.push_back(right);
    const bool above = right >= *algorithm.paper_average;
    const bool near = right + sigma >= *algorithm.paper_average;
    fig.say(std::string(algorithm.key), near,
            fmt::format("{}, {} % in the paper{}", text, figure(*algorithm.paper_average, 2),
                        near && !above ? ": less, but not by more than that error." : "."),
            " A landmark that is carved away, or too large to be distinct from others, is not found.");
  }
  if (of_the_paper.size() == 3) {
    const bool all_equal = of_the_paper[0] == of_the_paper[1] && of_the_paper[1] == of_the_paper[2];
    fig.say("order", !all_equal && of_the_paper[0] >= of_the_paper[1] && of_the_paper[1] >= of_the_paper[2],
            "The order is the paper\u2019s: cylinders, then plane sheaves, then space carving.",
            all_equal ? " All three are right equally often." : " It is another one.");
  }
}

}  // namespace

PaperFigure figure_10(const PaperData& data) {
  PaperFigure fig{"10", "Landmarks found again", {}, {}, {}};
  fig.add(fmt::format(
      "<p>{}; each landmark rendered from each pose, by models of all images, and matched "
      "with the real image. The paper: one scene of 73 images, that is 146 decisions an algorithm.</p>",
      scenes_text(data, data.table_scenes) +
          (data.run.empty() ? " of 75 images" : fmt::format(", {} images", data.shown.tour.frames.size()))));
  Csv csv("landmark,result,algorithm,wrong,all,right_percent,paper_percent");
  fig.add("<div class=\"scroll\"><table class=\"decisions\">" + head() + "<tbody>\n");
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) fig.add(landmark_rows(data, landmark, csv));
  std::string average = "<tr><td>Average</td><td></td>";
  for (std::size_t a = 0; a < data.table.size(); ++a) {
    const OutcomeCounts counts = data.table[a].all();
    average += cell(counts, std::nullopt);
    const auto& paper = algorithms()[a].paper_average;
    csv.row({"average", "all", std::string(algorithms()[a].key), std::to_string(counts.incorrect()),
             std::to_string(counts.total()), csv_number(100 * counts.accuracy(), 2),
             paper ? csv_number(*paper, 2) : ""});
  }
  fig.add(average + "</tr>\n" + paper_row(kPaperRows[2]) + "</tbody></table></div>\n");
  fig.add(
      "<p class=\"note\">matched: found in the real image, wrong if it is something else. unmatched: rendered but not "
      "found, wrong if it is there whole. unseen: not rendered, wrong if it is there whole. Small: wrong decisions of "
      "all. An empty model is never rendered: each image that shows its landmark whole is a wrong decision.</p>\n");
  fig.add_file("fig10.csv", csv.text());
  claim(data, fig);
  return fig;
}

}  // namespace fencepost::host
