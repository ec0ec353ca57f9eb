// How good is an outline of few views where the robot says from where to look next?
#include <fmt/format.h>

#include <cmath>

#include "tests/studies/common/study.hpp"
#include "tests/studies/next_view/chosen_views.hpp"

namespace fencepost::test {
namespace {

constexpr int kChosen = 10;
constexpr int kCircle = 18;

struct Request {
  Seeds seeds{60, 9001};
  std::string level = "1";
};

struct Sums {
  double recklessness = 0;
  double paranoia = 0;
  double squares = 0;
  unsigned n = 0;
  void add(const Looked& looked) {
    recklessness += looked.recklessness;
    paranoia += looked.paranoia;
    squares += looked.both() * looked.both();
    ++n;
  }
  [[nodiscard]] double both() const { return 100 * (recklessness + paranoia) / n; }
  [[nodiscard]] std::string row(const std::string& name, int views) const {
    const double spread = std::sqrt(std::max(0.0, 1e4 * squares / n - both() * both()) / n);
    return fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name, views, 100 * recklessness / n,
                       100 * paranoia / n, both(), spread);
  }
};

bool run(const Request& request) {
  const NoiseLevel level = noise_levels({request.level}).front();
  Sums by_choice[kChosen + 1];
  Sums circle;
  Sums few;
  Sums half;
  request.seeds.each([&](unsigned seed) {
    const host::Scene object = lone_object(seed);
    const std::vector<double> wanted = chosen(kChosen, object, level);
    for (int views = 4; views <= kChosen; views += 2) {
      by_choice[views].add(look_from({wanted.begin(), wanted.begin() + views}, object, level));
    }
    const std::vector<double> round = evenly(kCircle);
    circle.add(look_from(round, object, level));
    half.add(look_from({round.begin(), round.begin() + kChosen}, object, level));
    few.add(look_from(evenly(kChosen), object, level));
    return 0;
  });
  print("| views | number | R % | P % | R+P % | standard error |\n|---|---|---|---|---|---|\n");
  for (int views = 4; views <= kChosen; views += 2) print(by_choice[views].row("chosen", views));
  print(half.row("the first of 18 on a circle", kChosen));
  print(few.row("evenly on a circle", kChosen) + circle.row("evenly on a circle", kCircle));
  Tally tally;
  tally.look(by_choice[kChosen].both() <= few.both(),
             fmt::format("{} chosen views: R+P {:.1f} above the {:.1f} of as many on a circle", kChosen,
                         by_choice[kChosen].both(), few.both()));
  return tally.report(request.seeds);
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "objects");
  app.add_option("--level", request.level, "of noise")->capture_default_str();
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  using namespace fencepost::test;
  return Study<Request>{"next_view_study", "Views where the robot wants them, against views on a circle", options, run}
      .main(argc, argv);
}
