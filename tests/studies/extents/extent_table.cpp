// The hybrid on things that are longer than the image is wide. Prints Markdown: recklessness and paranoia of the seen
// part, phantoms, and how long the outline is. Same seeds, same table.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "host/evaluate/evaluate.hpp"
#include "host/evaluate/metrics.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/common/study.hpp"
#include "tests/studies/extents/extent_scene.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds seeds{10, 1};
  std::vector<std::string> drives;
  std::vector<std::string> levels{"1"};
  std::vector<double> lengths{0.4, 0.8, 1.6, 3.0};
  std::vector<double> degrees{43};
  std::vector<double> depths{0.02, 0.1, 0};  ///< 0: as deep as long
  std::string profile = "full";
  std::string correct;  ///< correct.pose; empty: as delivered
};

/// Sums over scenes.
struct Row {
  double runs = 0;
  double recklessness = 0;
  double paranoia = 0;
  double phantoms = 0;
  double missed = 0;
};

const host::ModelResult* hybrid_of(const host::ResultDocument& result, std::uint32_t id) {
  for (const host::ObjectResult& object : result.objects) {
    if (object.id != id) continue;
    for (const host::ModelResult& model : object.models) {
      if (model.name == "hybrid") return &model;
    }
  }
  return nullptr;
}

void run_one(const ExtentCase& wanted, const Request& request, Row& row) {
  const host::Scene scene = extent_scene(wanted);
  std::string log;
  const auto summary = host::simulate(scene, [&](std::string_view line) { log += line; });
  if (!summary.ok()) throw std::runtime_error(summary.error());
  if (!request.correct.empty())
    log = with_setting(std::move(log), {sensor::Text("correct.pose"), sensor::Text(request.correct)});
  host::EvaluateOptions options;
  options.profile = request.profile;
  const host::EvaluateOutcome outcome = host::evaluate(log, "seed " + std::to_string(wanted.seed), scene, options);
  if (outcome.replay.unreadable) throw std::runtime_error(outcome.replay.unreadable->message);
  ++row.runs;
  row.phantoms += static_cast<double>(outcome.evaluation.phantoms.size());
  const host::ObjectEvaluation& object = outcome.evaluation.objects.front();
  const host::ModelResult* model = object.found ? hybrid_of(outcome.replay.result, object.found->id) : nullptr;
  if (model == nullptr || model->geometry.empty()) {
    row.recklessness += 1;
    row.paranoia += 1;
    ++row.missed;
    return;
  }
  row.recklessness += host::score(model->geometry, seen_of(wanted, scene)).recklessness;
  row.paranoia += host::score(model->geometry, unseen_with(wanted, scene)).paranoia;
}

void print_rows(const Request& request, const DriveText& drive, const std::string& level, double degrees) {
  print(fmt::format("\n{}, level {}, {} degrees: R / P (phantoms a run, not found)\n\n| length |", drive.name, level,
                    degrees));
  for (const double depth : request.depths) {
    print(depth > 0 ? fmt::format(" {} m deep |", depth) : std::string(" square |"));
  }
  print("\n|---|");
  for (std::size_t i = 0; i < request.depths.size(); ++i) print("---|");
  print("\n");
  for (const double length : request.lengths) {
    print(fmt::format("| {} m |", length));
    for (const double depth : request.depths) {
      Row row;
      for (unsigned i = 0; i < request.seeds.scenes; ++i) {
        ExtentCase wanted;
        wanted.drive = drive.drive;
        wanted.length = length;
        wanted.depth = depth > 0 ? depth : length;
        wanted.degrees = degrees;
        wanted.level = level;
        wanted.seed = request.seeds.first + i;
        run_one(wanted, request, row);
      }
      print(fmt::format(" {:.0f} / {:.0f} ({:.1f}, {:.0f}) |", 100 * row.recklessness / row.runs,
                        100 * row.paranoia / row.runs, row.phantoms / row.runs, row.missed));
    }
    print("\n");
  }
}

bool run(const Request& request) {
  for (const std::string& level : request.levels) {
    for (const double degrees : request.degrees) {
      for (const DriveText& drive : kDrives) {
        const auto& wanted = request.drives;
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), drive.name) == wanted.end()) continue;
        print_rows(request, drive, level, degrees);
      }
    }
  }
  print(fmt::format("\n{} runs a cell from seed {}, profile {}\n", request.seeds.scenes, request.seeds.first,
                    request.profile));
  return true;
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "runs a cell", "--runs");
  add_levels_option(app, request.levels);
  add_profile_option(app, request.profile);
  app.add_option("--drives", request.drives, "around, circle, past, arc; default: all")->delimiter(',');
  app.add_option("--lengths", request.lengths, "m")->delimiter(',');
  app.add_option("--depths", request.depths, "m; 0: as deep as long")->delimiter(',');
  app.add_option("--degrees", request.degrees, "of view")->delimiter(',');
  app.add_option("--correct", request.correct, "the pose by landmarks: off, on, auto; default: as delivered");
}

constexpr Study<Request> kStudy = {"extent_table", "recklessness and paranoia of long things seen from near", options,
                                   run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
