#include "host/replay/log_replay.hpp"

#include <algorithm>

#include "firmware/console/text.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kDefaultProfile = "full";
constexpr std::size_t kMaxDoubts = 1U << 16U;

// Adds this run's refused frames.
void add_refused(const console::Counters& counters, RefusedFrames& refused) {
  const auto of = [&](console::Refusal reason) { return counters.refused[static_cast<std::size_t>(reason)]; };
  refused.no_pose += of(console::Refusal::kNoPose);
  refused.odometry_gap += of(console::Refusal::kOdometryGap);
  refused.no_camera += of(console::Refusal::kNoCamera);
  refused.queue += of(console::Refusal::kQueue);
}

}  // namespace

LogReplay::LogReplay(const ReplayOptions& options)
    : options_(options),
      own_log_({options.log, [this](const auto& alert) { hear_alert(alert); },
                [this](const auto& object) { hear(object); }, [this](const auto& digest) { hear(digest); },
                [this](const auto& beat) { hear(beat); }, [this](const auto& limit) { hear(limit); },
                [this](const auto& doubt) { hear_doubt(doubt); }}),
      path_(options.most_poses) {}

std::optional<record::LineOutcome> LogReplay::take(std::string_view& bytes) {
  if (reader_.line_number() == 0) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    returns_ += std::count(line.begin(), line.end(), '\r');
  }
  if (!options_.check) return reader_.take(bytes, *this);
  for (std::size_t i = 0; i < bytes.size() && started_ < start_.size() && bytes[i] != '\n'; ++i) {
    start_[started_++] = bytes[i];
  }
  const std::optional<record::LineOutcome> line = reader_.take(bytes, *this);
  if (!line) return line;
  check_.unread({start_.data(), started_}, *line);
  started_ = 0;
  return line;
}

std::optional<record::LineOutcome> LogReplay::finish() {
  std::optional<record::LineOutcome> line;
  if (!complete_) line = reader_.finish();
  if (runner_) end_run();
  over_ = true;
  return line;
}

void LogReplay::accept(const record::Header& header) {
  if (runs_ == options_.run) {
    complete_ = true;
    return;
  }
  if (runner_) end_run();
  if (!headed_) check_.withdraw();
  headed_ = true;
  begin_run(header);
}

void LogReplay::accept(const sensor::CameraIntrinsics& camera) {
  runner().take(camera);
  camera_ = camera;
}

void LogReplay::accept(const record::Signature& signature) {
  runner().take(signature);
  signatures_.push_back(signature);
  for (std::size_t i = 0; i + 1 < signatures_.size(); ++i) {
    if (signatures_[i].signature != signature.signature) continue;
    signatures_[i] = signature;
    signatures_.pop_back();
    break;
  }
}

void LogReplay::accept(const record::Setting& setting) {
  const auto ours = [&](const auto& entry) { return entry.first == setting.key.view(); };
  const auto& set = options_.settings;
  if (std::none_of(set.begin(), set.end(), ours)) runner().take(setting);
}

void LogReplay::accept(const sensor::OdometrySample& sample) {
  ++odometry_;
  if (!pass_to(sample.t)) return;
  runner().take(sample);
  drove_to(sample);
}

void LogReplay::accept(const sensor::CarSample& sample) {
  ++odometry_;
  if (!pass_to(sample.t)) return;
  if (const std::optional<sensor::OdometrySample> pose = runner().take(sample)) drove_to(*pose);
}

void LogReplay::accept(const sensor::BlobFrame& frame) {
  ++frames_;
  if (!pass_to(frame.t)) return;
  runner().take(frame);
  ++frames_taken_;
  complete_ = options_.frames && frames_taken_ >= *options_.frames;
}

void LogReplay::accept(const record::Heartbeat& beat) {
  if (!pass_to(beat.t)) return;
  runner().take(beat);
  compare(beat);
}

void LogReplay::drove_to(const sensor::OdometrySample& sample) {
  path_.add(runner().pose_of(sample));
  last_ = sample;
}

bool LogReplay::pass_to(base::Time t) {
  const double seconds = t.to_double();
  if ((options_.from && seconds < *options_.from) || (options_.to && seconds > *options_.to)) return false;
  time_ = std::max(time_, seconds);
  return true;
}

Runner& LogReplay::runner() {
  if (!runner_) begin_run(record::Header{});
  return *runner_;
}

