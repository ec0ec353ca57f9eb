#include "tests/studies/drift/real_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <stdexcept>

#include "host/import/import.hpp"
#include "host/replay/replay.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/drift/textbook_filter.hpp"

namespace fencepost::test {
namespace {

constexpr std::uint8_t kRobots = 1;  // signature of all, where they are there
constexpr std::uint32_t kLasting = 8;

host::Imported import(const RealRun& run, const RealOptions& options, host::PoseSource poses) {
  host::MrclamOptions import;
  import.robot = run.robot;
  import.poses = poses;
  import.rows = options.rows;
  import.include_robots = import.robots_alike = options.robots;
  host::ImportResult imported = host::import_mrclam(run.folder, import);
  if (!imported.ok()) throw std::runtime_error(imported.error().message());
  return *imported;
}

// Every signature with the width that the import has given all landmarks.
std::string with_widths(const std::string& log) {
  std::string out;
  for (std::size_t at = 0; at < log.size();) {
    const std::size_t end = std::min(log.size(), log.find('\n', at) + 1);
    const std::string line = log.substr(at, end - at);
    at = end;
    const bool signature = line.starts_with("$FPSIG,");
    out += signature ? record::sealed(line.substr(1, line.find('*') - 1) +
                                      fmt::format(",{:.3f}", host::MrclamOptions{}.diameter)) +
                           "\n"
                     : line;
  }
  return out;
}

host::ResultDocument replay(const host::Imported& imported, const RealOptions& options, const std::string& name) {
  std::string log = options.widths ? with_widths(imported.log) : imported.log;
  for (const auto& [key, value] : options.settings)
    log = with_setting(log, record::Setting{std::string_view(key), std::string_view(value)});
  host::ReplayOptions replay_options;
  replay_options.profile = options.profile;
  host::ReplayOutcome outcome = host::replay(log, name, replay_options);
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  return std::move(outcome.result);
}

}  // namespace

const std::vector<RealRun>& real_runs() {
  static const std::vector<RealRun> kRuns = [] {
    const std::string data = FENCEPOST_SHARED_DIR "/data/";
    std::vector<RealRun> runs;
    for (const char* set : {"D1", "D4"}) {
      for (int robot = 1; robot <= 5; ++robot) {
        runs.push_back({std::string(set) + " robot " + std::to_string(robot), data + "mrclam_maps/" + set, robot,
                        std::string_view(set) == "D1"});
      }
    }
    for (const char* set : {"D2", "D3"}) {
      for (int robot = 1; robot <= 2; ++robot) {
        runs.push_back(
            {std::string(set) + " robot " + std::to_string(robot), data + "world/mrclam/" + set, robot, false});
      }
    }
    runs.push_back({"D6 robot 2", data + "mrclam/D6_R2", 2, false});
    runs.push_back({"D7 robot 2", data + "mrclam/D7_R2", 2, false});
    return runs;
  }();
  return kRuns;
}

bool present(const RealRun& run) { return std::filesystem::exists(run.folder); }
bool has_survey(const RealRun& run) {
  return std::filesystem::exists(run.folder + "/Robot" + std::to_string(run.robot) + "_Groundtruth.dat");
}

RealResult run_real(const RealRun& run, const RealOptions& options) {
  const host::Imported imported =
      import(run, options, options.surveyed ? host::PoseSource::kTruth : host::PoseSource::kOdometry);
  const host::ResultDocument found = replay(imported, options, run.name);
  RealResult result;
  std::vector<Pair> pairs;
  std::vector<Pair> textbook;
  std::map<std::uint8_t, host::Point> by_textbook;
  if (options.rows) by_textbook = run_textbook(imported.log, host::MrclamOptions{}.diameter / 2).landmarks;
  for (const host::SceneObject& landmark : imported.truth->objects) {
    std::string name = landmark.name;
    if (run.exchanged && name == "landmark 11") {
      name = "landmark 17";
    } else if (run.exchanged && name == "landmark 17") {
      name = "landmark 11";
    }
    const auto truth = std::find_if(imported.truth->objects.begin(), imported.truth->objects.end(),
                                    [&](const host::SceneObject& object) { return object.name == name; });
    const auto known = by_textbook.find(landmark.signature);
    if (known != by_textbook.end()) textbook.push_back({known->second, middle_of(*truth)});
    const host::ObjectResult* best = best_of(found, landmark.signature);
    if (best == nullptr) {
      ++result.missing;
    } else {
      pairs.push_back({best->models[0].circle->center, middle_of(*truth)});
    }
  }
  for (const host::ObjectResult& object : found.objects) {
    const bool robot = options.robots && object.signature == kRobots;
    if (!robot) ++result.objects;
    if (robot && object.views >= kLasting && object.models[0].circle) ++result.movers;
  }
  if (pairs.empty()) throw std::runtime_error(run.name + ": no landmark has a place");
  Alignment alignment = align(pairs);
  result.landmarks = std::move(alignment.errors);
  result.map = rms(result.landmarks);
  result.turned = alignment.turn;
  result.scale = alignment.scale;
  if (!textbook.empty()) result.textbook = rms(align(textbook).errors);
  if (has_survey(run)) {
    const host::Imported truth = import(run, options, host::PoseSource::kTruth);
    RealOptions uncorrected = options;
    uncorrected.settings = {{"correct.pose", "off"}};
    result.path = path_error(found.path, replay(truth, uncorrected, run.name).path);
  }
  return result;
}

}  // namespace fencepost::test
