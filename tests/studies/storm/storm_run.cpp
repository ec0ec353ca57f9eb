#include "tests/studies/storm/storm_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "firmware/config/colours.hpp"
#include "host/devices/open_devices.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/storm/bench.hpp"
#include "tests/studies/storm/disk.hpp"
#include "tests/studies/storm/flash_check.hpp"
#include "tests/studies/storm/memory_console.hpp"

namespace fencepost::test {
namespace {

constexpr base::Duration kDiskInterval = base::milliseconds(200);
constexpr std::uint64_t kLostInTheQueue = 256;  // lines, of a robot that loses its power

class Storm {
 public:
  Storm(const Plan& plan, Plant plant)
      : plan_(plan),
        plant_(plant),
        chance_(plan.seed + 0x5709),
        console_(plan.console_is_log()),
        patient_(console_, !plan.console_is_log()),
        bench_(plan) {
    console_.set_speed(plan.console_speed);
    if (plan.disk()) disk_.emplace();
    switch_on(plan.clock);
    flash_check_.begin(robot_->kept());
    robot_->tell(plan.configured);
  }

  RunOutcome go() {
    while (world_ < base::Time{} + base::milliseconds(plan_.milliseconds)) {
      const std::int64_t ms = chance_.whole(1, plan_.turn_ms);
      turn(base::milliseconds(ms));
    }
    drain();
    finish();
    return std::move(outcome_);
  }

 private:
  std::vector<Fault>& faults() { return outcome_.faults; }
  void fault(const char* check, const std::string& sentence) {
    faults().push_back({check, fmt::format("{:.3f} s: {}", world_.to_double(), sentence)});
  }

  // --- the robot's power ---

  void switch_on(base::Time clock) {
    clock_ = clock;
    booted_ = world_;
    last_turn_ = world_;
    patient_.tend(robot_now());
    devices_ = bench_.open_devices();
    robot_ = make_robot(plan_.variant, {*devices_.camera, *devices_.odometry, patient_, flash_}, plan_.mode);
    sensor::CameraIntrinsics delivered = plan_.configured.camera;
    delivered.mount = {};
    robot_->start(delivered);
    watch_.begin(robot_now());
    off_until_.reset();
  }
  void switch_off() {
    counted_.frames += robot_->counters().frames;
    counted_.dropped += robot_->counters().records_dropped + kLostInTheQueue;
    cut_in_write_ = flash_.dead();
    ++outcome_.figures.power_cuts;
    robot_.reset();
    devices_ = {};
    console_.forget_typed();
    if (!off_until_) off_until_ = world_ + base::milliseconds(10);
    cut_at_.reset();
  }
  void switch_on_again() {
    flash_.power_on();
    if (plant_ == Plant::kMixedFlash) plant_mixture(flash_);
    const auto one = plant_ == Plant::kHalfKept && cut_in_write_ ? flash_check_.one_of_several() : std::nullopt;
    if (one) plant_half(flash_, *one);
    switch_on(base::Time{});
    if (const auto wrong = flash_check_.compare(robot_->kept(), cut_in_write_)) fault("flash", *wrong);
    flash_check_.begin(robot_->kept());
  }
  [[nodiscard]] base::Time robot_now() const { return clock_ + (world_ - booted_); }
  [[nodiscard]] base::Time by_robot(base::Time of_world) const { return clock_ + (of_world - booted_); }

  // --- events ---

