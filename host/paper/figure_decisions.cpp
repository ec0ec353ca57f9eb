// Figures 9 and 11: single decisions, right and wrong.
#include <fmt/format.h>

#include "host/paper/figure.hpp"
#include "host/paper/figure_pictures.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;

/// A decision about one landmark in one image, drawn.
struct DrawnDecision {
  Tour tour;
  Reacquisition result;
  Picture real;       ///< with the region that was taken, if any
  Picture segmented;  ///< its regions
  Picture rendered;   ///< by the model
};

DrawnDecision draw_decision(const PaperData& data, const Decision& decision) {
  const bool recorded = !data.run.empty();
  DrawnDecision drawn;
  drawn.tour = recorded ? data.shown.tour : drive(blocks_world(decision.world, decision.seed));
  const Tour& tour = drawn.tour;
  RegionRenderer renderer(tour.scene.camera);
  const std::size_t blocks = recorded ? data.shown.models.given.size() : block_count(decision.world);
  const Models models = reconstruct(tour, blocks, {tour.frames.size()});
  const auto world = world_of(tour, models, algorithms()[decision.algorithm], 0);
  const auto both = reacquire_both(tour, renderer, world, decision.frame);
  drawn.result = both[decision.landmark];
  drawn.real = real_picture(tour, decision.frame);
  const bool taken =
      drawn.result.outcome == MatchOutcome::kMatched || drawn.result.outcome == MatchOutcome::kMismatched;
  if (taken) {
    const Region& region = tour.images[decision.frame].regions[drawn.result.match->best];
    draw_box(drawn.real, view_at(tour, tour.frames[decision.frame].pose), region, kTakenColour);
  }
  drawn.segmented = segmentation(tour, decision.frame);
  drawn.rendered = rendered_picture(tour, world, decision.frame, both);
  return drawn;
}

std::string world_name(const PaperData& data, const Decision& decision) {
  if (!data.run.empty()) return data.run;
  return decision.world == BlocksWorld::kHard ? "hard" : "paper-like";
}

}  // namespace

PaperFigure figure_9(const PaperData& data) {
  PaperFigure fig{"9", "The six outcomes of looking for a landmark", {}, {}, {}};
  fig.add(
      "<p>Three are correct, three are not. An example of each, by one of the paper\u2019s algorithms: the real image "
      "with the region that was taken (magenta), and what the model renders (dashed).</p>");
  Csv csv("outcome,correct,world,seed,image,algorithm,landmark,error");
  std::string missing;
  fig.add("<div class=\"pictures\">");
  for (std::size_t i = 0; i < kMatchOutcomes; ++i) {
    const auto outcome = static_cast<MatchOutcome>(i);
    const auto& example = data.examples.outcomes[i];
    if (!example) {
      missing += (missing.empty() ? "" : ", ") + std::string(name(outcome));
      csv.row({std::string(name(outcome)), is_correct(outcome) ? "1" : "0", "", "", "", "", "", ""});
      continue;
    }
    const DrawnDecision drawn = draw_decision(data, *example);
    const Algorithm& algorithm = algorithms()[example->algorithm];
    const std::string which =
        fmt::format("<b>{}</b>, {}: {}, {}, image {}", name(outcome), is_correct(outcome) ? "correct" : "incorrect",
                    escaped(algorithm.label), landmark_name(example->landmark), example->frame + 1);
    fig.add_picture(fmt::format("fig09_{}_real.png", name(outcome)), drawn.real, which);
    fig.add_picture(fmt::format("fig09_{}_rendered.png", name(outcome)), drawn.rendered,
                    "rendered: " + error_text(drawn.result));
    csv.row({std::string(name(outcome)), is_correct(outcome) ? "1" : "0", world_name(data, *example),
             std::to_string(example->seed), std::to_string(example->frame + 1), std::string(algorithm.key),
             landmark_name(example->landmark), drawn.result.match ? csv_number(drawn.result.match->error) : ""});
  }
  fig.add("</div>");
  fig.say("outcomes", missing.empty(), "Each of the six outcomes occurs.", " There is no example of: " + missing + ".");
  fig.claims.back().of_scenes = false;
  fig.add_file("fig09.csv", csv.text());
  return fig;
}

PaperFigure figure_11(const PaperData& data) {
  PaperFigure fig{"11", "A mismatch of low confidence", {}, {}, {}};
  Csv csv("world,seed,image,algorithm,landmark,error,match_confidence");
  if (!data.examples.least_sure_mismatch) {
    fig.add("<p>No landmark was taken for something else in any scene of this page.</p>");
    fig.add_file("fig11.csv", csv.text());
    return fig;
  }
  const Decision& found = *data.examples.least_sure_mismatch;
  const bool hard = data.run.empty() && found.world == BlocksWorld::kHard;
  const Algorithm& algorithm = algorithms()[found.algorithm];
  const DrawnDecision drawn = draw_decision(data, found);
  const LandmarkMatch& match = *drawn.result.match;
  fig.add("<div class=\"pictures\">");
  fig.add_picture("fig11_real.png", drawn.real, "real image; magenta: the region that was taken");
  fig.add_picture("fig11_segmented.png", drawn.segmented, "its regions");
  fig.add_picture("fig11_rendered.png", drawn.rendered, fmt::format("rendered by {}", escaped(algorithm.label)));
  fig.add("</div>");
  const auto& owner = drawn.tour.images[found.frame].truths[match.best].object;
  fig.add(fmt::format(
      "<p>The {} landmark, as the {} renders it, matched {} (error {}). In the paper it is the red landmark, by space "
      "carving, and a shadow of the background (0.34).</p>",
      landmark_name(found.landmark), escaped(algorithm.label),
      owner ? escaped(drawn.tour.scene.objects[*owner].name) : std::string("a false region"), figure(match.error, 3)));
  fig.say(
      "mismatch", !hard,
      fmt::format("Even in a simple scene a landmark is taken for something else: here by the {}.", algorithm.label),
      " The paper-like scenes have no mismatch; this one is of a hard scene, with more clutter.");
  fig.say("confidence", match.match_confidence < 0.1,
          fmt::format("Of all mismatches in {}, the least sure one has a confidence of {} (the paper's: 0.003): almost "
                      "no faith should be placed in it.",
                      hard ? "hard scenes" : scenes_text(data, data.table_scenes), figure(match.match_confidence, 3)),
          " The landmark is not in the image, and nothing else is near.");
  csv.row({world_name(data, found), std::to_string(found.seed), std::to_string(found.frame + 1),
           std::string(algorithm.key), landmark_name(found.landmark), csv_number(match.error),
           csv_number(match.match_confidence)});
  fig.add_file("fig11.csv", csv.text());
  return fig;
}

}  // namespace fencepost::host
