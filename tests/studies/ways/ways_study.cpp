// A robot that steers by the example around_things.h in random squares. Does it touch anything, does it get about,
// and is any way shorter than `ways` says?
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "host/share/examples/around_things.h"
#include "host/simulate/truth.hpp"
#include "tests/firmware/fencepost/played_log.hpp"
#include "tests/studies/common/study.hpp"
#include "tests/studies/ways/arena.hpp"

namespace fencepost::test {
namespace {

constexpr double kBody = 0.1;      // m, half the robot's width
constexpr double kSeconds = 60;    // of a run
constexpr double kMinWay = 3;      // m; who gets less far is stuck
constexpr double kSteering = 0.1;  // s, how often it asks
constexpr double kSlack = 0.01;    // m. A way is wrong if the body touches that far before its end
constexpr double kReaction = 0.2;  // s, until the motors have the speed that they are given

struct Request {
  Seeds scenes{100, 1};
  std::vector<std::string> levels;
  std::vector<std::string> settings;
  bool small = false;
  double at_least = 95;
  double right = 99.5;
  bool show = false;
};

struct Figures {
  unsigned whole = 0;  ///< runs without a contact and with some way driven
  unsigned touched = 0;
  unsigned stuck = 0;
  double driven = 0;          ///< m
  unsigned long ways = 0;     ///< that are free at least a little
  unsigned long right = 0;    ///< of those, how many have nothing standing on them
  unsigned long asked = 0;    ///< forward ways
  unsigned long unknown = 0;  ///< of those, how many end at floor that was not seen
};

bool is_free(const Arena& arena, const host::TimedPose& robot, const Way& way) {
  constexpr double kStep = 0.02;
  const double sign = way.motion == FENCEPOST_BACK ? -1 : 1;
  const double end = double{way.free} - kSlack;
  for (int i = 0; i * kStep < end; ++i) {
    const double gone = i * kStep;
    const double turned = double{way.curvature} * gone;
    const double chord = way.curvature == 0 ? gone : 2 * std::sin(turned / 2) / double{way.curvature};
    const double towards = robot.heading + turned / 2;
    const host::Point place{robot.x + sign * chord * std::cos(towards), robot.y + sign * chord * std::sin(towards)};
    if (touches(arena, place, kBody)) return false;
  }
  return true;
}

template <class Size>
class Driver {
 public:
  Driver(const Arena& arena, const Request& request, Figures& figures)
      : arena_(arena), figures_(figures), show_(request.show), pose_(arena.start) {
    for (const std::string& setting : request.settings) {
      const auto [key, value] = key_and_value(setting);
      const Answer answer = core_->set(key.c_str(), value.c_str());
      if (answer != Answer::kTaken) throw std::runtime_error("--set " + setting + ": not taken");
    }
  }

  void drive() {
    host::Driven driven;
    driven.duration = kSeconds;
    driven.pose = [&](double t) { return at(t); };
    driven.ended = [&](double t) { return touched_ = touched_ || touches(arena_, {at(t).x, at(t).y}, kBody); };
    std::array<char, record::StreamReader::kBuffer> buffer{};
    record::StreamReader reader(buffer);
    Player<Core<Size>> player{*core_};
    const auto hear = [&](std::string_view line) {
      reader.push(line, player);
      reader.push("\n", player);
      core_->step(player.last);
    };
    const auto done = host::simulate_driven(arena_.scene, driven, hear, [](const host::FrameTruth&) {});
    if (!done.ok()) throw std::runtime_error(done.error());
    const bool stuck = !touched_ && driven_ < kMinWay;
    figures_.touched += touched_ ? 1U : 0U;
    figures_.stuck += stuck ? 1U : 0U;
    figures_.whole += touched_ || stuck ? 0U : 1U;
    figures_.driven += driven_;
    if (show_ && (touched_ || stuck)) {
      print(fmt::format("seed {}: {} at {:.2f} s, {:.2f} {:.2f} {:.2f}, {:.2f} m driven\n", arena_.scene.seed,
                        touched_ ? "touched" : "stuck", pose_.t, pose_.x, pose_.y, pose_.heading, driven_));
    }
  }