  void begin_events() {
    while (next_event_ < plan_.events.size() &&
           base::Time{} + base::milliseconds(plan_.events[next_event_].at) <= world_) {
      begin(plan_.events[next_event_++]);
    }
  }
  void begin(const Event& event) {
    const base::Time end = world_ + base::milliseconds(event.length);
    switch (event.kind) {
      case EventKind::kType: console_.type(event.text); break;
      case EventKind::kUnplug:
        if (event.cable == Cable::kConsole) {
          console_.set_plugged(false);
          console_back_ = std::max(console_back_.value_or(end), end);
          break;
        }
        [[fallthrough]];
      case EventKind::kNoise:
      case EventKind::kHostile:
      case EventKind::kStall:
      case EventKind::kFreeze:
      case EventKind::kReboot: bench_.begin(event, world_); break;
      case EventKind::kThrottle:
        console_.set_speed(event.amount);
        throttle_ends_ = std::max(throttle_ends_.value_or(end), end);
        break;
      case EventKind::kSlowDisk:
        if (disk_) disk_->set_open(false);
        disk_back_ = std::max(disk_back_.value_or(end), end);
        break;
      case EventKind::kFullDisk:
        if (disk_) disk_->set_full();
        break;
      case EventKind::kBusy:
        busy_until_ = std::max(busy_until_.value_or(end), end);
        bench_.note_busy(end);
        break;
      case EventKind::kPowerCut:
        if (!robot_ || cut_at_) break;
        console_.type(event.text);
        if (!event.text.empty()) flash_.cut_after(static_cast<std::size_t>(event.amount));
        cut_at_ = world_ + base::milliseconds(event.text.empty() ? 0 : 400);
        off_until_ = *cut_at_ + base::milliseconds(event.length);
        break;
    }
  }
  void end_events() {
    const auto over = [this](std::optional<base::Time>& end) {
      if (!end || *end > world_) return false;
      end.reset();
      return true;
    };
    if (over(console_back_)) console_.set_plugged(true);
    if (over(throttle_ends_)) console_.set_speed(plan_.console_speed);
    if (over(disk_back_) && disk_) disk_->set_open(true);
    static_cast<void>(over(busy_until_));
    if (cut_at_ && robot_ && (*cut_at_ <= world_ || flash_.dead())) switch_off();
    if (!robot_ && off_until_ && *off_until_ <= world_) switch_on_again();
    bench_.end_events(world_);
    const bool choked = throttle_ends_ || disk_back_ || console_back_;
    if (choked) choked_ = world_, ever_choked_ = true;
  }

  // --- a turn ---

