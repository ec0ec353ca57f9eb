#include "host/replay/replay.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "firmware/console/text.hpp"
#include "firmware/record/stream_reader.hpp"
#include "host/replay/check.hpp"
#include "host/replay/own_log.hpp"
#include "host/replay/runner.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kDefaultProfile = "full";

// Feeds one log to a runner, record by record.
class Replay {
 public:
  explicit Replay(const ReplayOptions& options)
      : options_(options),
        own_log_({options.log, [this](const auto& alert) { hear_alert(alert); },
                  [this](const auto& object) { check_.own(object); },
                  [this](const auto& digest) { check_.own(digest); }, [this](const auto& beat) { check_.own(beat); },
                  [this](const auto& doubt) { hear_doubt(doubt); }}) {}

  ReplayOutcome run(std::string_view bytes, const std::string& name) {
    for (const char byte : bytes) {
      reader_.push(byte, *this);
      if (complete_ || reader_.other_format()) break;
    }
    if (!complete_) reader_.finish();
    if (runner_) end_run();
    fill_counts();
    outcome_.unreadable = why_unreadable(bytes, name);
    return std::move(outcome_);
  }

  // The sink of the reader.
  void accept(const record::Header& header) {
    if (runner_) end_run();
    begin_run(header);
  }
  void accept(const sensor::CameraIntrinsics& camera) {
    runner().take(camera);
    camera_ = camera;
  }
  void accept(const record::Signature& signature) {
    runner().take(signature);
    signatures_.push_back(signature);
    for (std::size_t i = 0; i + 1 < signatures_.size(); ++i) {
      if (signatures_[i].signature != signature.signature) continue;
      signatures_[i] = signature;
      signatures_.pop_back();
      break;
    }
  }
  void accept(const record::Setting& setting) {
    const auto ours = [&](const auto& entry) { return entry.first == setting.key.view(); };
    if (std::ranges::none_of(options_.settings, ours)) runner().take(setting);
  }
  void accept(const sensor::OdometrySample& sample) {
    ++odometry_;
    if (!wanted(sample.t)) return;
    runner().take(sample);
    drove_to(sample);
  }
  void accept(const sensor::CarSample& sample) {
    ++odometry_;
    if (!wanted(sample.t)) return;
    if (const std::optional<sensor::OdometrySample> pose = runner().take(sample)) drove_to(*pose);
  }
  void accept(const sensor::BlobFrame& frame) {
    ++frames_;
    if (!wanted(frame.t)) return;
    runner().take(frame);
    ++frames_taken_;
    complete_ = options_.frames && frames_taken_ >= *options_.frames;
  }
  void accept(const record::Heartbeat& beat) {
    if (!wanted(beat.t)) return;
    runner().take(beat);
    compare(beat);
  }
  void accept(const record::ObjectReport& report) { compare(report); }
  void accept(const record::AlertReport& report) { compare(report); }
  void accept(const record::DigestReport& report) { compare(report); }
  void accept(const record::CalibrationDoubt& report) { compare(report); }
  template <class Record>
  void accept(const Record&) {}

 private:
  void drove_to(const sensor::OdometrySample& sample) {
    path_.push_back(runner().pose_of(sample));
    last_ = sample;
  }

  [[nodiscard]] bool wanted(base::Time t) const {
    return (!options_.from || t.to_double() >= *options_.from) && (!options_.to || t.to_double() <= *options_.to);
  }

  template <class Record>
  void compare(const Record& record) {
    if (options_.check) check_.logged(record, reader_.line_number() + 1);
  }

  Runner& runner() {
    if (!runner_) begin_run(record::Header{});
    return *runner_;
  }

  void begin_run(const record::Header& logged) {
    std::string profile = options_.profile;
    if (profile.empty()) profile = std::string(logged.profile.view());
    if (profile.empty()) profile = kDefaultProfile;
    runner_ = make_runner(profile, [this](std::string_view bytes) { own_log_.hear(bytes); });
    if (!runner_) {
      outcome_.complaints.push_back("profile " + profile + " of the log is not known here, " +
                                    std::string(kDefaultProfile) + " is used; others: " + std::string(kProfileNames));
      profile = kDefaultProfile;
      runner_ = make_runner(profile, [this](std::string_view bytes) { own_log_.hear(bytes); });
    }
    profile_ = profile;
    path_.clear();
    signatures_.clear();
    camera_ = options_.camera;
    outcome_.result.alerts.clear();
    outcome_.result.calibration.clear();
    runner_->observe(options_.observer);
    if (options_.pose_noise) runner_->assume(*options_.pose_noise);
    runner_->start_run({record::kStreamFormat, "fencepost", FENCEPOST_VERSION, "host", std::string_view(profile_)});
    if (options_.camera) runner_->take(*options_.camera);
    for (const auto& [key, value] : options_.settings) {
      runner_->take(record::Setting{std::string_view(key), std::string_view(value)});
    }
  }

