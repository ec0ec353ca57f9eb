#include "host/doctor/log/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware/record/stream_reader.hpp"
#include "host/replay/log_replay.hpp"

namespace fencepost::host::doctor {
namespace {

constexpr double kFastest = 4;       // m/s
constexpr double kFastestTurn = 15;  // rad/s
constexpr double kMinJump = 0.05;    // m, and rad: rounding and slow clocks are no jumps
constexpr std::size_t kMinFrames = 30;
constexpr std::size_t kMax = 1024;  ///< of calibrations, settings and links: a robot has fewer

double shortest_turn(double turn) { return std::remainder(turn, 2 * std::numbers::pi); }

/// A car reports counts; the robot's own loop makes poses of them.
double length_of(const std::vector<PoseResult>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
  return length;
}

class Surveyor {
 public:
  explicit Surveyor(LogSurvey& survey) : survey_(survey) {}

  void accept(const record::Header& header) {
    losses_.accept(header);
    end_run();
    ++survey_.runs;
  }
  void accept(const sensor::CameraIntrinsics& camera) {
    if (survey_.calibrations.empty() || !(survey_.calibrations.back() == camera)) {
      if (survey_.calibrations.size() == kMax) survey_.calibrations.pop_back();
      survey_.calibrations.push_back(camera);
    }
    camera_ = camera;
  }
  void accept(const record::Signature& signature) { survey_.colour_names[signature.signature] = signature.name.view(); }
  void accept(const record::Setting& setting) {
    const std::string key(setting.key.view());
    if (survey_.settings.size() < kMax || survey_.settings.contains(key)) survey_.settings[key] = setting.value.view();
  }
  void accept(const sensor::OdometrySample& sample) {
    note_time(sample.t);
    odometry_.add(sample.t);
    if (pose_) step(*pose_, sample);
    pose_ = sample;
  }
  void accept(const sensor::CarSample& sample) {
    note_time(sample.t);
    odometry_.add(sample.t);
  }
  void accept(const sensor::BlobFrame& frame) {
    note_time(frame.t);
    losses_.accept(frame);
    frames_.add(frame.t);
    colours_.add(frame, camera_);
    if (pose_) offsets_.add((frame.t - pose_->t).to_double());
  }
  void accept(const record::StatusReport& status) { losses_.accept(status); }
  void accept(const record::LinkReport& link) {
    const std::string device(link.device.view());
    close(device, link.t);
    if (sensor::works(link.state)) return;
    if (survey_.links.size() == kMax && !survey_.links.contains(device)) return;
    LinkTrouble& trouble = survey_.links[device];
    trouble.state = sensor::name(link.state);
    ++trouble.times;
    down_since_[device] = link.t;
  }
  void accept(const record::Heartbeat& beat) {
    if (beat_ && beat_->level == record::AlertLevel::kBlind) survey_.blind_seconds += (beat.t - beat_->t).to_double();
    beat_ = beat;
  }
  template <class Record>
  void accept(const Record& /*record*/) {}

  void finish() {
    end_run();
    survey_.runs = std::max<std::uint64_t>(survey_.runs, 1);
    survey_.camera = frames_.spacing();
    survey_.odometry = odometry_.spacing();
    survey_.colours = colours_.qualities();
    survey_.frames_missing = losses_.frames_missing();
    survey_.reported = losses_.reported();
    const std::vector<double>& offsets = offsets_.kept();
    survey_.clock_offset = median_of(offsets);
    if (offsets.size() < kMinFrames) return;
    const auto third = static_cast<std::ptrdiff_t>(offsets.size() / 3);
    survey_.clock_drift =
        median_of({offsets.end() - third, offsets.end()}) - median_of({offsets.begin(), offsets.begin() + third});
  }

 private:
  void note_time(base::Time t) {
    if (!first_) first_ = t;
    last_ = std::max(last_.value_or(t), t);
  }
  void step(const sensor::OdometrySample& from, const sensor::OdometrySample& to) {
    const PoseJump step{from.t.to_double(), std::hypot((to.x - from.x).to_double(), (to.y - from.y).to_double()),
                        std::abs(shortest_turn((to.heading - from.heading).to_double())), (to.t - from.t).to_double()};
    survey_.path += step.distance;
    survey_.turned += step.turn;
    const bool far = step.distance > std::max(kMinJump, kFastest * step.interval);
    const bool turned = step.turn > std::max(kMinJump, kFastestTurn * step.interval);
    if (!far && !turned) return;
    ++survey_.pose_jumps;
    if (!survey_.first_jump) survey_.first_jump = step;
  }
  void close(const std::string& device, base::Time t) {
    const auto since = down_since_.find(device);
    if (since == down_since_.end()) return;
    survey_.links[device].seconds += std::max(0.0, (t - since->second).to_double());
    down_since_.erase(since);
  }
  void end_run() {
    if (last_) {
      for (const auto& [device, since] : std::map(down_since_)) close(device, *last_);
      survey_.seconds += (*last_ - *first_).to_double();
    }
    down_since_.clear();
    first_.reset();
    last_.reset();
    pose_.reset();
    beat_.reset();
    frames_.restart();
    odometry_.restart();
  }

  LogSurvey& survey_;
  Losses losses_;
  SpacingMeter frames_;
  SpacingMeter odometry_;
  ColourMeter colours_;
  std::optional<sensor::CameraIntrinsics> camera_;
  std::optional<sensor::OdometrySample> pose_;
  std::optional<record::Heartbeat> beat_;
  std::optional<base::Time> first_;
  std::optional<base::Time> last_;
  Sample offsets_;
  std::map<std::string, base::Time> down_since_;
};

class FirstAlerts final : public AlertSink {
 public:
  void run_begins() override {
    first_.clear();
    count_ = 0;
  }
  void hear(const record::AlertReport& alert) override {
    if (++count_ <= kMaxAlerts) first_.push_back(alert);
  }
  void give(ReplayOutcome& outcome) {
    outcome.result.alerts = std::move(first_);
    if (count_ <= kMaxAlerts) return;
    outcome.complaints.push_back("only the first " + std::to_string(kMaxAlerts) + " of " + std::to_string(count_) +
                                 " alerts are looked at");
  }

 private:
  static constexpr std::size_t kMaxAlerts = 1U << 16U;
  std::vector<record::AlertReport> first_;
  std::uint64_t count_ = 0;
};

}  // namespace

LogSurvey survey_log(const LogSource& log, const std::string& name) {
  LogSurvey survey;
  survey.name = name;
  Surveyor surveyor(survey);
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  FirstAlerts alerts;
  ReplayOptions options;
  options.alerts = &alerts;
  options.most_poses = kPosesToShow;
  LogReplay replayed(options);
  for (std::string_view bytes = log(); !bytes.empty(); bytes = log()) {
    for (std::string_view left = bytes; !left.empty() && !replayed.ended();) replayed.take(left);
    while (!bytes.empty()) reader.take(bytes, surveyor);
  }
  reader.finish();
  surveyor.finish();
  replayed.finish();
  survey.counts = reader.counts();
  survey.replayed = {replayed.now(), replayed.check(), replayed.complaints(), replayed.why_unreadable(name),
                     replayed.runs()};
  alerts.give(survey.replayed);
  if (survey.path == 0) survey.path = length_of(survey.replayed.result.path);
  return survey;
}

LogSurvey survey_log(std::string_view bytes, const std::string& name) {
  return survey_log([&bytes] { return std::exchange(bytes, {}); }, name);
}

}  // namespace fencepost::host::doctor