  void turn(base::Duration time) {
    world_ = world_ + time;
    console_.pass(time);
    begin_events();
    end_events();
    bench_.advance(world_);
    if (robot_ && !busy_until_) turn_robot();
  }
  void turn_robot() {
    const base::Time now = robot_now();
    longest_turn_ = std::max(longest_turn_, world_ - last_turn_);
    last_turn_ = world_;
    devices_.odometry->tend(now);
    devices_.camera->tend(now);
    patient_.tend(now);
    robot_->turn(now);
    ++outcome_.figures.turns;
    if (plant_ == Plant::kBrokenGuard && outcome_.figures.turns == 1'000) robot_->break_guard();
    if (plan_.console_is_log() && robot_->looked()) flash_check_.note(robot_->kept());
    if (outcome_.figures.turns % 64 == 0) look_around();
    take_journal(now);
    watch(now);
  }
  // Checks that each turn does not need.
  void look_around() {
    if (!robot_->guarded() && !std::exchange(said_guard_, true)) fault("guard", "the words around the memory changed");
    alerts_off_ = alerts_off_ || !robot_->alerts_are_said();
  }
  void take_journal(base::Time now) {
    const std::span<const char> waiting = robot_->journal();
    if (waiting.empty()) return;
    const std::string_view lines(waiting.data(), waiting.size());
    if (!disk_) {
      log_ += lines;
      return robot_->journal_taken(lines.size());
    }
    if (world_ < disk_due_) return;
    disk_due_ = world_ + kDiskInterval;
    robot_->journal_taken(disk_->take(lines, now));
    if (disk_->behind()) choked_ = world_, ever_choked_ = true;
  }
  void watch(base::Time now) {
    const std::uint64_t lost = robot_->counters().records_dropped + robot_->counters().refused_in_all();
    if (!robot_->idle() || lost != lost_) choked_ = world_;
    lost_ = lost;
    Outside outside;
    outside.camera = bench_.line(Cable::kCamera);
    outside.wheels = bench_.line(Cable::kWheels);
    for (Outside::Line* line : {&outside.camera, &outside.wheels}) {
      line->since = by_robot(line->since);
      line->disturbed = by_robot(line->disturbed);
      line->held = by_robot(line->held);
    }
    outside.choked = by_robot(choked_);
    outside.may_drive = output();
    watch_.look(*robot_, outside, now);
  }
  // The STOP output, as motors see it.
  bool output() {
    if (plant_ != Plant::kDeafPin) return robot_->may_drive();
    if (robot_->may_drive()) driven_ = world_;
    return driven_ && world_ - *driven_ < base::milliseconds(1'000);
  }

  // --- the end ---

  void drain() {
    off_until_ = off_until_ ? std::optional(world_) : std::nullopt;
    cut_at_.reset();
    flash_.power_on();
    if (!robot_) switch_on_again();
    busy_until_.reset();
    console_.set_plugged(true);
    console_.set_speed(100'000);
    if (disk_) disk_->set_open(true);
    for (int i = 0; i < 4'000 && (i < 300 || !robot_->idle() || !console_.read_all()); ++i) {
      world_ = world_ + base::milliseconds(1);
      console_.pass(base::milliseconds(1));
      const base::Time now = robot_now();
      patient_.tend(now);
      robot_->turn(now);
      disk_due_ = world_;
      take_journal(now);
    }
    if (!robot_->idle()) fault("busy", "there is no end to what it says");
  }
  void finish() {
    alerts_off_ = alerts_off_ || !robot_->alerts_are_said();
    Ended ended;
    ended.digest = robot_->digest();
    ended.frames = static_cast<std::uint32_t>(counted_.frames + robot_->counters().frames);
    ended.in_the_map = robot_->frames_of_run();
    ended.dropped = counted_.dropped + robot_->counters().records_dropped;
    ended.whole = !disk_ || !disk_->failed();
    ended.alerts_off = alerts_off_;
    ended.longest_turn = longest_turn_;
    ended.choked = ever_choked_ || console_.refused() > 0;
    ended.settings = robot_->settings();
    std::string log = plan_.console_is_log() ? console_.said() : disk_ ? disk_->bytes() : log_;
    if (plant_ == Plant::kLostAlert) lose_line(log, "$FPALR,");
    if (plant_ == Plant::kLostFrame) lose_line(log, "$FPFRM,");
    outcome_.figures.frames = ended.frames;
    outcome_.figures.dropped = ended.dropped;
    outcome_.figures.log_bytes = log.size();
    outcome_.figures.log = check_log(log, ended, faults());
    log_ = std::move(log);
    outcome_.text = std::move(log_);
  }
  // The one in the middle.
  static void lose_line(std::string& log, std::string_view kind) {
    const std::size_t at = log.find(kind, log.size() / 2);
    if (at != std::string::npos) log.erase(at, log.find('\n', at) + 1 - at);
  }

  const Plan& plan_;
  Plant plant_;
  RunOutcome outcome_;
  Chance chance_;
  base::Time world_;
  base::Time clock_;
  base::Time booted_;
  base::Time last_turn_;
  base::Duration longest_turn_;
  MemoryConsole console_;
  host::PatientConsole patient_;
  StormBench bench_;
  StormFlash flash_;
  FlashCheck flash_check_;
  std::optional<Disk> disk_;
  host::Devices devices_;
  std::unique_ptr<StormRobot> robot_;
  Watch watch_{outcome_.faults};
  std::size_t next_event_ = 0;
  std::optional<base::Time> console_back_;
  std::optional<base::Time> throttle_ends_;
  std::optional<base::Time> disk_back_;
  std::optional<base::Time> busy_until_;
  std::optional<base::Time> cut_at_;
  std::optional<base::Time> off_until_;
  std::optional<base::Time> driven_;
  base::Time disk_due_;
  base::Time choked_;
  bool ever_choked_ = false;
  bool alerts_off_ = false;
  bool said_guard_ = false;
  bool cut_in_write_ = false;
  std::uint64_t lost_ = 0;
  struct {
    std::uint64_t frames = 0;
    std::uint64_t dropped = 0;
  } counted_;  ///< of the robots before the last power cut
  std::string log_;
};

}  // namespace

RunOutcome run_storm(const Plan& plan, Plant plant) { return Storm(plan, plant).go(); }

}  // namespace fencepost::test