 private:
  // Times never go back by more than a sample.
  host::TimedPose at(double t) {
    constexpr double kStep = 0.005;
    while (pose_.t + kStep <= t) {
      if (pose_.t >= steered_at_ + kSteering) steer();
      const double share = kStep / kReaction;
      wheels_.speed += static_cast<float>(share) * (wanted_.speed - wheels_.speed);
      wheels_.turn += static_cast<float>(share) * (wanted_.turn - wheels_.turn);
      const double heading = pose_.heading + kStep * double{wheels_.turn} / 2;
      pose_.x += kStep * double{wheels_.speed} * std::cos(heading);
      pose_.y += kStep * double{wheels_.speed} * std::sin(heading);
      pose_.heading += kStep * double{wheels_.turn};
      pose_.t += kStep;
      driven_ += kStep * double{wheels_.speed};
    }
    host::TimedPose pose = pose_;
    pose.t = t;
    return pose;
  }

  void steer() {
    steered_at_ = pose_.t;
    wanted_ = around_things(*core_);
    Way ways[kWays];
    const std::size_t count = core_->ways(ways, kWays);
    for (std::size_t i = 0; i < count; ++i) {
      const Way& way = ways[i];
      if (way.motion == FENCEPOST_SPIN) continue;
      figures_.asked += way.motion == FENCEPOST_FORWARD ? 1U : 0U;
      figures_.unknown += way.motion == FENCEPOST_FORWARD && way.end == FENCEPOST_END_UNKNOWN ? 1U : 0U;
      if (way.free <= 0) continue;
      ++figures_.ways;
      const bool right = is_free(arena_, pose_, way);
      figures_.right += right ? 1U : 0U;
      if (!right && show_) {
        print(fmt::format("seed {} {:.2f} s at {:.2f} {:.2f} {:.2f}: way {} should be free for {:.2f} m, ends at {}\n",
                          arena_.scene.seed, pose_.t, pose_.x, pose_.y, pose_.heading, i, way.free,
                          static_cast<int>(way.end)));
      }
    }
  }

  const Arena& arena_;
  Figures& figures_;
  bool show_;
  std::unique_ptr<Core<Size>> core_ = std::make_unique<Core<Size>>();
  host::TimedPose pose_;
  Wheels wheels_;
  Wheels wanted_;
  double steered_at_ = 0;
  double driven_ = 0;
  bool touched_ = false;
};

double percent(unsigned long part, unsigned long whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

bool run(const Request& request) {
  print(
      "| noise | runs | without contact, not stuck | touched | stuck | m driven, mean | ways | of them free, % | "
      "unknown ahead, % |\n|---|---|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (const NoiseLevel& level : noise_levels(request.levels)) {
    Figures f;
    for (unsigned i = 0; i < request.scenes.scenes; ++i) {
      const Arena arena = random_arena(request.scenes.first + i, level);
      if (request.small) {
        Driver<Small>(arena, request, f).drive();
      } else {
        Driver<Full>(arena, request, f).drive();
      }
    }
    const unsigned runs = request.scenes.scenes;
    print(fmt::format("| {} | {} | {:.1f} % | {} | {} | {:.1f} | {} | {:.2f} | {:.0f} |\n", level.key, runs,
                      percent(f.whole, runs), f.touched, f.stuck, f.driven / runs, f.ways, percent(f.right, f.ways),
                      percent(f.unknown, f.asked)));
    good = good && percent(f.whole, runs) >= request.at_least && percent(f.right, f.ways) >= request.right;
  }
  return good;
}

constexpr Study<Request> kStudy{
    "ways_study", "Random squares, driven by the example that asks for `ways`.",
    [](CLI::App& app, Request& request) {
      add_seed_options(app, request.scenes, "squares for each level");
      add_levels_option(app, request.levels);
      app.add_option("--set", request.settings, "KEY=VALUE, a setting of the robot");
      app.add_flag("--small", request.small, "profile small in place of full");
      app.add_option("--at-least", request.at_least, "% of runs without contact that get about")->capture_default_str();
      app.add_option("--right", request.right, "% of ways that are as free as said")->capture_default_str();
      app.add_flag("--show", request.show, "each run and way that is not");
    },
    run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