  // The run's map is read now; another run may follow.
  void end_run() {
    runner_->finish();
    if (options_.check) check_.settle(outcome_.check);
    ResultDocument& result = outcome_.result;
    result.digest = runner_->digest();
    result.profile = profile_;
    result.objects = runner_->objects();
    result.guard = runner_->guard();
    result.sectors = runner_->sectors();
    result.passes = runner_->passes();
    result.path = path_;
    result.pose = path_.empty() ? std::nullopt : std::optional(runner_->pose_of(last_));
    result.signatures = signatures_;
    result.camera = camera_;
    const std::vector<std::string>& complaints = runner_->complaints();
    outcome_.complaints.insert(outcome_.complaints.end(), complaints.begin(), complaints.end());
    add_counters(runner_->counters());
  }

  void add_counters(const console::Counters& counters) {
    RefusedFrames& refused = outcome_.result.log.refused;
    const auto of = [&](console::Refusal reason) { return counters.refused[static_cast<std::size_t>(reason)]; };
    refused.no_pose += of(console::Refusal::kNoPose);
    refused.odometry_gap += of(console::Refusal::kOdometryGap);
    refused.no_camera += of(console::Refusal::kNoCamera);
    refused.queue += of(console::Refusal::kQueue);
    used_ += counters.frames;
  }

  void hear_alert(const record::AlertReport& alert) {
    outcome_.result.alerts.push_back(alert);
    check_.own(alert);
    if (!options_.text) return;
    std::string_view name;
    for (const record::Signature& known : signatures_) {
      if (known.signature == alert.signature) name = known.name.view();
    }
    std::array<char, console::kMaxSentence> sentence{};
    const std::size_t size = console::describe(alert, name, sentence);
    if (size >= 2) options_.text({sentence.data(), size - 2});
  }

  // Repetitions are left out, sentences come when it changes.
  void hear_doubt(const record::CalibrationDoubt& doubt) {
    check_.own(doubt);
    std::vector<record::CalibrationDoubt>& heard = outcome_.result.calibration;
    if (!heard.empty() && heard.back() == doubt) return;
    heard.push_back(doubt);
    if (!options_.text) return;
    std::array<char, console::kMaxSentence> sentence{};
    const std::size_t size = console::describe(doubt, sentence);
    if (size >= 2) options_.text({sentence.data(), size - 2});
  }

  void fill_counts() {
    LogCounts& log = outcome_.result.log;
    const record::Counts& counts = reader_.counts();
    log.records = counts.records;
    log.frames = frames_;
    log.odometry = odometry_;
    log.foreign = counts.foreign;
    for (std::size_t i = 0; i < record::kRejectReasons; ++i) {
      log.rejected[i] = {counts.rejects[i].lines, counts.rejects[i].first_line};
    }
  }

  [[nodiscard]] std::optional<Unreadable> why_unreadable(std::string_view bytes, const std::string& name) const {
    const LogCounts& log = outcome_.result.log;
    if (reader_.other_format()) {
      return Unreadable{name + ":" + std::to_string(reader_.line_number()) + ": stream format " +
                        std::to_string(*reader_.other_format()) + ", this program reads format " +
                        std::to_string(record::kStreamFormat) + "; use the release that wrote the log, or a newer one"};
    }
    if (used_ > 0) return std::nullopt;
    if (bytes.empty()) return Unreadable{name + ": empty; record a run in console mode log and try again"};
    if (log.records == 0) {
      return Unreadable{name + ": no record in " + std::to_string(reader_.line_number()) +
                        " lines; a log has lines such as $FPODO,... and $FPFRM,... (console mode log)"};
    }
    if (log.frames == 0) return Unreadable{name + ": no frame record ($FPFRM); was a camera connected?"};
    std::string message = name + ": none of " + std::to_string(log.frames) + " frames could be used";
    if (log.refused.no_camera > 0) message += "; no calibration ($FPCAM) before them: give one with --camera";
    if (log.refused.no_pose > 0) message += "; no odometry ($FPODO) at their exposure: check latency and clock";
    if (log.refused.odometry_gap > 0) message += "; odometry stopped for more than 0.5 s around them";
    if (options_.from || options_.to) message += "; --from and --to leave out the rest";
    return Unreadable{message};
  }

  const ReplayOptions& options_;
  ReplayOutcome outcome_;
  OwnLog own_log_;
  Check check_;
  std::unique_ptr<Runner> runner_;
  std::string profile_;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
  std::vector<PoseResult> path_;
  sensor::OdometrySample last_;  ///< of the path
  std::vector<record::Signature> signatures_;
  std::optional<sensor::CameraIntrinsics> camera_;
  std::uint64_t frames_ = 0;
  std::uint64_t frames_taken_ = 0;
  std::uint64_t odometry_ = 0;
  std::uint64_t used_ = 0;
  bool complete_ = false;
};

}  // namespace

ReplayOutcome replay(std::string_view bytes, const std::string& name, const ReplayOptions& options) {
  return Replay(options).run(bytes, name);
}

}  // namespace fencepost::host
