#include "host/paper/paper.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>

#include "host/jobs/jobs.hpp"
#include "host/report/markup.hpp"
#include "host/report/page_parts.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;

constexpr std::string_view kMoreStyle = R"css(
.pictures { display: flex; flex-wrap: wrap; gap: 12px; margin: 0 0 10px; }
.picture { margin: 0; width: 240px; max-width: 100%; }
.picture img { display: block; width: 100%; height: auto; border: 1px solid var(--rule); border-radius: 4px; }
.picture figcaption { color: var(--soft); font-size: 13px; margin-top: 3px; }
.plans { display: flex; flex-wrap: wrap; gap: 12px; margin: 0 0 10px; }
.plan { width: 240px; max-width: 100%; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(430px, 100%), 1fr)); gap: 14px 20px; margin: 0 0 10px; }
.plan svg, .chart svg { display: block; width: 100%; height: auto; }
.plan svg text, .chart svg text { font-size: 13px; }
.claims { list-style: none; margin: 10px 0 0; padding: 0; }
.claims li { margin: 0 0 6px; padding-left: 92px; text-indent: -92px; }
.claims b { display: inline-block; width: 82px; margin-right: 10px; text-indent: 0; text-align: center; border-radius: 3px;
  font-size: 12.5px; padding: 1px 0; }
