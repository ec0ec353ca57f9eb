// Figures 4, 6 and 8: real images beside rendered ones.
#include <fmt/format.h>

#include <cmath>

#include "host/geometry/planar.hpp"
#include "host/paper/figure.hpp"
#include "host/paper/figure_pictures.hpp"
#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;

/// The lens on the same side, but raised, looking down at the middle of the blocks.
PictureView raised_view(const Tour& tour, std::size_t frame) {
  constexpr double kHeight = 0.75;  // m
  constexpr double kAway = 0.8;
  PictureView view = view_at(tour, tour.frames[frame].pose);
  const Point red = centroid(tour.scene.objects[kRedLandmark].footprint);
  const Point yellow = centroid(tour.scene.objects[kYellowLandmark].footprint);
  const Point middle{(red.x + yellow.x) / 2, (red.y + yellow.y) / 2};
  const double angle = std::atan2(middle.y - view.lens.y, middle.x - view.lens.x);
  view.lens = {middle.x - kAway * std::cos(angle), middle.y - kAway * std::sin(angle), kHeight, angle};
  view.pitch = std::atan2(kHeight - 0.1, kAway);
  return view;
}

/// Blocks without background: the modelled ones.
std::vector<Solid> true_blocks(const Tour& tour, std::size_t blocks) {
  std::vector<Solid> world = true_world(tour);
  world.resize(blocks);
  return world;
}

struct TermSample {
  std::string_view algorithm;
  std::size_t landmark = 0;
  std::optional<ReacquisitionTerms> terms;
  double error = 1;
};

std::string terms_table(const std::vector<TermSample>& samples) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th>model</th><th>landmark</th>";
  for (const NamedTerm& term : named_terms({})) {
    html += fmt::format("<th class=\"n\">{}<small>weight {:.2f}</small></th>", term.name, term.weight);
  }
  html += "<th class=\"n\">error</th></tr></thead><tbody>\n";
  for (const TermSample& sample : samples) {
    html += fmt::format("<tr><td>{}</td><td>{}</td>", escaped(sample.algorithm), landmark_name(sample.landmark));
    for (std::size_t i = 0; i < named_terms({}).size(); ++i) {
      const auto value = sample.terms ? named_terms(*sample.terms)[i].value : std::nullopt;
      html += fmt::format("<td class=\"n\">{}</td>", value ? figure(*value, 3) : "\u2013");
    }
    html += fmt::format("<td class=\"n\"><b>{}</b></td></tr>\n", sample.terms ? figure(sample.error, 3) : "\u2013");
  }
  return html + "</tbody></table></div>\n";
}

/// The paper lists its criteria in decreasing importance.
void say_of_weights(PaperFigure& fig) {
  const auto terms = named_terms({});
  const bool decreasing = std::is_sorted(terms.begin(), terms.end(),
                                         [](const NamedTerm& a, const NamedTerm& b) { return a.weight > b.weight; });
  std::string list;
  for (const NamedTerm& term : terms) {
    list += fmt::format("{}{} {:.2f}", list.empty() ? "" : ", ", term.name, term.weight);
  }
  fig.say("weights", decreasing, fmt::format("The criteria weigh less in the paper's order: {}.", list),
          " The weight of location was raised on other scenes: where a second thing has the landmark's colour, nothing "
          "else tells them apart.");
  fig.claims.back().of_scenes = false;
}

/// The widest of the landmark's own regions; nothing if it is not in the image.
const Region* own_region(const RealImage& image, std::size_t landmark) {
  const Region* widest = nullptr;
  for (std::size_t i = 0; i < image.regions.size(); ++i) {
    if (!is_of(image.truths[i], landmark)) continue;
    if (widest == nullptr || image.regions[i].width() > widest->width()) widest = &image.regions[i];
  }
  return widest;
}

}  // namespace

