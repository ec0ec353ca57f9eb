#include "host/live/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "firmware/loop/motion_permit.hpp"
#include "hal/linux/wait.hpp"
#include "host/live/log_keeper.hpp"
#include "host/text/plural.hpp"

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
        loop_(make_live_loop(plan.profile, *parts.devices.camera, *parts.devices.odometry, console_, plan.mode)),
        begun_(parts.clock.now()),
        log_(parts.log, parts.say, plan.ends_without_log ? "" : "; the run goes on without a log", begun_) {}

  RunSummary go() {
    for (const std::string& complaint : loop_->start(header_of(plan_), parts_.devices.intrinsics, plan_.robot)) {
      parts_.say(complaint);
    }
    if (plan_.console_is_people) {
      parts_.devices.camera->leave_sentences_to_others();
      parts_.devices.odometry->leave_sentences_to_others();
    }
    bool more = true;
    while (!ended(more)) {
      const base::Time before = parts_.clock.now();
      more = turn();
      show_alert();
      note_stall(parts_.clock.now() - before);
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
    if (inputs_must_wait()) {
      loop_->flush();
      write_log(now);
      return false;
    }
    const auto before = std::chrono::steady_clock::now();
    const bool more = loop_->step(now);
    const auto took = std::chrono::steady_clock::now() - before;
    loop_->note_turn(static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(took).count()));
    say_link_messages();
    follow_alerts();
    parts_.devices.camera->console_gave(loop_->frames_logged());
    parts_.devices.odometry->console_gave(loop_->counters().odometry);
    write_log(now);
    watch_output();
    return more;
  }

  void say_link_messages() {
    for (const std::string& sentence : loop_->link_messages()) parts_.say(sentence);
  }

  void write_log(base::Time now) {
    const std::span<const char> waiting = loop_->journal();
    const std::string_view lines(waiting.data(), waiting.size());
    const std::size_t taken = log_.take(lines, now);
    count_alerts(lines.substr(0, taken));
    if (parts_.follower) parts_.follower(lines.substr(0, taken));
    loop_->journal_taken(taken);
    followed_ -= std::min(followed_, taken);
  }

  // Before the log takes them: a slow disk must not hold up a stop.
  void follow_alerts() {
    if (parts_.outputs.empty()) return;
    const std::span<const char> waiting = loop_->journal();
    alerts_.take(std::string_view(waiting.data(), waiting.size()).substr(followed_));
    followed_ = waiting.size();
  }

  void show_alert() {
    const base::Time now = parts_.clock.now();
    AlertNow alert;
    alert.beat = loop_->in_force();
    const console::Links links{parts_.devices.camera->link(), parts_.devices.odometry->link()};
    alert.may_move = permit_.judge(alert.beat, links, now) && !loop_->held();
    alert.speed_limit = loop_->speed_limit(alert.beat);
    parts_.devices.odometry->allow_motion(drive_.judge(alert.may_move, alert.beat.level, alert.speed_limit), now);
    if (parts_.outputs.empty()) return;
    alerts_.complete(alert);
    for (AlertOutput* output : parts_.outputs) output->show(alert, now);
    say_output_messages();
  }
  void end_outputs() {
    parts_.devices.odometry->stand(parts_.clock.now());
    for (AlertOutput* output : parts_.outputs) output->end(parts_.clock.now());
    say_output_messages();
  }
  void say_output_messages() {
    for (AlertOutput* output : parts_.outputs) {
      for (const std::string& sentence : output->messages()) parts_.say(sentence);
    }
  }

  void count_alerts(std::string_view lines) {
    while (!lines.empty()) {
      if (lines.starts_with("$FPALR,")) ++summary_.alerts;
      lines.remove_prefix(std::min(lines.find('\n'), lines.size() - 1) + 1);
    }
  }

  // A recorded stream played into the console can wait; a robot cannot, so its inputs are refused.
  [[nodiscard]] bool inputs_must_wait() const {
    const bool recorded = !parts_.devices.camera->cabled() && !parts_.devices.odometry->cabled();
    return recorded && parts_.console.input_waits() && log_.behind();
  }

  // A robot must not stop warning because one reader is missing.
  void watch_output() {
    const auto lost = parts_.console.lost();
    if (lost && !std::exchange(said_lost_, true)) {
      parts_.say(*lost + (parts_.log != nullptr               ? "; the run and its log go on"
                          : plan_.mode == console::Mode::kLog ? "; the run goes on, its records are lost"
                                                              : "; the run goes on unseen"));
    }
    const bool stuck = parts_.log == nullptr && !lost && console_.stuck() >= LogKeeper::kSlow;
    if (stuck && plan_.mode == console::Mode::kLog && !std::exchange(said_stuck_, true)) {
      parts_.say(
          "the console has taken no record for 2 s: inputs are refused, and counted, until it does; --log FILE "
          "keeps a log whatever the console does");
    }
  }

  void wait() {
    linux::WaitSet set;
    set.add_readable(parts_.interrupted_descriptor);
    parts_.devices.camera->watch(set);
    parts_.devices.odometry->watch(set);
    if (!inputs_must_wait()) parts_.console.watch(set, loop_->output_waits());
    const base::Duration patience = std::min(parts_.devices.camera->patience(), parts_.devices.odometry->patience());
    base::Time deadline = parts_.clock.now() + patience;
    if (log_.behind() || loop_->output_waits()) deadline = std::min(deadline, parts_.clock.now() + kSoon);
    if (!parts_.outputs.empty()) deadline = std::min(deadline, parts_.clock.now() + kShowInterval);
    if (plan_.duration) deadline = std::min(deadline, begun_ + *plan_.duration);
    static_cast<void>(set.wait_until(parts_.clock, deadline));
    note_stall(parts_.clock.now() - deadline);
  }
  void note_stall(base::Duration time) { summary_.stalled = std::max(summary_.stalled, time); }

  bool ended(bool more) {
    if (parts_.interrupted != 0) {
      summary_.end = RunSummary::End::kInterrupted;
    } else {
      const bool inputs = more || log_.behind() || !nothing_can_come();
      const bool frames = plan_.frames && loop_->frames_logged() >= *plan_.frames;
      const bool time = plan_.duration && parts_.clock.now() - begun_ >= *plan_.duration;
      const bool log = plan_.ends_without_log && log_.failed();
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

  // As long as the disk moves; LogKeeper gives it up when it does not.
  void finish_log() {
    write_log(parts_.clock.now());
    while (!loop_->journal().empty()) {
      linux::WaitSet set;
      static_cast<void>(set.wait_until(parts_.clock, parts_.clock.now() + kSoon));
      write_log(parts_.clock.now());
    }
    log_.close(parts_.clock.now());
  }

  void finish() {
    loop_->finish();
    end_outputs();
    summary_.time = parts_.clock.now() - begun_;
    flush_console();
    finish_log();
    summary_.console_lost = parts_.console.finish(kPatience) + console_.lost();
    watch_output();
    summary_.counters = loop_->counters();
    summary_.digest = loop_->digest();
    summary_.output_failed = parts_.log == nullptr && summary_.console_lost > 0 && parts_.console.lost();
    summary_.log_failed = log_.failed();
    summary_.log_lost = log_.lost();
    summary_.log_until = log_.until();
    if (parts_.log == nullptr) return;
    summary_.log = parts_.log->name();
    summary_.log_bytes = parts_.log->bytes();
  }

  /// Time after which the disk or the console is tried again.
  static constexpr base::Duration kSoon = base::milliseconds(10);
  /// At the end the console's output is waited for as long as something of it is written this often.
  static constexpr std::chrono::milliseconds kPatience{10'000};

  const RunPlan& plan_;
  const RunParts& parts_;
  PatientConsole console_;
  std::unique_ptr<LiveLoop> loop_;
  base::Time begun_;
  LogKeeper log_;
  bool said_lost_ = false;
  bool said_stuck_ = false;
  AlertFollower alerts_;
  std::size_t followed_ = 0;  ///< bytes of the journal
  loop::MotionPermit permit_;
  loop::DrivePermit drive_;
  RunSummary summary_;
};

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
                                 plural(counters.frames, "frame"), plural(counters.odometry, "odometry sample"),
                                 refused_in(counters), counters.rejected, plural(alerts, "alert"));
  if (console_lost > 0) text += ", " + plural(console_lost, "byte") + " that the console did not take";
  if (stalled >= linux::kNotedDelay) {
    text += fmt::format("\nthis machine was busy: inputs waited for up to {:.0f} ms", 1000 * stalled.to_double());
  }
  text += fmt::format("\ndigest {:016x}", digest);
  if (log.empty()) return text;
  text += fmt::format(", log {} ({}", log, plural(log_bytes, "byte"));
  if (log_failed)
    text += fmt::format(", broken off after {:.1f} s: without {}", log_until.to_double(), plural(log_lost, "byte"));
  return text + ")";
}

RunSummary run_live(const RunPlan& plan, const RunParts& parts) { return Run(plan, parts).go(); }

}  // namespace fencepost::host
