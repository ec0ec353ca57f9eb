#include "tests/drivers/bench/comeback.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace fencepost::test {
namespace {

class Day {
 public:
  explicit Day(Subject& subject) : subject_(subject) {}

  Comeback spend() {
    Comeback day;
    subject_.plug().stall();
    (void)pass(kDead);
    day.before = subject_.link();
    subject_.plug().resume();
    (void)pass(kRecovery);
    day.working = subject_.link();
    subject_.plug().stall();
    (void)pass(kDead);
    day.stalled = subject_.link();
    subject_.plug().resume();
    (void)pass(kRecovery);
    day.after_stall = subject_.link();
    subject_.unplug();
    (void)pass(base::milliseconds(1'500));
    day.unplugged = subject_.link();
    subject_.plug().replug();
    (void)pass(kRecovery);
    day.replugged = subject_.link();
    subject_.restart();
    (void)pass(kRecovery);
    day.samples_after_power_cycle = pass(base::milliseconds(2'000));
    day.after_power_cycle = subject_.link();
    day.wrong = wrong_;
    return day;
  }

 private:
  static constexpr base::Duration kDead = base::milliseconds(10'000);
  static constexpr base::Duration kRecovery = base::milliseconds(15'000);

  std::uint64_t pass(base::Duration time) {
    std::uint64_t samples = 0;
    for (const base::Time end = subject_.now() + time; subject_.now() < end;) {
      const auto sample = subject_.step();
      if (!sample) continue;
      ++samples;
      wrong_ += sample->right || sample->old ? 0U : 1U;
    }
    return samples;
  }

  Subject& subject_;
  std::uint64_t wrong_ = 0;
};

class Silences {
 public:
  explicit Silences(Subject& subject) : subject_(subject) {}

  /// Each kind of silence at many phases of the conversation, and of several lengths.
  Recovery measure() {
    (void)until_right();
    worst_ = {};
    for (int round = 0; round < kRounds; ++round) {
      for (const std::int64_t length : {30, 250, 700, 1'900, 6'100}) {
        calm(round);
        subject_.plug().stall();
        subject_.pass(base::milliseconds(length));
        // Output during the stall is lost: how long a buffer of that needs is not the driver's affair.
        subject_.forget();
        subject_.plug().resume();
        worst_.stall = std::max(worst_.stall, until_right());
        calm(round);
        subject_.unplug();
        subject_.pass(base::milliseconds(length));
        subject_.plug().replug();
        worst_.unplug = std::max(worst_.unplug, until_right());
      }
      calm(round);
      subject_.restart();
      const std::uint64_t late = late_;
      worst_.power = std::max(worst_.power, until_right());
      worst_.stale += late_ - late;
    }
    return worst_;
  }

 private:
  static constexpr int kRounds = 24;
  static constexpr base::Duration kPatience = base::milliseconds(60'000);

  /// Another phase each time: of no device's period a multiple.
  void calm(int round) { subject_.pass(base::milliseconds(2'000 + 37 * round)); }
  /// Until a sample says what the device says now.
  base::Duration until_right() {
    const base::Time begin = subject_.now();
    while (subject_.now() - begin < kPatience) {
      const auto sample = subject_.step();
      if (sample && sample->right) break;
      if (sample) ++(sample->old ? late_ : worst_.wrong);
    }
    return subject_.now() - begin;
  }

  Subject& subject_;
  Recovery worst_;
  std::uint64_t late_ = 0;
};

}  // namespace

Comeback spend_day(const HostileCase& driver) { return Day(*driver.make({})).spend(); }

Recovery measure_recovery(const HostileCase& driver) { return Silences(*driver.make({})).measure(); }

std::optional<Noise> hear_noise(const HostileCase& driver) {
  constexpr base::Duration kTime = base::milliseconds(120'000);
  constexpr std::size_t kAhead = 64;  // bytes that wait for the driver
  const std::unique_ptr<Subject> subject = driver.make({});
  Line* line = subject->line();
  if (line == nullptr) return std::nullopt;
  std::mt19937 random(11);
  Noise heard;
  line->power(false);
  for (const base::Time end = subject->now() + kTime; subject->now() < end;) {
    std::vector<std::uint8_t> bytes;
    while (line->waiting() + bytes.size() < kAhead) bytes.push_back(static_cast<std::uint8_t>(random()));
    heard.bytes += bytes.size();
    line->noise(bytes);
    heard.samples += subject->step() ? 1U : 0U;
    ++heard.polls;
    heard.working += sensor::works(subject->link()) ? 1U : 0U;
  }
  return heard;
}

}  // namespace fencepost::test
