// Prints how true the ranges of `sectors` are on random approaches, a row a noise level. Fails where too many ranges
// end behind something.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "firmware/alert/sectors.hpp"
#include "host/replay/replay.hpp"
#include "host/simulate/truth.hpp"
#include "tests/studies/alerts/approach.hpp"
#include "tests/studies/common/study.hpp"

namespace fencepost::test {
namespace {

constexpr std::size_t kSectors = alert::kSectors;
constexpr double kSectorWidth = 2 * std::numbers::pi / static_cast<double>(kSectors);
constexpr double kLongest = alert::kLongestRange / 1000.0;
// A range is wrong if it ends so far (m) behind the nearest thing: a robot's margin is 0.05.
constexpr double kSlack = 0.02;
constexpr unsigned kEvery = 10;  // frames

struct Request {
  Seeds scenes{100, 1};
  std::vector<std::string> levels;
  std::string profile = "small";
  double at_least = 99.5;
  bool show = false;
};

struct Figures {
  unsigned long asked = 0;
  unsigned long known = 0;
  unsigned long in_view = 0;  ///< sectors that lie in the image from side to side
  unsigned long in_view_known = 0;
  unsigned long right = 0;   ///< of the known: nothing nearer
  unsigned long things = 0;  ///< sectors known with a thing in them, within kLongest
  double short_by = 0;       ///< m, of those
  unsigned long open = 0;    ///< sectors known without one
  double open_range = 0;
};

/// The nearest point of all footprints in each sector.
std::array<double, kSectors> true_ranges(const host::Scene& scene, const host::TimedPose& robot) {
  std::array<double, kSectors> ranges;
  ranges.fill(1e9);
  for (const host::SceneObject& object : scene.objects) {
    const host::LinearRing& ring = object.footprint.outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const host::Point a = ring[i];
      const host::Point b = ring[(i + 1) % ring.size()];
      const int steps = 1 + static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 0.002);
      for (int s = 0; s < steps; ++s) {
        const double share = static_cast<double>(s) / steps;
        const double x = a.x + share * (b.x - a.x) - robot.x;
        const double y = a.y + share * (b.y - a.y) - robot.y;
        const double angle = std::atan2(y, x) - robot.heading;
        const double turns = angle / kSectorWidth + 0.5;
        const auto sector =
            static_cast<std::size_t>(static_cast<long>(std::floor(turns)) % static_cast<long>(kSectors) +
                                     static_cast<long>(kSectors)) %
            kSectors;
        ranges[sector] = std::min(ranges[sector], std::hypot(x, y));
      }
    }
  }
  return ranges;
}

class Watch final : public host::RunObserver {
 public:
  Watch(const Approach& approach, Figures& figures, const Request& request, unsigned seed)
      : approach_(approach), figures_(figures), request_(request), seed_(seed) {
    const sensor::CameraIntrinsics& camera = approach.scene.camera;
    half_view_ = std::atan(0.5 * camera.width / camera.fx.to_double());
  }
  void run_begins() override {}
  void frame_placed(const host::PlacedFrame& placed) override {
    if (++frames_ % kEvery != 0) return;
    const auto report = placed.sectors();
    if (!report) throw std::runtime_error("this profile has no sectors");
    const double t = report->t.to_double();
    const auto truth = true_ranges(approach_.scene, approach_.drive.at(t));
    for (std::size_t k = 0; k < kSectors; ++k) {
      const auto& told = report->sectors[k].distance;
      const double middle = std::remainder(static_cast<double>(k) * kSectorWidth, 2 * std::numbers::pi);
      const bool in_view = std::abs(middle) + kSectorWidth / 2 < half_view_;
      ++figures_.asked;
      figures_.in_view += in_view ? 1U : 0U;
      if (!told) continue;
      const double range = told->to_double();
      const bool right = range <= truth[k] + kSlack;
      ++figures_.known;
      figures_.in_view_known += in_view ? 1U : 0U;
      figures_.right += right ? 1U : 0U;
      if (!right && request_.show) {
        fmt::print("seed {} t {:.2f} sector {} reported {:.3f} true {:.3f}\n", seed_, t, k, range, truth[k]);
      }
      if (truth[k] < kLongest) {
        ++figures_.things;
        figures_.short_by += std::max(0.0, truth[k] - range);
      } else {
        ++figures_.open;
        figures_.open_range += range;
      }
    }
  }

 private:
  const Approach& approach_;
  Figures& figures_;
  const Request& request_;
  unsigned seed_;
  unsigned frames_ = 0;
  double half_view_ = 0;
};

double percent(unsigned long part, unsigned long whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

bool run(const Request& request) {
  fmt::print(
      "| noise | sectors asked | known, % | of those in view, % | nothing nearer, % | things: short by, m | open: "
      "range, m "
      "|\n|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (const NoiseLevel& level : noise_levels(request.levels)) {
    Figures f;
    for (unsigned i = 0; i < request.scenes.scenes; ++i) {
      const unsigned seed = request.scenes.first + i;
      const Approach approach = random_approach(seed, level, 0.3);
      std::string log;
      const auto done = host::simulate_with_truth(
          approach.scene, [&](std::string_view line) { log += line; }, [](const host::FrameTruth&) {});
      if (!done.ok()) throw std::runtime_error(done.error());
      Watch watch(approach, f, request, seed);
      host::ReplayOptions options;
      options.profile = request.profile;
      options.observer = &watch;
      static_cast<void>(host::replay(log, "approach", options));
    }
    print(fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.3f} | {:.2f} |\n", level.key, f.asked,
                      percent(f.known, f.asked), percent(f.in_view_known, f.in_view), percent(f.right, f.known),
                      f.things > 0 ? f.short_by / static_cast<double>(f.things) : 0,
                      f.open > 0 ? f.open_range / static_cast<double>(f.open) : 0));
    good = good && f.known > 0 && percent(f.right, f.known) >= request.at_least;
  }
  return good;
}

constexpr Study<Request> kStudy{"sector_table", "How true the ranges of `sectors` are on random approaches.",
                                [](CLI::App& app, Request& request) {
                                  add_seed_options(app, request.scenes, "random approaches for each level");
                                  add_levels_option(app, request.levels);
                                  add_profile_option(app, request.profile);
                                  app.add_option("--at-least", request.at_least,
                                                 "% of the known sectors in which nothing is nearer than reported")
                                      ->capture_default_str();
                                  app.add_flag("--show", request.show, "each range that ends behind something");
                                },
                                run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