PaperFigure figure_4(const PaperData& data) {
  PaperFigure fig{"4", "An input image and the models of the two objects", {}, {}, {}};
  const Tour& tour = data.shown.tour;
  constexpr std::size_t kFrame = 0;
  fig.add("<div class=\"pictures\">");
  fig.add_picture("fig04_input.png", real_picture(tour, kFrame),
                  fmt::format("input: image 1 of {}, {}", tour.frames.size(), real_picture_name(tour)));
  const PictureView raised = raised_view(tour, kFrame);
  const std::size_t last = data.shown.snapshot(tour.frames.size());
  fig.add_picture("fig04_truth.png",
                  draw_picture(true_blocks(tour, data.shown.models.given.size()), raised, PictureStyle::kShaded),
                  "the true blocks, from a raised viewpoint");
  Csv csv("algorithm,landmark,area_m2,z_min_m,z_max_m,recklessness,paranoia,iou");
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const Algorithm& algorithm = algorithms()[a];
    const std::vector<Solid> world = world_of(tour, data.shown.models, algorithm, last);
    fig.add_picture(fmt::format("fig04_{}.png", algorithm.key), draw_picture(world, raised, PictureStyle::kShaded),
                    escaped(algorithm.label));
    for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
      const Score& score = data.shown.scores[a][landmark][last];
      csv.row({std::string(algorithm.key), landmark_name(landmark), csv_number(area(world[landmark].footprint), 6),
               csv_number(world[landmark].z_min), csv_number(world[landmark].z_max), csv_number(score.recklessness),
               csv_number(measure_of(score, &Score::paranoia)), csv_number(score.iou)});
    }
  }
  fig.add("</div>");
  if (const std::string empty = shown_empty(data); !empty.empty()) fig.add("<p class=\"note\">" + empty + "</p>");
  fig.add_file("fig04.csv", csv.text());
  return fig;
}

PaperFigure figure_6(const PaperData& data) {
  PaperFigure fig{"6", "Real and rendered regions from a novel viewpoint, and what is compared", {}, {}, {}};
  const Tour& tour = data.shown.tour;
  const std::size_t images = tour.frames.size() / 2;
  const std::size_t frame = frame_with_both(tour, images + tour.frames.size() / 9);
  RegionRenderer renderer(tour.scene.camera);
  fig.add(
      fmt::format("<p>Models of the first {} images; the real image is number {}, which they have not seen. Black: "
                  "boxes that the camera reports. Magenta, dashed: what the model renders.</p><div "
                  "class=\"pictures\">",
                  images, frame + 1));
  fig.add_picture("fig06_real.png", real_picture(tour, frame), "real image, " + real_picture_name(tour));
  fig.add_picture("fig06_segmented.png", segmentation(tour, frame), "its regions");
  std::vector<TermSample> samples;
  Csv csv("algorithm,landmark,hue,rgb,width,height,shape,location,error");
  double right = 0;
  double wrong = 1;
  for (const Algorithm& algorithm : algorithms()) {
    const auto world = world_of(tour, data.shown.models, algorithm, data.shown.snapshot(images));
    const auto both = reacquire_both(tour, renderer, world, frame);
    fig.add_picture(fmt::format("fig06_{}.png", algorithm.key), rendered_picture(tour, world, frame, both),
                    fmt::format("{}: red {}, yellow {}", escaped(algorithm.label), error_text(both[kRedLandmark]),
                                error_text(both[kYellowLandmark])));
    for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
      TermSample& sample = samples.emplace_back(TermSample{algorithm.label, landmark, std::nullopt, 1});
      const Region* own = own_region(tour.images[frame], landmark);
      std::vector<std::string> fields{std::string(algorithm.key), landmark_name(landmark)};
      if (own != nullptr && both[landmark].rendered) {
        sample.terms = reacquisition_terms(*own, *both[landmark].rendered, tour.scene.camera.width);
        sample.error = reacquisition_error(*sample.terms);
        right = std::max(right, sample.error);
        for (const Region& other : tour.images[frame].regions) {
          if (other.signature == own->signature) continue;
          const auto terms = reacquisition_terms(other, *both[landmark].rendered, tour.scene.camera.width);
          wrong = std::min(wrong, reacquisition_error(terms));
        }
      }
      for (const NamedTerm& term : named_terms(sample.terms.value_or(ReacquisitionTerms{}))) {
        fields.push_back(sample.terms && term.value ? csv_number(*term.value) : "");
      }
      fields.push_back(sample.terms ? csv_number(sample.error) : "");
      csv.row(fields);
    }
  }
  fig.add("</div>" + terms_table(samples));
  say_of_weights(fig);
  fig.say(
      "criteria", right < wrong,
      fmt::format("The criteria tell the landmarks from everything else in this image: the largest error of a right "
                  "pair is {}, the least of a wrong one {}.",
                  figure(right, 3), figure(wrong, 3)),
      " A model that is far off is nearer to something else.");
  fig.add_file("fig06.csv", csv.text());
  return fig;
}

