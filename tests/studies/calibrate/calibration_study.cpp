// Calibration from logs of random drives: how far off, and whether the stated sigmas are true.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/calibrate/calibrate.hpp"
#include "tests/studies/calibrate/calibration_drive.hpp"
#include "tests/studies/common/study.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds seeds{200, 20'001};
  DriveOptions drive;
  double most = 1;
  bool judge = true;
  bool verbose = false;
};

/// The sums of one number over all logs.
struct Column {
  double sum = 0;
  double square = 0;
  double configured_square = 0;
  double sigma_square = 0;
  std::size_t covered = 0;  ///< by +-1.96 sigma
  std::size_t n = 0;
  std::string_view unit;
};

/// The maximum error of a number, as rms. The focal length is a share.
struct Target {
  std::string_view key;
  double most;
};
constexpr std::array<Target, 4> kTargets = {{{"focal_length", 0.005}, {"yaw", 0.15}, {"pitch", 0.3}, {"latency", 4}}};
constexpr double kMinCovered = 0.90;
constexpr double kMaxCovered = 0.98;

using Columns = std::map<std::string_view, Column>;

constexpr std::string_view kPads = "pads";

/// Adds one number of a log.
void add(Column& column, double configured, double found, double sigma, double truth, double unit) {
  const double error = (found - truth) / unit;
  column.sum += error;
  column.square += error * error;
  column.configured_square += std::pow((configured - truth) / unit, 2);
  column.sigma_square += std::pow(sigma / unit, 2);
  column.covered += std::abs(found - truth) <= 1.96 * sigma ? 1U : 0U;
  ++column.n;
}

void add(const CalibrationDrive& drive, const host::Finding& finding, Columns& columns) {
  Column& column = columns[finding.key];
  column.unit = finding.unit;
  if (finding.held) return;
  const double truth = true_value(drive, finding.key);
  add(column, finding.configured, finding.found, finding.sigma, truth, finding.key == "focal_length" ? truth : 1);
}

bool judge(const Request& request, const Columns& columns, unsigned logs) {
  bool reached = true;
  for (const Target& target : kTargets) {
    const Column& column = columns.at(target.key);
    const double rms = std::sqrt(column.square / static_cast<double>(std::max<std::size_t>(1, column.n)));
    const double share = static_cast<double>(column.covered) / static_cast<double>(std::max<std::size_t>(1, column.n));
    constexpr unsigned kEnough = 100;  // logs; fewer say nothing of coverage
    const bool honest = logs < kEnough || (share >= kMinCovered && share <= kMaxCovered);
    if (column.n == logs && rms <= target.most * request.most && honest) continue;
    fmt::print(stderr, "calibration_study: {}: {} of {} logs, rms {:.4f} (allowed {:.4f}), {:.1f} % covered\n",
               target.key, column.n, logs, rms, target.most * request.most, 100 * share);
    reached = false;
  }
  return reached;
}

bool run(const Request& request) {
  Columns columns;
  std::size_t refused = 0;
  for (unsigned i = 0; i < request.seeds.scenes; ++i) {
    DriveOptions options = request.drive;
    options.seed = request.seeds.first + i;
    const CalibrationDrive drive = calibration_drive(options);
    const host::CalibrateOutcome outcome = host::calibrate(drive.log, fmt::format("seed {}", options.seed), {});
    if (!outcome.calibration) {
      ++refused;
      print(fmt::format("- {}\n", outcome.refusal));
      continue;
    }
    if (request.verbose) {
      const host::Calibration& c = *outcome.calibration;
      print(fmt::format("{}: {} frames, {} objects, edges {:.2f} -> {:.2f} px, rows {:.2f} -> {:.2f} px\n",
                        options.seed, c.frames, c.objects.size(), c.before.columns_px, c.after.columns_px,
                        c.before.rows_px, c.after.rows_px));
    }
    for (const host::FoundPad& pad : outcome.calibration->pads) {
      columns[kPads].unit = "px";
      add(columns[kPads], pad.configured, pad.found, pad.sigma, options.pad, 1);
      if (!request.verbose) continue;
      print(fmt::format("{} pad of {} found {:.2f} +- {:.2f}\n", options.seed, pad.signature, pad.found, pad.sigma));
    }
    for (const host::Finding& finding : outcome.calibration->findings) {
      add(drive, finding, columns);
      if (!request.verbose) continue;
      print(fmt::format("{} {} true {:.3f} configured {:.3f} found {:.3f} +- {:.3f}{}\n", options.seed, finding.key,
                        true_value(drive, finding.key), finding.configured, finding.found, finding.sigma,
                        finding.observed ? "" : " not observed"));
    }
  }
  print(fmt::format("{} logs from seed {}, {} refused\n\n", request.seeds.scenes, request.seeds.first, refused));
  print(
      "| number | logs | configured, rms | found, rms | found, mean | stated sigma | 95 % intervals that have the "
      "truth |\n");
  print("|---|---|---|---|---|---|---|\n");
  for (const auto& [key, column] : columns) {
    const double n = static_cast<double>(std::max<std::size_t>(1, column.n));
    const double shown = key == "focal_length" ? 100 : 1;
    print(fmt::format("| {}, {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} % |\n", key,
                      key == "focal_length" ? "%" : column.unit, column.n,
                      shown * std::sqrt(column.configured_square / n), shown * std::sqrt(column.square / n),
                      shown * column.sum / n, shown * std::sqrt(column.sigma_square / n),
                      100 * static_cast<double>(column.covered) / n));
  }
  return !request.judge || (refused == 0 && judge(request, columns, request.seeds.scenes));
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "random drives", "--logs");
  app.add_option("--blocks", request.drive.blocks)->check(CLI::Range(1, 6))->capture_default_str();
  app.add_option_function<int>(
         "--straights",
         [&request](int count) {
           request.drive.motion = Motion::kToAndFro;
           request.drive.straights = count;
         },
         "the longer drive: straight on to and fro so many times, 10 s each")
      ->check(CLI::Range(1, 40));
  app.add_option("--fisheye", request.drive.fisheye, "degrees across of an equidistant lens; 0: a Pixy2's")
      ->check(CLI::Range(0, 150))
      ->capture_default_str();
  app.add_option("--noise", request.drive.noise, "times that of level 1")->capture_default_str();
  app.add_option("--drift", request.drive.drift, "times 1 %, 1 degree/m")->capture_default_str();
  app.add_option("--pad", request.drive.pad, "px that boxes are too wide on each side")->capture_default_str();
  app.add_option("--most", request.most, "times the targets that is good enough")->capture_default_str();
  app.add_flag("!--no-judgement", request.judge, "print only");
  app.add_flag("--verbose", request.verbose, "each log");
}

constexpr Study<Request> kStudy = {"calibration_study", "Calibration from logs of random drives.", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
