#include "host/live/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "hal/linux/wait.hpp"

namespace fencepost::host {
namespace {

record::Header header_of(const RunPlan& plan) {
  record::Header header;
  header.product = "fencepost";
  header.version = sensor::Text(plan.version);
  header.target = "linux";
  return header;
}

class Run {
 public:
  Run(const RunPlan& plan, const RunParts& parts)
      : plan_(plan),
        parts_(parts),
        console_(parts.console, parts.log != nullptr),
        loop_(make_live_loop(plan.profile, *parts.devices.camera, *parts.devices.odometry, console_, plan.mode)) {}

  RunSummary go() {
    for (const std::string& complaint : loop_->start(header_of(plan_), parts_.devices.intrinsics, plan_.robot)) {
      parts_.say(complaint);
    }
    if (plan_.console_is_people) {
      parts_.devices.camera->leave_sentences_to_others();
      parts_.devices.odometry->leave_sentences_to_others();
    }
    begun_ = parts_.clock.now();
    bool more = true;
    while (!ended(more)) {
      more = turn();
      if (!more) wait();
    }
    finish();
    return summary_;
  }

 private:
  bool turn() {
    const base::Time now = parts_.clock.now();
    parts_.devices.odometry->tend(now);
    parts_.devices.camera->tend(now);
    console_.tend(now);
    const auto before = std::chrono::steady_clock::now();
    const bool more = loop_->step(now);
    const auto took = std::chrono::steady_clock::now() - before;
    loop_->note_turn(static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(took).count()));
    say_link_news();
    parts_.devices.camera->console_gave(loop_->frames_logged());
    parts_.devices.odometry->console_gave(loop_->counters().odometry);
    write_log(now);
    return more;
  }

  void say_link_news() {
    for (const std::string& sentence : loop_->link_news()) parts_.say(sentence);
  }

  // Line by line: a part of the log ends at the right one, with the calibration of that place.
  void write_log(base::Time now) {
    const std::span<const char> waiting = loop_->journal();
    std::string_view lines(waiting.data(), waiting.size());
    while (!lines.empty()) {
      const std::string_view line = lines.substr(0, lines.find('\n') + 1);
      if (line.starts_with("$FPALR,")) ++summary_.alerts;
      if (log_works()) note(parts_.log->write(line, now));
      lines.remove_prefix(line.size());
    }
    loop_->journal_taken(waiting.size());
    if (log_works()) note(parts_.log->tend(now));
  }
  [[nodiscard]] bool log_works() const { return parts_.log != nullptr && !summary_.log_failed; }

  // A robot must not stop warning because a disk is full.
  void note(const RunLog::Fault& fault) {
    if (!fault) return;
    summary_.log_failed = true;
    parts_.say(fault->sentence + (plan_.ends_without_log ? "" : "; the run goes on without a log"));
  }

  void wait() {
    linux::WaitSet set;
    set.add_readable(parts_.interrupted_descriptor);
    parts_.devices.camera->watch(set);
    parts_.devices.odometry->watch(set);
    parts_.console.watch(set, loop_->output_waits());
    const base::Duration patience = std::min(parts_.devices.camera->patience(), parts_.devices.odometry->patience());
    base::Time deadline = parts_.clock.now() + patience;
    if (plan_.duration) deadline = std::min(deadline, begun_ + *plan_.duration);
    static_cast<void>(set.wait_until(parts_.clock, deadline));
  }

  bool ended(bool more) {
    if (parts_.interrupted != 0) {
      summary_.end = RunSummary::End::kInterrupted;
    } else if (parts_.console.closed() && parts_.log == nullptr) {
      summary_.end = RunSummary::End::kConsoleClosed;
    } else {
      const bool inputs = more || !nothing_can_come();
      const bool frames = plan_.frames && loop_->frames_logged() >= *plan_.frames;
      const bool time = plan_.duration && parts_.clock.now() - begun_ >= *plan_.duration;
      const bool log = plan_.ends_without_log && summary_.log_failed;
      return frames || time || log || !inputs;
    }
    return true;
  }

  // Both sensors are lines of the console, and that has ended.
  [[nodiscard]] bool nothing_can_come() const {
    return !parts_.devices.camera->cabled() && !parts_.devices.odometry->cabled() && parts_.console.ended();
  }

  void flush_console() {
    base::Time now = parts_.clock.now();
    const base::Time deadline = now + base::milliseconds(1'000);
    while (loop_->output_waits() && now < deadline) {
      console_.tend(now);
      loop_->flush();
      if (!loop_->output_waits()) return;
      linux::WaitSet set;
      parts_.console.watch(set, true);
      static_cast<void>(set.wait_until(parts_.clock, now + base::milliseconds(50)));
      now = parts_.clock.now();
    }
  }

  void finish() {
    loop_->finish();
    flush_console();
    write_log(parts_.clock.now());
    if (log_works()) note(parts_.log->close());
    summary_.time = parts_.clock.now() - begun_;
    summary_.counters = loop_->counters();
    summary_.digest = loop_->digest();
    summary_.console_lost = console_.lost();
    if (parts_.log == nullptr) return;
    summary_.log = parts_.log->name();
    summary_.log_bytes = parts_.log->bytes();
  }

  const RunPlan& plan_;
  const RunParts& parts_;
  PatientConsole console_;
  std::unique_ptr<LiveLoop> loop_;
  base::Time begun_;
  RunSummary summary_;
};

std::string counted(std::uint64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string refused_in(const console::Counters& counters) {
  constexpr std::array<std::string_view, console::kRefusals> kNames = {"no_pose", "odometry_gap", "no_camera", "queue"};
  std::uint64_t sum = 0;
  std::string reasons;
  for (std::size_t i = 0; i < console::kRefusals; ++i) {
    sum += counters.refused[i];
    if (counters.refused[i] > 0)
      reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", kNames[i], counters.refused[i]);
  }
  return sum == 0 ? "0 refused" : fmt::format("{} refused ({})", sum, reasons);
}

}  // namespace

std::string RunSummary::sentence() const {
  std::string text = fmt::format("{:.1f} s: {}, {}, {}, {} rejected, {}", time.to_double(),
                                 counted(counters.frames, "frame"), counted(counters.odometry, "odometry sample"),
                                 refused_in(counters), counters.rejected, counted(alerts, "alert"));
  if (console_lost > 0) text += fmt::format(", {} bytes that the console did not take", console_lost);
  text += fmt::format("\ndigest {:016x}", digest);
  if (!log.empty()) text += fmt::format(", log {} ({} bytes{})", log, log_bytes, log_failed ? ", broken off" : "");
  return text;
}

RunSummary run_live(const RunPlan& plan, const RunParts& parts) { return Run(plan, parts).go(); }

}  // namespace fencepost::host
