// Hours on a bad cable: one byte in a hundred damaged, both ways, and every 20 s a stall, a reboot or an unplug.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>

#include "hal/base/fnv1a.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/faults.hpp"
#include "tests/drivers/bench/hostile_figures.hpp"
#include "tests/drivers/bench/plug.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {

inline constexpr double kCorruption = 0.01;
inline constexpr std::int64_t kTicksAnHour = 36'000'000;

/// The course of it, a step at a time. `calm`: from the first right sample after a fault to the next fault; only then
/// a frame can be said to be lost.
template <class Rig>
class HostileHours {
 public:
  HostileHours(std::uint32_t seed, base::Duration step)
      : bench_(Damage{kCorruption, seed}), faults_(seed + 1), step_(step) {
    bench_.moving = true;
  }

  HostileFigures run(double hours) {
    const auto end = base::Time{static_cast<std::int64_t>(hours * kTicksAnHour)};
    const base::Time tenth = base::Time{end.raw / 10};
    while (bench_.clock.now() < end) {
      if (bench_.clock.now() < tenth) heap_at_first_ = heap_in_use();
      step();
    }
    figures_.hours = hours;
    figures_.corrupted = bench_.link.corrupted();
    figures_.faults = faults_.count();
    figures_.disorder = bench_.disorder;
    note_counts(bench_.driver);
    figures_.said = said_.value();
    figures_.heap_growth = static_cast<std::int64_t>(heap_in_use()) - static_cast<std::int64_t>(heap_at_first_);
    return figures_;
  }

 private:
  void step() {
    const base::Time now = bench_.clock.now();
    begin_fault(now);
    if (in_fault_ && faults_.over(now)) end_fault(now);
    const std::uint64_t whole = bench_.link.whole_frames();
    const std::uint64_t corrupted = bench_.link.corrupted();
    const auto sample = bench_.step(step_);
    note_link();
    figures_.longest_queue = std::max(figures_.longest_queue, bench_.link.waiting());
    if (calm_) {
      figures_.whole += bench_.link.whole_frames() - whole;
      figures_.corrupted_in_calm += bench_.link.corrupted() - corrupted;
      figures_.longest_gap = std::max(figures_.longest_gap, bench_.clock.now() - last_);
    } else if (!in_fault_) {
      figures_.longest_recovery = std::max(figures_.longest_recovery, bench_.clock.now() - over_);
    }
    if (sample) take(*sample);
  }

  void note_link() {
    if (bench_.driver.link() == link_) return;
    link_ = bench_.driver.link();
    said_.u8(static_cast<std::uint8_t>(link_));
    said_.i64(bench_.clock.now().raw);
  }

  // What the driver counted, under whatever name it has.
  template <class Driver>
  void note_counts(const Driver& driver) {
    if constexpr (requires { driver.counts(); }) {
      note_bytes(driver.counts());
    } else if constexpr (requires { driver.counters(); }) {
      note_bytes(driver.counters());
    } else if constexpr (requires { driver.session(); }) {
      note_counts(driver.session());
    }
  }
  template <class Counts>
  void note_bytes(const Counts& counts) {
    static_assert(std::has_unique_object_representations_v<Counts>);
    std::array<std::uint8_t, sizeof(Counts)> bytes;
    std::memcpy(bytes.data(), &counts, sizeof counts);
    for (const std::uint8_t byte : bytes) said_.u8(byte);
  }

  void take(const typename Rig::Sample& sample) {
    ++figures_.samples;
    for (const char c : record::encoded(sample)) said_.u8(static_cast<std::uint8_t>(c));
    last_ = bench_.clock.now();
    if (!bench_.right(sample)) {
      // Samples held back by a stalled line come late and do not count as damaged.
      const bool held_back = !calm_ && bench_.old(sample);
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
    if (kind == Faults::Kind::kStall) bench_.link.stall();
    if (kind == Faults::Kind::kReboot) bench_.restart(now);
    if (kind == Faults::Kind::kUnplug) bench_.link.unplug();
  }

  void end_fault(base::Time now) {
    bench_.link.resume();
    bench_.link.replug();
    in_fault_ = false;
    over_ = now;
  }

  Bench<Rig> bench_;
  Faults faults_;
  base::Duration step_;
  HostileFigures figures_;
  base::Fnv1a64 said_;
  sensor::LinkState link_ = sensor::LinkState::kAbsent;
  bool in_fault_ = false;
  bool calm_ = false;
  base::Time over_;
  base::Time last_;
  std::uint64_t heap_at_first_ = 0;
};

template <class Rig>
HostileFigures run_hostile_hours(double hours, std::uint32_t seed, base::Duration step) {
  return std::make_unique<HostileHours<Rig>>(seed, step)->run(hours);
}

}  // namespace fencepost::test
