// Boxes, odometry and truth that nobody here made, through the product: tests/results/world.md.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/studies/common/median.hpp"
#include "tests/studies/common/study.hpp"
#include "tests/studies/world/car_run.hpp"
#include "tests/studies/world/dlr_run.hpp"
#include "tests/studies/world/kitti_run.hpp"

namespace fencepost::test {
namespace {

struct Request {
  std::string data = FENCEPOST_SHARED_DIR "/data/world";
  std::vector<std::string> settings;
  std::vector<std::string> correct = {"off", "auto", "on"};
  std::string only;

  /// In force during one row of a table.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> settings_with(const std::string& correction) const {
    std::vector<std::pair<std::string, std::string>> all = {{"correct.pose", correction}};
    for (const std::string& setting : settings) all.push_back(key_and_value(setting));
    return all;
  }
};

/// One row of a table for each way of correcting, or for several in a row that give the same `cells`.
template <class Cells>
void print_rows(const Request& request, std::string_view name, const Cells& cells) {
  std::string corrections;
  std::string last;
  const auto print_last = [&] {
    if (!corrections.empty()) print(fmt::format("| {} | {} | {} |\n", name, corrections, last));
  };
  for (const std::string& correct : request.correct) {
    std::string now = cells(correct);
    if (now == last) {
      corrections += ", " + correct;
      continue;
    }
    print_last();
    corrections = correct;
    last = std::move(now);
  }
  print_last();
}

std::string median_percent(std::vector<double> values) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  return fmt::format("{:.0f}", 100 * values[values.size() / 2]);
}

/// m, of the world: farther off at the end, a drive counts as lost.
constexpr double kLost = 2;

struct KittiRow {
  const char* what;
  KittiConfigured configured{};
};

std::string cells_of(const KittiRow& row, const KittiScore& score) {
  const auto lost = std::ranges::count_if(score.end_error, [](double error) { return error > kLost; });
  const double ten_minutes = score.seconds / 600;
  const std::string ends =
      lost == 0 ? "0" : fmt::format("{} of {}, to {:.1f} m", lost, score.drives, std::ranges::max(score.end_error));
  const std::string moving = row.configured.identity ? fmt::format(" ({} moving)", score.moving) : "";
  return fmt::format("{} of {} | {}{} | {} | {} / {} % | {:.1f} | {:.1f}", score.found, score.found + score.missed,
                     score.phantoms, moving, ends, median_percent(score.recklessness), median_percent(score.paranoia),
                     static_cast<double>(score.stops) / ten_minutes,
                     static_cast<double>(score.empty_stops) / ten_minutes);
}

void measure_kitti(const Request& request) {
  const std::vector<std::string> drives = kitti_drives(request.data + "/kitti");
  if (drives.empty()) {
    print("NOT MEASURED: " + request.data + "/kitti is not on this machine\n");
    return;
  }
  constexpr double kDegree = std::numbers::pi / 180;
  const std::vector<KittiRow> rows = {{"identity, pitch 0", {0.0}},
                                      {"identity, pitch +1 deg", {kDegree}},
                                      {"identity, pitch -1 deg", {-kDegree}},
                                      {"identity, pitch unknown", {}},
                                      {"one signature, pitch 0", {0.0, false}},
                                      {"one signature, pitch unknown", {std::nullopt, false}},
                                      {"one signature with ids, pitch 0", {0.0, false, false, true}},
                                      {"one signature with ids, pitch unknown", {std::nullopt, false, false, true}},
                                      {"detector, pitch 0", {0.0, false, true}},
                                      {"detector, pitch unknown", {std::nullopt, false, true}}};
  print(
      "\n| KITTI, configured | `correct.pose` | found | phantoms | lost | R / P | STOPs | empty |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const KittiRow& row : rows) {
    if (std::string_view(row.what).find(request.only) == std::string_view::npos) continue;
    print_rows(request, row.what, [&](const std::string& correct) {
      return cells_of(row, run_kitti(drives, row.configured, request.settings_with(correct)));
    });
  }
}

