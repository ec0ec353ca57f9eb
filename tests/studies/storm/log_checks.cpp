#include "tests/studies/storm/log_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "firmware/record/stream_reader.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

constexpr std::string_view kOutputs[] = {"$FPALR,", "$FPOBJ,", "$FPDIG,", "$FPPOS,", "$FPALV,", "$FPSPD,"};

/// Tolerance of a heartbeat's time: an input may have been on its way for as long.
constexpr base::Duration kSlack = base::milliseconds(50);

bool is_output(std::string_view line) {
  return std::any_of(std::begin(kOutputs), std::end(kOutputs), [&](auto kind) { return line.starts_with(kind); });
}

/// Reads the log in order, as a person would who believes it.
class Reader {
 public:
  Reader(const Ended& ended, std::vector<Fault>& faults) : ended_(ended), faults_(faults) {}

  void accept(const record::Header&) {
    levels_.clear();
    beat_.reset();
  }
  void accept(const record::Heartbeat& beat) {
    const base::Duration most = base::milliseconds(100) + ended_.longest_turn + kSlack;
    if (beat_ && complete() && beat.t - *beat_ > most) {
      fault("heartbeat", fmt::format("{:.3f} s after {:.3f} s", beat.t.to_double(), beat_->to_double()));
    }
    if (beat_ && beat.t <= *beat_) fault("heartbeat", fmt::format("{:.3f} s twice", beat.t.to_double()));
    beat_ = beat.t;
  }
  void accept(const record::AlertReport& alert) {
    ++figures.alerts;
    figures.stops += alert.level == AlertLevel::kStop ? 1U : 0U;
    figures.blind += alert.level == AlertLevel::kBlind ? 1U : 0U;
    const auto before = levels_.find(alert.id);
    const bool in_force = before != levels_.end() && before->second != AlertLevel::kClear;
    if (alert.level == AlertLevel::kClear && !in_force && complete()) {
      fault("clear", fmt::format("clear of {} at {:.4f} s, of which nothing was said", alert.id, alert.t.to_double()));
    }
    if (alert.level == AlertLevel::kBlind && alert.id != record::kNoObject) fault("alert", "an object is blind");
    levels_[alert.id] = alert.level;
  }
  void accept(const record::Setting& setting) { settings_[std::string(setting.key.view())] = setting.value.view(); }
  template <class Record>
  void accept(const Record&) {}

  void check_settings() {
    for (std::size_t i = 0; i < config::kKeys; ++i) {
      const auto key = static_cast<config::Key>(i);
      const auto said = settings_.find(std::string(config::info(key).name));
      if (said == settings_.end() || said->second == ended_.settings.text(key).view()) continue;
      fault("settings",
            fmt::format("{} is {} and the log says {}", said->first, ended_.settings.text(key).view(), said->second));
    }
  }

  LogFigures figures;

 private:
  [[nodiscard]] bool complete() const { return !ended_.choked && ended_.dropped == 0 && !ended_.alerts_off; }
  void fault(const char* check, const std::string& sentence) {
    if (faults_.size() < 20) faults_.push_back({check, "log: " + sentence});
  }

  const Ended& ended_;
  std::vector<Fault>& faults_;
  std::map<std::uint32_t, AlertLevel> levels_;
  std::optional<base::Time> beat_;
  std::map<std::string, std::string> settings_;
};

struct Outputs {
  std::uint64_t alerts = 0;
  std::uint64_t others = 0;

  void add(std::string_view line) {
    if (!is_output(line)) return;
    ++(line.starts_with(kOutputs[0]) ? alerts : others);
  }
};

}  // namespace

LogFigures check_log(std::string_view log, const Ended& ended, std::vector<Fault>& faults) {
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader lines(buffer);
  Reader reader(ended, faults);
  Outputs logged;
  for (std::size_t begin = 0; begin < log.size();) {
    const std::size_t end = std::min(log.find('\n', begin), log.size() - 1) + 1;
    logged.add(log.substr(begin, end - begin));
    for (const char byte : log.substr(begin, end - begin)) lines.push(byte, reader);
    begin = end;
  }
  if (ended.whole) reader.check_settings();
  if (ended.frames == 0 || log.find("$FPFRM,") == std::string_view::npos) return reader.figures;  // nothing to replay

  Outputs own;
  host::ReplayOptions options;
  options.check = true;
  options.log = [&](std::string_view line) { own.add(line); };
  const host::ReplayOutcome outcome = host::replay(log, "storm.log", options);
  if (outcome.unreadable) {
    if (ended.whole && ended.in_the_map > 0) faults.push_back({"unreadable", outcome.unreadable->message});
    return reader.figures;
  }
  reader.figures.compared = outcome.check.compared;
  if (ended.whole && outcome.result.digest != ended.digest) {
    const host::LogCounts& counts = outcome.result.log;
    faults.push_back(
        {"digest",
         fmt::format("the replay's digest is {:016x}, the robot's {:016x}; of {} frames it refuses {} without "
                     "a pose, {} in a gap; the robots used {}",
                     outcome.result.digest, ended.digest, counts.frames, counts.refused.no_pose,
                     counts.refused.odometry_gap, ended.frames)});
  }
  if (outcome.result.log.refused.queue > 0) {
    faults.push_back({"refused", fmt::format("the replay refuses {} frames", outcome.result.log.refused.queue)});
  }
  if (outcome.check.differing > 0) {
    faults.push_back(
        {"check", fmt::format("{} records differ: {}", outcome.check.differing, outcome.check.mismatches[0])});
  }
  const std::uint64_t missing_alerts = ended.alerts_off || own.alerts < logged.alerts ? 0 : own.alerts - logged.alerts;
  const std::uint64_t missing = missing_alerts + (own.others < logged.others ? 0 : own.others - logged.others);
  if (ended.whole && missing > ended.dropped) {
    faults.push_back({"silent-loss", fmt::format("{} records are missing, {} alerts among them; {} were said to be "
                                                 "dropped",
                                                 missing, missing_alerts, ended.dropped)});
  }
  return reader.figures;
}

}  // namespace fencepost::test
