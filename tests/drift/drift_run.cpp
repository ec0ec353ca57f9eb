#include "tests/drift/drift_run.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "firmware/record/decode.hpp"
#include "firmware/record/encode.hpp"
#include "host/evaluate/metrics.hpp"
#include "host/geometry/rings.hpp"
#include "host/replay/replay.hpp"
#include "host/simulate/random.hpp"
#include "host/simulate/truth.hpp"
#include "tests/tables/noisy_views.hpp"
#include "tests/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kScaleWalk = 0.003;  // share of the distance a sqrt(m): 1 % a step of 9 cm

/// What a robot of this drift would have logged, and where it truly was.
class DriftingOdometry {
 public:
  DriftingOdometry(unsigned seed, const Drift& drift)
      : random_(seed, host::Purpose::kDrift, 77),
        drift_(drift),
        scale_(1 + drift.scale * random_.gaussian()),
        turn_(drift.turn * kDegree * random_.gaussian()) {}

  sensor::OdometrySample next(const sensor::OdometrySample& sample) {
    const host::PoseResult now{sample.t.to_double(), sample.x.to_double(), sample.y.to_double(),
                               sample.heading.to_double()};
    if (truth.empty()) {
      logged_ = now;
    } else {
      advance(truth.back(), now);
    }
    truth.push_back(now);
    return {sample.t, base::Metres::nearest(logged_.x), base::Metres::nearest(logged_.y),
            base::Radians::nearest(logged_.heading)};
  }

  std::vector<host::PoseResult> truth;

 private:
  void advance(const host::PoseResult& before, const host::PoseResult& now) {
    const double dx = now.x - before.x;
    const double dy = now.y - before.y;
    const double distance = std::hypot(dx, dy);
    const double off = logged_.heading - before.heading;
    const double stretch =
        scale_ * distance + (drift_.scale > 0 ? kScaleWalk * std::sqrt(distance) * random_.gaussian() : 0);
    const double factor = distance > 0 ? stretch / distance : 1;
    logged_.x += factor * (std::cos(off) * dx - std::sin(off) * dy);
    logged_.y += factor * (std::sin(off) * dx + std::cos(off) * dy);
    logged_.heading += std::remainder(now.heading - before.heading, 2 * std::numbers::pi) + turn_ * distance +
                       drift_.turn_walk * kDegree * std::sqrt(distance) * random_.gaussian();
  }

  host::Random random_;
  Drift drift_;
  double scale_;
  double turn_;
  host::PoseResult logged_;
};

template <class Record>
std::string line_of(const Record& record) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t size = record::encode(record, line);
  if (size == 0) throw std::runtime_error("a record is outside the range of the stream");
  return {line.data(), size};
}

/// Takes the odometry out of a line.
struct OneSample {
  sensor::OdometrySample sample;
  void accept(const sensor::OdometrySample& odometry) { sample = odometry; }
  template <class Other>
  void accept(const Other&) {}
};

struct DrivenLog {
  std::string text;
  std::vector<host::PoseResult> truth;
};

DrivenLog drive(const host::Scene& scene, const DriftOptions& options) {
  DriftingOdometry odometry(options.seed, options.drift);
  DrivenLog log;
  const auto take_line = [&](std::string_view line) {
    if (line.starts_with("$FPFRM")) return;  // comes noisy, below
    if (!line.starts_with("$FPODO")) {
      log.text += line;
      if (line.starts_with("$FPHDR") && options.correct) log.text += line_of(record::Setting{"correct.pose", "on"});
      return;
    }
    OneSample taken;
    static_cast<void>(record::decode(line.substr(0, line.find_first_of("\r\n")), {}, taken));
    log.text += line_of(odometry.next(taken.sample));
  };
  const BlobNoise noise = noise_levels({options.level}).front().blob;
  const auto take_frame = [&](const host::FrameTruth& perfect) {
    log.text += line_of(frame_of(perfect, noisy_view(scene, perfect, noise)).frame);
  };
  const auto summary = host::simulate_with_truth(scene, take_line, take_frame);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  log.truth = odometry.truth;
  return log;
}

/// As seen by a robot that is at `truth` and believes to be at `estimate`.
host::MultiPolygon seen_from(host::MultiPolygon model, const host::PoseResult& estimate,
                             const host::PoseResult& truth) {
  for (host::Polygon& polygon : model) {
    polygon = host::moved(polygon, 0, {-estimate.x, -estimate.y});
    polygon = host::moved(polygon, truth.heading - estimate.heading, {truth.x, truth.y});
  }
  return model;
}

/// The object that is known best of those with its signature.
const host::ObjectResult* object_of(const host::ResultDocument& result, std::uint8_t signature) {
  const host::ObjectResult* best = nullptr;
  for (const host::ObjectResult& object : result.objects) {
    if (object.signature == signature && (best == nullptr || object.views > best->views)) best = &object;
  }
  return best;
}

void measure_pose(const std::vector<host::PoseResult>& path, const std::vector<host::PoseResult>& truth,
                  DriftResult& result) {
  if (path.size() != truth.size()) throw std::runtime_error("odometry was lost");
  const std::size_t from = truth.size() * 3 / 4;
  const auto count = static_cast<double>(truth.size() - from);
  for (std::size_t i = from; i < truth.size(); ++i) {
    result.position += std::hypot(path[i].x - truth[i].x, path[i].y - truth[i].y) / count;
    result.heading += std::fabs(std::remainder(path[i].heading - truth[i].heading, 2 * std::numbers::pi)) / count;
  }
}

}  // namespace

const std::vector<Drift>& drifts() {
  static const std::vector<Drift> kDrifts{
      {"1 %, 1 deg/m", 0.01, 1, 0.5}, {"3 %, 2 deg/m", 0.03, 2, 1}, {"5 %, 3 deg/m", 0.05, 3, 1.5}, {"none", 0, 0, 0}};
  return kDrifts;
}

std::string drift_log(const DriftOptions& options) {
  return drive(loop_scene(options.seed, options.loops), options).text;
}

DriftResult run_drift(const DriftOptions& options) {
  const host::Scene scene = loop_scene(options.seed, options.loops);
  const DrivenLog log = drive(scene, options);
  host::ReplayOptions replay_options;
  replay_options.profile = options.profile;
  const host::ReplayOutcome outcome = host::replay(log.text, "seed " + std::to_string(options.seed), replay_options);
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  DriftResult result;
  measure_pose(outcome.result.path, log.truth, result);
  for (const host::SceneObject& truth : scene.objects) {
    const host::ObjectResult* found = object_of(outcome.result, truth.signature);
    for (const char* model : {"hybrid", "cylinder", "cylinder_paper", "carve", "clip"}) {
      host::Score score;
      for (const host::ModelResult& entry : found ? found->models : std::vector<host::ModelResult>{}) {
        if (entry.name != model) continue;
        score = host::score(seen_from(entry.geometry, *outcome.result.pose, log.truth.back()), truth.footprint);
      }
      result.sum[model] += 100 * (score.recklessness + score.paranoia) / static_cast<double>(scene.objects.size());
    }
  }
  return result;
}

}  // namespace fencepost::test