.claims .matches { background: #d8efdc; color: #14532d; }
.claims .differs { background: #fde3d0; color: #7c2d12; }
.claims .beyond { background: #e4e0f5; color: #3b2a7a; }
.claims .worse { background: #eceff1; color: #37474f; }
.claims small { color: var(--soft); white-space: nowrap; }
tr.soft td { color: var(--soft); }
table.decisions th { white-space: normal; }
td small { display: block; font-size: 12px; color: var(--soft); white-space: nowrap; }
.csv { font-size: 13px; margin: 8px 0 0; }
)css";

std::string_view word(ClaimKind kind) {
  switch (kind) {
    case ClaimKind::kMatches: return "matches";
    case ClaimKind::kDiffers: return "differs";
    case ClaimKind::kBeyond: return "beyond";
    case ClaimKind::kWorse: return "worse";
  }
  return "";
}

std::string in_single_scenes(const Claim& claim) {
  if (claim.scenes == 0) return {};
  return fmt::format(" <small>Holds in {} of {} scenes taken alone.</small>", claim.holds, claim.scenes);
}

std::string claim_list(const PaperFigure& figure, bool with_number) {
  std::string html;
  for (const Claim& claim : figure.claims) {
    const bool only_mean = claim.kind == ClaimKind::kMatches && 2 * claim.holds < claim.scenes;
    html += fmt::format("<li><b class=\"{0}\">{1}</b>{2}{3}{4}</li>\n", only_mean ? "worse" : word(claim.kind),
                        only_mean ? "on average" : word(claim.kind),
                        with_number ? fmt::format("<a href=\"#fig{0}\">Figure {0}</a>: ", figure.number) : "",
                        escaped(claim.text), in_single_scenes(claim));
  }
  return html;
}

std::string figure_section(const PaperFigure& figure) {
  std::string html = fmt::format("<section id=\"fig{0}\"><h2>Figure {0}: {1}</h2>\n{2}", figure.number,
                                 escaped(figure.title), figure.html);
  if (!figure.claims.empty()) html += "<ul class=\"claims\">" + claim_list(figure, false) + "</ul>\n";
  for (const PaperFile& file : figure.files) {
    if (file.name.ends_with(".csv")) {
      html += fmt::format("<p class=\"csv\">Numbers: <a href=\"{0}\">{0}</a></p>\n", file.name);
    }
  }
  return html + "</section>\n";
}

std::string summary(const std::vector<PaperFigure>& figures) {
  std::string html = "<section><h2>What matches the paper, what differs</h2><ul class=\"claims\">\n";
  for (const ClaimKind kind : {ClaimKind::kMatches, ClaimKind::kDiffers, ClaimKind::kBeyond, ClaimKind::kWorse}) {
    for (const PaperFigure& figure : figures) {
      PaperFigure only{figure.number, {}, {}, {}, {}};
      for (const Claim& claim : figure.claims) {
        if (claim.kind == kind) only.claims.push_back(claim);
      }
      html += claim_list(only, true);
    }
  }
  return html + "</ul></section>\n";
}

std::string what_it_is_of(const PaperData& data) {
  if (!data.run.empty()) {
    return fmt::format(
        "Figures 4 to 14, each made by the robot\u2019s own code on one run: {}, {} images. The scene\u2019s first two "
        "objects "
        "are the landmarks, called red and yellow here; {}",
        escaped(data.run), data.shown.tour.frames.size(),
        data.shown.tour.photograph ? "real images are the photographs of the run."
                                   : "images are drawn from the scene, the run has only regions.");
  }
  return fmt::format(
      "Figures 4 to 14, each made by the robot\u2019s own code on simulated blocks: 176x144 px, 43\u00b0, 75 views "
      "around, "
      "edges off by 1.5 px, 5 % of the segments damaged, poses by 4 mm and 0.4\u00b0. The sequence that is drawn has "
      "seed {}, "
      "means are over {} more.",
      data.seed, data.noisy.size());
}

std::string page(const std::vector<PaperFigure>& figures, const PaperData& data, const PaperOptions& options) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>"
      "<title>The paper\u2019s evaluation</title>\n<style>" +
      std::string(kStylesheet) + std::string(kMoreStyle) + "</style></head>\n<body><main>\n";
  html +=
      "<header><h1>The paper\u2019s evaluation</h1><p>Region-based monocular reconstruction: does it miss the "
      "points? " +
      what_it_is_of(data) +
      " The paper\u2019s own images are not here: what can be compared is what its words and its table "
      "say.</p></header>\n";
  html += summary(figures);
  html +=
      "<section><h2>Whose models these are</h2><p>Cylinders as printed, plane sheaves and space carving are the "
      "paper\u2019s "
      "Algorithms 1 to 3; they are always given the owner of each region and which ends are hidden. So is every other "
      "model "
      "but "
      "the one with the robot\u2019s own flags, which has nothing but the log.</p></section>\n";
  for (const PaperFigure& figure : figures) html += figure_section(figure);
  html += "<footer>Written by " + escaped(options.generator) + ". Lengths in metres, map frame.</footer>\n";
  return html + "</main></body></html>\n";
}

std::vector<PaperFigure> draw_figures(const PaperData& data) {
  std::vector<PaperFigure> figures;
  for (const auto make : {figure_4, figure_5, figure_6, figure_7, figure_8, figure_9, figure_10, figure_11, figure_12,
                          figure_12b, figure_13, figure_14}) {
    figures.push_back(make(data));
  }
  return figures;
}

using Claims = std::map<std::string, bool>;  // by figure and key: is it good?

Claims claims_of(const std::vector<PaperFigure>& figures) {
  Claims claims;
  for (const PaperFigure& figure : figures) {
    for (const Claim& claim : figure.claims) claims[figure.number + "/" + claim.key] = claim.good();
  }
  return claims;
}

// Each claim once more in each of the scenes alone, on as many cores as there are. The result does not depend on them.
void count_in_single_scenes(std::vector<PaperFigure>& figures, const PaperOptions& options, const Progress& progress) {
  std::vector<Claims> found(options.single_scenes);
  run_jobs(found.size(), all_cores(), [&](std::size_t i) {
    found[i] = claims_of(draw_figures(evaluate_scene(options.seed + 1 + i)));
    progress("scenes taken alone", kWorkOfSingleScene / static_cast<double>(all_cores()));
  });
  for (PaperFigure& figure : figures) {
    for (Claim& claim : figure.claims) {
      if (!claim.of_scenes) continue;
      for (const Claims& scene : found) {
        const auto one = scene.find(figure.number + "/" + claim.key);
        if (one == scene.end()) continue;
        ++claim.scenes;
        if (one->second) ++claim.holds;
      }
    }
  }
}

}  // namespace

std::vector<PaperFile> write_paper(const PaperOptions& options) {
  double work = kWorkOfShown;
  if (!options.run) {
    work += kWorkOfMeanScene * static_cast<double>(options.mean_scenes) + static_cast<double>(options.scenes) +
            kWorkOfSingleScene * static_cast<double>(options.single_scenes) / static_cast<double>(all_cores());
  }
  double done = 0;
  std::mutex telling;
  const Progress progress = [&](std::string_view what, double more) {
    const std::lock_guard lock(telling);
    done += more;
    if (options.progress) options.progress(what, done, work);
  };
  const PaperData data = options.run ? evaluate_run(options.run->name, options.run->tour, progress)
                                     : evaluate_paper(options.seed, options.mean_scenes, options.scenes, progress);
  std::vector<PaperFigure> figures = draw_figures(data);
  if (!options.run) count_in_single_scenes(figures, options, progress);
  std::vector<PaperFile> files{{"index.html", page(figures, data, options)}};
  for (PaperFigure& figure : figures) {
    files.insert(files.end(), std::make_move_iterator(figure.files.begin()),
                 std::make_move_iterator(figure.files.end()));
  }
  return files;
}

}  // namespace fencepost::host
