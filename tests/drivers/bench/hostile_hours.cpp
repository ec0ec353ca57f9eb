#include "tests/drivers/bench/hostile_hours.hpp"

#include <algorithm>

#include "tests/drivers/bench/faults.hpp"

namespace fencepost::test {
namespace {

/// The course of it, a step at a time. `calm`: from the first right sample after a fault to the next fault; only then
/// a frame can be said to be lost.
class HostileHours {
 public:
  HostileHours(Subject& subject, std::uint32_t seed) : subject_(subject), faults_(seed + 1) {}

  HostileFigures run(double hours) {
    const auto end = base::Time{static_cast<std::int64_t>(hours * kTicksAnHour)};
    const base::Time tenth = base::Time{end.raw / 10};
    while (subject_.now() < end) {
      if (subject_.now() < tenth) heap_at_first_ = heap_in_use();
      step();
    }
    figures_.hours = hours;
    figures_.corrupted = subject_.plug().corrupted();
    figures_.faults = faults_.count();
    figures_.disorder = subject_.disorder();
    subject_.count(said_);
    figures_.said = said_.value();
    figures_.heap_growth = static_cast<std::int64_t>(heap_in_use()) - static_cast<std::int64_t>(heap_at_first_);
    return figures_;
  }

 private:
  void step() {
    const base::Time now = subject_.now();
    begin_fault(now);
    if (in_fault_ && faults_.over(now)) end_fault(now);
    const std::uint64_t whole = subject_.plug().whole_frames();
    const std::uint64_t corrupted = subject_.plug().corrupted();
    const auto sample = subject_.step();
    note_link();
    figures_.longest_queue = std::max(figures_.longest_queue, subject_.waiting());
    if (calm_) {
      figures_.whole += subject_.plug().whole_frames() - whole;
      figures_.corrupted_in_calm += subject_.plug().corrupted() - corrupted;
      figures_.longest_gap = std::max(figures_.longest_gap, subject_.now() - last_);
    } else if (!in_fault_) {
      figures_.longest_recovery = std::max(figures_.longest_recovery, subject_.now() - over_);
    }
    if (sample) take(*sample);
  }

  void note_link() {
    if (subject_.link() == link_) return;
    link_ = subject_.link();
    said_.u8(static_cast<std::uint8_t>(link_));
    said_.i64(subject_.now().raw);
  }

  void take(const Seen& sample) {
    ++figures_.samples;
    subject_.say(said_);
    last_ = subject_.now();
    if (!sample.right) {
      // Samples held back by a stalled line come late and do not count as damaged.
      const bool held_back = !calm_ && sample.old;
      ++(held_back ? figures_.held_back : figures_.undetected);
    } else if (calm_) {
      ++figures_.right_in_calm;
    } else if (!in_fault_) {
      calm_ = true;
    }
  }

  void begin_fault(base::Time now) {
    const Faults::Kind kind = faults_.begin(now);
    if (kind == Faults::Kind::kNone) return;
    in_fault_ = true;
    calm_ = false;
    if (kind == Faults::Kind::kStall) subject_.plug().stall();
    if (kind == Faults::Kind::kReboot) subject_.restart();
    if (kind == Faults::Kind::kUnplug) subject_.unplug();
  }

  void end_fault(base::Time now) {
    subject_.plug().resume();
    subject_.plug().replug();
    in_fault_ = false;
    over_ = now;
  }

  static constexpr std::int64_t kTicksAnHour = 36'000'000;

  Subject& subject_;
  Faults faults_;
  HostileFigures figures_;
  base::Fnv1a64 said_;
  sensor::LinkState link_ = sensor::LinkState::kAbsent;
  bool in_fault_ = false;
  bool calm_ = false;
  base::Time over_;
  base::Time last_;
  std::uint64_t heap_at_first_ = 0;
};

}  // namespace

HostileFigures run_hostile_hours(const HostileCase& driver, double hours, std::uint32_t seed) {
  constexpr double kCorruption = 0.01;
  const auto subject = driver.make(Damage{kCorruption, seed});
  return HostileHours(*subject, seed).run(hours);
}

}  // namespace fencepost::test
