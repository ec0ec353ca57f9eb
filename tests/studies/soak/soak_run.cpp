#include "tests/studies/soak/soak_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "host/evaluate/metrics.hpp"
#include "host/replay/models.hpp"
#include "host/replay/replay.hpp"
#include "tests/studies/soak/soak_desk.hpp"

namespace fencepost::test {
namespace {

constexpr base::Time kStart{(1LL << 32) - 150 * base::Time::kPerUnit};  // its low word wraps after 150 s
constexpr std::uint32_t kFirstFrame = std::numeric_limits<std::uint32_t>::max() - 700;
constexpr host::Point kHome{0, 0};
constexpr host::Point kFarAway{80, -60};  // 100 m
constexpr unsigned kScenes = 12;
constexpr unsigned kLaps = 3;
constexpr unsigned kQualitySeed = 7;
constexpr std::size_t kUsualLink = 12;  // bytes a millisecond: 115200 baud
constexpr double kFoundWithin = 0.1;    // m

constexpr std::string_view kBadRecord = "$FPODO,1,2,3*0000\n";
constexpr std::string_view kCommands[] = {"help\n",
                                          "status\n",
                                          "objects\n",
                                          "map\n",
                                          "get\n",
                                          "frob\n",
                                          "set confirm.k 2\n",
                                          "set confirm.k 3\n",
                                          "alerts off\n",
                                          "alerts on\n",
                                          "set alert.stop 0.3\n",
                                          "version\n",
                                          "mode log\n",
                                          "set alert.stop x\n",
                                          kBadRecord};
constexpr std::string_view kWildCommands[] = {"mode text\n", "mode plot\n", "mode quiet\n", "mode log\n",
                                              "reset\n",     "selftest\n",  "map\n",        "help\n"};

template <class Profile>
class Soak {
 public:
  explicit Soak(unsigned seed) : random_(seed), desk_(kStart, kFirstFrame) {
    for (unsigned i = 0; i < kScenes; ++i) {
      home_.push_back(make_lap(seed + i, kHome));
      away_.push_back(make_lap(seed + i, kFarAway));
    }
    desk_.set_up(home_.front().scene);
    desk_.link.bytes_a_turn = kUsualLink;
  }

  SoakFigures run(unsigned rounds) {
    figures_.at_start = quality_lap(make_lap(kQualitySeed, kHome));
    for (unsigned i = 0; i < rounds / 3; ++i) round(home_);
    desk_.drive(make_transfer(kHome, kFarAway));
    figures_.far_away = quality_lap(make_lap(kQualitySeed, kFarAway));
    for (unsigned i = 0; i < rounds / 3; ++i) round(away_);
    desk_.drive(make_transfer(kFarAway, kHome));
    for (unsigned i = 2 * (rounds / 3); i < rounds; ++i) round(home_);
    figures_.at_end = quality_lap(make_lap(kQualitySeed, kHome));
    finish();
    return figures_;
  }

 private:
  void round(const std::vector<Piece>& laps) {
    logged_run(laps);
    wild_run(laps);
  }

  void reset_in_mode_log() {
    desk_.obey("mode log\n");
    desk_.link.take_said();
    desk_.obey("reset\n");
    ++figures_.commands;
    expect(desk_.memory().map.size() == 0, "a reset left objects in the map");
    expect(desk_.memory().waiting.empty(), "a reset left frames waiting");
  }

  // Blocks come and go, people type, the link is fast or slow: the log says it all.
  void logged_run(const std::vector<Piece>& laps) {
    desk_.obey("set confirm.k 3\n");
    reset_in_mode_log();
    desk_.link.bytes_a_turn = random_() % 2 == 0 ? kUsualLink : 3 + random_() % 4;
    const Piece* last = nullptr;
    for (unsigned i = 0; i < kLaps; ++i) {
      last = &laps[random_() % laps.size()];
      desk_.drive(*last, [&] { type_sometimes(kCommands, 2300); });
    }
    desk_.link.bytes_a_turn = kUsualLink;
    desk_.drain();
    count_present(last->scene);
    replay_log();
    check_counters();
  }

  void wild_run(const std::vector<Piece>& laps) {
    desk_.link.bytes_a_turn = 1 + random_() % 20;
    desk_.drive(laps[random_() % laps.size()], [&] { type_sometimes(kWildCommands, 900); });
    desk_.drain();
    desk_.link.take_said();
    desk_.link.bytes_a_turn = kUsualLink;
    check_counters();
  }

  LapQuality quality_lap(const Piece& lap) {
    reset_in_mode_log();
    desk_.drive(lap);
    desk_.drain();
    replay_log();
    return quality_of(lap.scene);
  }

