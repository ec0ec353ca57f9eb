// Three laps of a WRO arena with wheels, with a gyro and with a steering angle: how good is the map, what was passed?
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "host/evaluate/evaluate.hpp"
#include "host/result/text.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/common/study.hpp"

namespace fencepost::test {
namespace {

constexpr double kWheelbase = 0.17;  // m
constexpr double kCounts = 2046;     // a metre: 360 a turn of a LEGO wheel of 56 mm
/// Maximum ratio of the R+P of a car's map to that of a robot with two encoders on the same path.
constexpr double kAllowed = 1.2;

struct Request {
  Seeds seeds{20, 7101};
  int laps = 3;
  std::string correct;            ///< correct.pose; empty: as delivered
  std::optional<double> width{};  ///< m, the pillars' configured width; nothing: as the scene has it
  bool blind_pitch = false;       ///< the camera's pitch is unknown: no range from rows
};

using Kind = host::SceneOdometry::Kind;

struct Robot {
  std::string name;
  Kind kind = Kind::kPoses;
  host::SceneNoise noise;
};

/// Errors of odometry that was calibrated: half a per cent of the way. Two encoders: the track to 0.5 % of a lap's turn
/// (0.8 rad/m on this path). A gyro as MPU-6050 modules are: to 0.3 %. A linkage with 1 degree of play: to 0.2 degrees
/// and 1 %.
std::vector<Robot> robots() {
  host::SceneNoise none;
  none.edge_px = 1;
  host::SceneNoise wheels = none;
  wheels.drift_scale = 0.005;
  wheels.drift_turn = 0.004;
  wheels.drift_walk = 0.002;
  host::SceneNoise gyro = none;
  gyro.drift_scale = 0.005;
  gyro.gyro_bias = 0.02;
  gyro.gyro_walk = 0.0003;
  gyro.gyro_noise = 0.003;
  gyro.gyro_scale = 0.003;
  host::SceneNoise steering = none;
  steering.drift_scale = 0.005;
  steering.steer_offset = 0.0035;
  steering.steer_scale = 0.01;
  steering.steer_backlash = 0.0175;
  return {{"wheels, exact", Kind::kPoses, none},      {"gyro, exact", Kind::kGyro, none},
          {"steering, exact", Kind::kSteering, none}, {"wheels, calibrated", Kind::kPoses, wheels},
          {"gyro, calibrated", Kind::kGyro, gyro},    {"steering, calibrated", Kind::kSteering, steering}};
}

/// Views after which a place is looked at.
constexpr std::array<std::uint32_t, 3> kEarly = {2, 4, 8};

struct Figures {
  double recklessness = 0;
  double paranoia = 0;
  double position = 0;                                     ///< m
  std::array<std::vector<double>, kEarly.size()> early{};  ///< m, errors of places known after kEarly views
  unsigned objects = 0;
  unsigned missed = 0;
  std::size_t passes = 0;
  std::size_t wrong = 0;
  [[nodiscard]] double both() const { return 100 * (recklessness + paranoia) / objects; }
};

host::Scene arena() {
  const auto scene = host::load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/wro_lap.json");
  if (!scene.ok()) throw std::runtime_error(scene.error().message());
  return *scene;
}

void look(const host::Evaluation& evaluation, const host::ResultDocument& result, Figures& figures) {
  for (const host::ObjectEvaluation& object : evaluation.objects) {
    if (object.cuts.empty()) continue;
    const host::Cut& end = object.cuts.back();
    for (const host::Cut& cut : object.cuts) {
      const auto at = std::find(kEarly.begin(), kEarly.end(), cut.views);
      if (at == kEarly.end() || !cut.position_error) continue;
      const auto i = static_cast<std::size_t>(at - kEarly.begin());
      figures.early[i].push_back(*cut.position_error);
    }
    ++figures.objects;
    figures.missed += object.missed ? 1U : 0U;
    figures.position += end.position_error.value_or(0);
    double recklessness = 1;
    double paranoia = 1;
    for (const host::ModelScore& model : end.models) {
      if (model.model != "hybrid") continue;
      recklessness = model.score.recklessness;
      paranoia = model.score.paranoia;
    }
    figures.recklessness += recklessness;
    figures.paranoia += paranoia;
  }
  figures.passes += result.passes.size();
  figures.wrong += host::wrong_sides(result, {{"red", true}, {"green", false}});
}

Figures drive(const Request& request, const Robot& robot) {
  Figures figures;
  request.seeds.each([&](unsigned seed) {
    host::Scene scene = arena();
    scene.seed = seed;
    std::get<host::WaypointPath>(scene.path).laps = request.laps;
    scene.odometry = {robot.kind, kCounts, kWheelbase};
    scene.noise = robot.noise;
    if (request.width) {
      for (host::SceneSignature& colour : scene.signatures)
        colour.width = static_cast<std::uint16_t>(std::lround(1e3 * *request.width));
    }
    if (request.blind_pitch) scene.camera.mount.pitch.reset();
    std::string log;
    const auto made = host::simulate(scene, [&](std::string_view line) { log += line; });
    if (!made.ok()) throw std::runtime_error(made.error());
    if (!request.correct.empty())
      log = with_setting(std::move(log), {sensor::Text("correct.pose"), sensor::Text(request.correct)});
    const host::EvaluateOutcome outcome = host::evaluate(log, "laps", scene, {});
    if (outcome.replay.unreadable) throw std::runtime_error(outcome.replay.unreadable->message);
    look(outcome.evaluation, outcome.replay.result, figures);
    return 0;
  });
  return figures;
}

bool run(const Request& request) {
  Tally tally;
  print(
      "| odometry | R % | P % | R+P % | of wheels | place mm | missed | passes | wrong side | after 2, 4, 8 views mm "
      "|\n");
  print("|---|---|---|---|---|---|---|---|---|---|\n");
  double wheels = 0;
  for (const Robot& robot : robots()) {
    const Figures figures = drive(request, robot);
    if (robot.kind == Kind::kPoses) wheels = figures.both();
    const double ratio = figures.both() / wheels;
    const std::string row = fmt::format(
        "| {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {} of {} | {} | {} |", robot.name,
        100 * figures.recklessness / figures.objects, 100 * figures.paranoia / figures.objects, figures.both(), ratio,
        1e3 * figures.position / figures.objects, figures.missed, figures.objects, figures.passes, figures.wrong);
    print(row);
    const std::string claim = robot.name + fmt::format(": R+P {:.2f} times that of wheels", ratio);
    print(tally.look(ratio <= kAllowed, claim));
    print(tally.look(figures.wrong == 0, robot.name + ": passed on a wrong side"));
    for (std::vector<double> errors : figures.early) {
      std::ranges::sort(errors);
      const double median = errors.empty() ? 0 : errors[errors.size() / 2];
      print(fmt::format(" {:.0f} ({})", 1e3 * median, errors.size()));
    }
    print(" |\n");
  }
  return tally.report(request.seeds);
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "drives");
  app.add_option("--laps", request.laps, "round the arena")->capture_default_str();
  app.add_option("--correct", request.correct, "the pose by landmarks: off, on, auto; default: as delivered");
  app.add_option("--width", request.width, "m, configured width of pillars, mean of all sides; 0: none");
  app.add_flag("--unknown-pitch", request.blind_pitch, "rows tell no range");
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  using namespace fencepost::test;
  return Study<Request>{"car_study", "A car's odometry against two encoders on the same laps", options, run}.main(argc,
                                                                                                                  argv);
}