PaperFigure figure_8(const PaperData& data) {
  PaperFigure fig{"8", "Two images, their segmentations, and the reconstructions projected", {}, {}, {}};
  const Tour& tour = data.shown.tour;
  RegionRenderer renderer(tour.scene.camera);
  Csv csv("image,algorithm,landmark,error,match_confidence,outcome");
  for (const std::size_t frame :
       {frame_with_both(tour, tour.frames.size() / 4), frame_with_both(tour, tour.frames.size() * 4 / 5)}) {
    fig.add("<div class=\"pictures\">");
    fig.add_picture(fmt::format("fig08_{}_real.png", frame + 1), real_picture(tour, frame),
                    fmt::format("image {}, {}", frame + 1, real_picture_name(tour)));
    fig.add_picture(fmt::format("fig08_{}_segmented.png", frame + 1), segmentation(tour, frame), "its regions");
    for (const Algorithm& algorithm : algorithms()) {
      const auto world = world_of(tour, data.shown.models, algorithm, data.shown.snapshot(tour.frames.size()));
      const auto both = reacquire_both(tour, renderer, world, frame);
      fig.add_picture(fmt::format("fig08_{}_{}.png", frame + 1, algorithm.key),
                      rendered_picture(tour, world, frame, both),
                      fmt::format("{}: red {}, yellow {}", escaped(algorithm.label), error_text(both[kRedLandmark]),
                                  error_text(both[kYellowLandmark])));
      for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
        const auto& match = both[landmark].match;
        csv.row({std::to_string(frame + 1), std::string(algorithm.key), landmark_name(landmark),
                 match ? csv_number(match->error) : "", match ? csv_number(match->match_confidence) : "",
                 std::string(name(both[landmark].outcome))});
      }
    }
    fig.add("</div>");
  }
  if (const std::string empty = shown_empty(data); !empty.empty()) fig.add("<p class=\"note\">" + empty + "</p>");
  fig.add_file("fig08.csv", csv.text());
  const auto cylinder = algorithm_index("cylinder");
  const auto carving = algorithm_index("carving");
  if (cylinder && carving) {
    const double by_cylinder = mean(data.table[*cylinder].right_errors);
    const double by_carving = mean(data.table[*carving].right_errors);
    fig.say("recognition", by_cylinder < by_carving,
            fmt::format(
                "Triangulation yields better recognition than space carving: in the decisions of Figure 10 the mean "
                "error of a right match is {} by cylinders and {} by carving.",
                figure(by_cylinder, 3), figure(by_carving, 3)),
            std::string());
    if (const auto hybrid = algorithm_index("hybrid")) {
      const double by_hybrid = mean(data.table[*hybrid].right_errors);
      fig.compare("hybrid", by_hybrid < std::min(by_cylinder, by_carving),
                  fmt::format("By the hybrid the mean error of a right match is {}.", figure(by_hybrid, 3)));
    }
  }
  return fig;
}

}  // namespace fencepost::host