  template <std::size_t N>
  void type_sometimes(const std::string_view (&commands)[N], unsigned every) {
    if (random_() % every != 0) return;
    const std::string_view command = commands[random_() % N];
    if (command == kBadRecord) ++bad_records_;
    desk_.type(command);
    ++figures_.commands;
  }

  void replay_log() {
    host::ReplayOptions options;
    options.check = true;
    const std::string log = desk_.link.take_said();
    const host::ReplayOutcome outcome = host::replay(log, "soak", options);
    ++figures_.runs_replayed;
    figures_.digests_compared += outcome.check.compared;
    expect(!outcome.unreadable, "the robot's own log cannot be replayed");
    expect(outcome.result.profile == Profile::kName, "the log is of another profile");
    expect(outcome.result.digest == desk_.memory().map.digest(), "the replay's digest is not the robot's");
    expect(outcome.check.differing == 0, "an object, an alert or a digest of the log is not the replay's");
    expect(outcome.check.compared > 0, "the log had nothing to compare");
  }

  void check_counters() {
    expect(desk_.frames_add_up(bad_records_), "frames used, refused, rejected and waiting are not those that came");
    loop::Memory<Profile>& memory = desk_.memory();
    expect(memory.signatures.size() == 3, "the table of signatures has changed");
    expect(memory.waiting.size() <= recon::kMaxWaitingFrames, "too many frames wait");
    std::vector<std::uint32_t> ids;
    for (const auto& object : memory.map.slots()) {
      if (object.used()) ids.push_back(object.id);
    }
    std::sort(ids.begin(), ids.end());
    expect(std::adjacent_find(ids.begin(), ids.end()) == ids.end(), "two objects have one id");
  }

  struct Found {
    bool found = false;
    double error = 0;
    host::Score score;
  };
  Found find(const host::SceneObject& block) {
    Found best;
    best.error = kFoundWithin;
    for (const auto& object : desk_.memory().map.slots()) {
      if (!object.used() || !object.confirmed || object.signature != block.signature) continue;
      const host::ModelResult model = host::cylinder_model(object);
      if (!model.circle) continue;
      const host::Point center = host::centroid(block.footprint);
      const double error = std::hypot(model.circle->center.x - center.x, model.circle->center.y - center.y);
      if (error < best.error) best = {true, error, host::score(model.geometry, block.footprint)};
    }
    return best;
  }

  LapQuality quality_of(const host::Scene& scene) {
    LapQuality quality;
    for (const host::SceneObject& block : scene.objects) {
      const Found found = find(block);
      if (!found.found) continue;
      ++quality.found;
      quality.center_error += found.error;
      quality.recklessness += found.score.recklessness;
      quality.paranoia += found.score.paranoia;
    }
    for (double* sum : {&quality.center_error, &quality.recklessness, &quality.paranoia}) {
      *sum /= std::max(1U, quality.found);
    }
    return quality;
  }

  void count_present(const host::Scene& scene) {
    for (const host::SceneObject& block : scene.objects) {
      ++figures_.present;
      figures_.present_found += find(block).found ? 1U : 0U;
    }
  }

  void finish() {
    const console::Counters& counters = desk_.memory().counters;
    figures_.minutes = (desk_.now() - kStart).to_double() / 60;
    figures_.frames_offered = desk_.frames_offered();
    figures_.frames_used = counters.frames;
    figures_.frames_refused = counters.refused_in_all();
    figures_.frame_counter_wrapped = desk_.next_frame() < kFirstFrame;
    figures_.clock_word_wrapped = desk_.now().raw >= 1LL << 32;
  }

  // The first hundred are enough.
  void expect(bool holds, const char* sentence) {
    if (holds || figures_.faults.size() >= 100) return;
    figures_.faults.push_back(std::to_string(desk_.now().to_double()) + " s: " + sentence);
  }

  std::mt19937 random_;
  SoakDesk<Profile> desk_;
  std::vector<Piece> home_;
  std::vector<Piece> away_;
  std::uint64_t bad_records_ = 0;
  SoakFigures figures_;
};

}  // namespace

SoakFigures run_soak(std::string_view profile, unsigned rounds, unsigned seed) {
  if (profile == config::Micro::kName) return Soak<config::Micro>(seed).run(rounds);
  if (profile == config::Small::kName) return Soak<config::Small>(seed).run(rounds);
  if (profile == config::Full::kName) return Soak<config::Full>(seed).run(rounds);
  throw std::invalid_argument("no profile " + std::string(profile));
}

}  // namespace fencepost::test