void measure_dlr(const Request& request) {
  const std::string file = request.data + "/dlr/map.circles.first_half";
  if (!std::filesystem::exists(file)) {
    print("NOT MEASURED: " + file + " is not on this machine\n");
    return;
  }
  constexpr std::size_t kSteps = 100;  // about 15 m
  constexpr double kWorse = 1.05;      // share of the scatter without correction
  print(
      "\n| DLR, configured | `correct.pose` | windows | scatter, median | worst | worse than off "
      "|\n|---|---|---|---|---|---|\n");
  for (const bool identity : {true, false}) {
    const std::string name = identity ? "DLR, identity" : "DLR, one signature";
    if (name.find(request.only) == std::string::npos) continue;
    const std::vector<double> off = run_dlr(file, kSteps, identity, request.settings_with("off"));
    const auto cells = [&](const std::vector<double>& windows) {
      std::size_t worse = 0;
      for (std::size_t i = 0; i < off.size(); ++i) worse += windows[i] > kWorse * off[i] ? 1U : 0U;
      return fmt::format("{} | {:.2f} m | {:.2f} m | {} of {}", windows.size(), median_of(windows),
                         std::ranges::max(windows), worse, windows.size());
    };
    print_rows(request, name, [&](const std::string& correct) {
      return cells(run_dlr(file, kSteps, identity, request.settings_with(correct)));
    });
    if (identity) print("| " + name + " | a textbook filter | " + cells(run_dlr_by_textbook(file, kSteps)) + " |\n");
  }
}

void measure_cycloid(const Request& request) {
  const std::string folder = request.data + "/cycloid";
  if (!std::filesystem::exists(folder)) {
    print("NOT MEASURED: " + folder + " is not on this machine\n");
    return;
  }
  constexpr const char* kName = "cycloid, one signature";
  if (std::string_view(kName).find(request.only) == std::string_view::npos) return;
  print(
      "\n| cycloid, configured | `correct.pose` | cones | of them off, rms | objects | end off |\n"
      "|---|---|---|---|---|---|\n");
  print_rows(request, kName, [&](const std::string& correct) {
    const CycloidScore score = run_cycloid(folder, request.settings_with(correct));
    return fmt::format("{} of 8 | {:.2f} m | {} | {:.2f} m", score.cones, score.rms, score.objects, score.end_error);
  });
}

void measure_victoria(const Request& request) {
  const std::string folder = request.data + "/victoria";
  if (!std::filesystem::exists(folder)) {
    print("NOT MEASURED: " + folder + " is not on this machine\n");
    return;
  }
  bool begun = false;
  for (const bool rows : {false, true}) {
    const std::string name = rows ? "Victoria Park, rows" : "Victoria Park, bearings and widths";
    if (name.find(request.only) == std::string::npos) continue;
    if (!begun) {
      print(
          "\n| Victoria Park, configured | `correct.pose` | path off GPS, rms | worst | objects |\n"
          "|---|---|---|---|---|\n");
    }
    begun = true;
    print_rows(request, name, [&](const std::string& correct) {
      const VictoriaScore score = run_victoria(folder, rows, request.settings_with(correct));
      return fmt::format("{:.1f} m | {:.1f} m | {}", score.rms, score.worst, score.objects);
    });
  }
}

bool run(const Request& request) {
  measure_kitti(request);
  measure_dlr(request);
  measure_cycloid(request);
  measure_victoria(request);
  return true;
}

void options(CLI::App& app, Request& request) {
  app.add_option("--data", request.data, "the folder with the sources")->capture_default_str();
  app.add_option("--set", request.settings, "KEY=VALUE, beside the defaults");
  app.add_option("--correct", request.correct, "off, auto, on")->delimiter(',');
  app.add_option("--only", request.only, "rows whose first column has this in it");
}

constexpr Study<Request> kStudy = {"world_study", "Recordings of others through the product.", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