void LogReplay::begin_run(const record::Header& logged) {
  std::string profile = options_.profile;
  if (profile.empty()) profile = std::string(logged.profile.view());
  if (profile.empty()) profile = kDefaultProfile;
  const auto make = [this](const std::string& name) {
    const bool inputs = options_.log != nullptr;  // whoever writes a log wants the whole of it
    return make_runner(
        name, [this](std::string_view bytes) { own_log_.hear(bytes); }, inputs);
  };
  runner_ = make(profile);
  if (!runner_) {
    complaints_.add("profile " + profile + " of the log is not known here, " + std::string(kDefaultProfile) +
                    " is used; others: " + std::string(kProfileNames));
    profile = kDefaultProfile;
    runner_ = make(profile);
  }
  profile_ = profile;
  path_.clear();
  time_ = 0;
  ++runs_;
  signatures_.clear();
  camera_ = options_.camera;
  alerts_.clear();
  if (options_.alerts != nullptr) options_.alerts->run_begins();
  calibration_.clear();
  runner_->observe(options_.observer);
  if (options_.pose_noise) runner_->assume(*options_.pose_noise);
  runner_->start_run({record::kStreamFormat, "fencepost", FENCEPOST_VERSION, "host", std::string_view(profile_)});
  if (options_.camera) runner_->take(*options_.camera);
  for (const auto& [key, value] : options_.settings) {
    runner_->take(record::Setting{std::string_view(key), std::string_view(value)});
  }
}

// Another run may follow.
void LogReplay::end_run() {
  runner_->finish();
  if (options_.check) check_.settle();
  complaints_.add(runner_->complaints());
  add_refused(runner_->counters(), before_.refused);
  used_ += runner_->counters().frames;
}

ResultDocument LogReplay::now(bool with_path) const {
  ResultDocument result;
  fill_counts(result.log);
  result.alerts = alerts_;
  result.calibration = calibration_;
  if (!runner_) return result;
  result.digest = runner_->digest();
  result.profile = profile_;
  result.objects = runner_->objects();
  result.guard = runner_->guard();
  result.sectors = runner_->sectors();
  result.ways = runner_->ways();
  result.speed_limit = runner_->speed_limit().speed;
  result.passes = runner_->passes();
  if (with_path) result.path = path_.to_the_end();
  result.pose = path_.empty() ? std::nullopt : std::optional(runner_->pose_of(last_));
  result.signatures = signatures_;
  result.camera = camera_;
  return result;
}

void LogReplay::hear_alert(const record::AlertReport& alert) {
  if (options_.alerts != nullptr) {
    options_.alerts->hear(alert);
  } else {
    alerts_.push_back(alert);
  }
  hear(alert);
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
void LogReplay::hear_doubt(const record::CalibrationDoubt& doubt) {
  hear(doubt);
  if (!calibration_.empty() && calibration_.back() == doubt) return;
  if (calibration_.size() == kMaxDoubts) {
    complaints_.add("only the first " + std::to_string(kMaxDoubts) + " doubts about the calibration are listed");
    return;
  }
  calibration_.push_back(doubt);
  if (!options_.text) return;
  std::array<char, console::kMaxSentence> sentence{};
  const std::size_t size = console::describe(doubt, sentence);
  if (size >= 2) options_.text({sentence.data(), size - 2});
}

void LogReplay::fill_counts(LogCounts& log) const {
  const record::Counts& counts = reader_.counts();
  log.records = counts.records;
  log.frames = frames_;
  log.odometry = odometry_;
  log.foreign = counts.foreign;
  log.refused = before_.refused;
  if (runner_ && !over_) add_refused(runner_->counters(), log.refused);
  for (std::size_t i = 0; i < record::kRejectReasons; ++i) {
    log.rejected[i] = {counts.rejects[i].lines, counts.rejects[i].first_line};
  }
}

std::optional<Unreadable> LogReplay::why_unreadable(const std::string& name) const {
  LogCounts log;
  fill_counts(log);
  if (reader_.other_format()) {
    return Unreadable{name + ":" + std::to_string(reader_.line_number()) + ": stream format " +
                      std::to_string(*reader_.other_format()) + ", this program reads format " +
                      std::to_string(record::kStreamFormat) + "; use the release that wrote the log, or a newer one"};
  }
  if (options_.run && runs_ < *options_.run && runs_ > 0) {
    return Unreadable{name + ": there is no run " + std::to_string(*options_.run) + " in it, the last is " +
                      std::to_string(runs_) + "; leave out --run for that one"};
  }
  if (used_ > 0) return std::nullopt;
  if (reader_.line_number() == 0) return Unreadable{name + ": empty; record a run in console mode log and try again"};
  if (log.records == 0 && reader_.line_number() == 1 && returns_ > 1) {
    return Unreadable{name + ": its lines end with CR alone; make them end with LF: tr '\\r' '\\n'"};
  }
  if (log.records == 0) {
    return Unreadable{name + ": no record in " + plural(reader_.line_number(), "line") +
                      "; a log has lines such as $FPODO,... and $FPFRM,... (console mode log)"};
  }
  if (log.frames == 0) return Unreadable{name + ": no frame record ($FPFRM); was a camera connected?"};
  std::string message = name + ": no frame of " + std::to_string(log.frames) + " could be used";
  if (log.refused.no_camera > 0) message += "; no calibration ($FPCAM) before them: give one with --camera";
  if (log.refused.no_pose > 0) message += "; no odometry ($FPODO) at their exposure: check latency and clock";
  if (log.refused.odometry_gap > 0) message += "; odometry stopped for more than 0.5 s around them";
  if (options_.from || options_.to) message += "; --from and --to leave out the rest";
  return Unreadable{message};
}

}  // namespace fencepost::host
