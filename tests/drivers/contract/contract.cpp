#include "tests/drivers/contract/contract.hpp"

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace fencepost::test {
namespace {

using base::milliseconds;
using sensor::LinkState;
using Bytes = std::vector<std::uint8_t>;
using Fault = std::function<Bytes(const Bytes&)>;

// Longer than any start or silence of ours.
constexpr base::Duration kPatience = milliseconds(30'000);

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
Bytes front_of(const Bytes& bytes, std::size_t size) {
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}
Bytes back_of(const Bytes& bytes, std::size_t from) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end()};
}

/// A subject that works, and what it says while nothing is wrong.
class Trial {
 public:
  /// `alone`: it is shown one thing in every image.
  explicit Trial(Subject& subject, bool alone = false) : subject_(subject) {
    subject_.plug().tamper([this](const Bytes& frame) { return pass(frame); });
    learn(Scene::kOne);
    if (subject_.sees() && !alone) {
      learn(Scene::kTwo);
      learn(Scene::kThree);
      subject_.show(Scene::kTurns);
    }
  }

  [[nodiscard]] bool works() const { return kept.broken.empty(); }
  /// Bytes of the longest frame.
  [[nodiscard]] std::size_t size() const { return longest_; }
  /// Puts `fault` in place of the next long frame, which it is given.
  void damage(const Fault& fault) {
    if (!works()) return;
    ++kept.tries;
    fire(fault);
    const base::Time begin = subject_.now();
    for (int right = 0; right < 2;) {
      if (subject_.now() - begin > kPatience) return say("it does not come back");
      right += judge(subject_.step()) ? 1 : 0;
    }
    kept.longest = std::max(kept.longest, subject_.now() - begin);
    kept.total = kept.total + (subject_.now() - begin);
  }
  /// Until the next long frame was sent as `fault` says, in the midst of what is right.
  void fire(const Fault& fault) {
    const base::Time begin = subject_.now();
    while (!judge(subject_.step())) {
      if (subject_.now() - begin > kPatience) return say("it has hung");
    }
    fault_ = fault;
    while (fault_) {
      if (subject_.now() - begin > kPatience) return say("its device is asked for nothing");
      (void)judge(subject_.step());
    }
  }
  /// True: a right sample. A wrong one is counted.
  bool judge(const std::optional<Seen>& sample) {
    if (!sample) return false;
    if (!sample->possible) say("a box outside of the image");
    const bool right = known_.contains(sample->what);
    kept.unnoticed += right ? 0U : 1U;
    return right;
  }
  void say(std::string_view broken) {
    fault_ = nullptr;
    if (kept.broken.size() < 5) kept.broken.emplace_back(broken);
  }

  Kept kept;

 private:
  Bytes pass(const Bytes& frame) {
    if (learning_) longest_ = std::max(longest_, frame.size());
    // Counts in text make some frames a digit longer.
    if (!fault_ || frame.size() + 4 < longest_) return frame;
    return std::exchange(fault_, nullptr)(frame);
  }

  void learn(Scene scene) {
    subject_.show(scene);
    learning_ = true;
    std::optional<std::uint64_t> last;
    const base::Time begin = subject_.now();
    for (int equal = 0; equal < 6;) {
      if (subject_.now() - begin > kPatience) return say("it does not begin");
      const auto sample = subject_.step();
      if (!sample) continue;
      equal = last == sample->what ? equal + 1 : 0;
      last = sample->what;
    }
    known_.insert(*last);
    learning_ = false;
  }

  Subject& subject_;
  std::set<std::uint64_t> known_;
  std::size_t longest_ = 0;
  bool learning_ = false;
  Fault fault_;
};

Bytes random_bytes(std::mt19937& random, std::size_t size) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 8U);
  return bytes;
}

// Nothing is wrong: frames come in order, and nothing in sight is not the same as nothing. Tries: samples in 3 s.
Kept calm(Subject& subject) {
  Trial trial(subject);
  std::uint32_t samples = 0;
  for (const base::Time end = subject.now() + milliseconds(3'000); subject.now() < end;) {
    samples += trial.judge(subject.step()) ? 1U : 0U;
  }
  if (trial.kept.unnoticed > 0) trial.say("a wrong frame on a good cable");
  if (subject.disorder() > 0) trial.say("samples out of order");
  if (subject.link() != LinkState::kOk) trial.say("it works and does not say so");
  if (subject.sees()) {
    subject.show(Scene::kNothing);
    subject.pass(milliseconds(2'000));
    if (subject.link() != LinkState::kEmpty) trial.say("it sees nothing and does not say so");
    subject.show(Scene::kTurns);
    trial.damage([](const Bytes& frame) { return frame; });
    if (trial.works() && subject.link() != LinkState::kOk) trial.say("it sees again and does not say so");
  }
  trial.kept.tries = samples;
  trial.kept.unnoticed = 0;  // frames without boxes, which were right
  return trial.kept;
}

// Each byte, random ones, and parts of the frame itself, before a whole frame and behind it.
Kept garbage(Subject& subject) {
  Trial trial(subject);
  if (subject.line() == nullptr) return trial.kept;
  const auto around = [&](const std::function<Bytes(const Bytes&)>& garbage) {
    trial.damage([&](const Bytes& frame) { return garbage(frame) + frame; });
    trial.damage([&](const Bytes& frame) { return frame + garbage(frame); });
  };
  for (unsigned byte = 0; byte < 256; ++byte)
    around([=](const Bytes&) { return Bytes{static_cast<std::uint8_t>(byte)}; });
  std::mt19937 random(1);
  for (std::size_t size = 2; size < 40; ++size) around([&](const Bytes&) { return random_bytes(random, size); });
  for (std::size_t at = 1; at < trial.size(); ++at) {
    around([=](const Bytes& frame) { return front_of(frame, std::min(at, frame.size())); });
    around([=](const Bytes& frame) { return back_of(frame, std::min(at, frame.size())); });
  }
  return trial.kept;
}

// Cut off, cut in, a byte lost, a byte twice.
Kept cut(Subject& subject) {
  Trial trial(subject);
  for (std::size_t k = 0; k < trial.size(); ++k) {
    const auto at = [k](const Bytes& frame) { return std::min(k, frame.size() - 1); };
    trial.damage([=](const Bytes& frame) { return front_of(frame, at(frame)); });
    trial.damage([=](const Bytes& frame) { return back_of(frame, at(frame) + 1); });
    trial.damage([=](const Bytes& frame) { return front_of(frame, at(frame)) + back_of(frame, at(frame) + 1); });
    trial.damage([=](const Bytes& frame) { return front_of(frame, at(frame) + 1) + back_of(frame, at(frame)); });
  }
  return trial.kept;
}

// Each bit; and all of them, which is what a line does that is held.
Kept flip(Subject& subject) {
  Trial trial(subject);
  for (std::size_t k = 0; k < trial.size(); ++k) {
    for (const unsigned mask : {1U, 2U, 4U, 8U, 16U, 32U, 64U, 128U, 255U}) {
      trial.damage([=](const Bytes& frame) {
        Bytes damaged = frame;
        damaged[std::min(k, frame.size() - 1)] ^= static_cast<std::uint8_t>(mask);
        return damaged;
      });
    }
  }
  return trial.kept;
}

// In two parts, a turn of the loop apart: nothing is wrong.
Kept split(Subject& subject) {
  Trial trial(subject);
  Line* line = subject.line();
  if (line == nullptr) return trial.kept;
  for (std::size_t at = 1; at < trial.size(); ++at) {
    trial.damage([=](const Bytes& frame) {
      line->split_after(line->waiting() + at);
      return frame;
    });
  }
  if (trial.kept.unnoticed > 0) trial.say("a frame in two parts is another");
  return trial.kept;
}

// More than a frame holds: the largest are kept, the others counted.
Kept crowd(Subject& subject) {
  Trial trial(subject);
  if (!subject.sees() || !trial.works()) return trial.kept;
  subject.show(Scene::kCrowd);
  subject.pass(milliseconds(2'000));
  const std::uint32_t before = subject.dropped();
  std::size_t samples = 0;
  std::size_t blobs = 0;
  for (const base::Time end = subject.now() + milliseconds(3'000); subject.now() < end;) {
    const auto sample = subject.step();
    if (!sample) continue;
    ++samples;
    blobs = sample->blobs;
    if (!sample->possible) trial.say("a box outside of the image");
    if (!sample->sorted) trial.say("a box smaller than the next one");
  }
  if (samples == 0) trial.say("a crowd is not seen");
  // As many as the device tells at once, a frame each.
  const std::size_t told = blobs + (subject.dropped() - before) / std::max<std::size_t>(samples, 1);
  if ((subject.dropped() - before) % std::max<std::size_t>(samples, 1) != 0) trial.say("frames drop different counts");
  if (told > sensor::kMaxBlobs && blobs != sensor::kMaxBlobs) trial.say("a frame is not full and blobs are dropped");
  trial.kept.tries = static_cast<std::uint32_t>(told);
  subject.show(Scene::kTurns);
  subject.pass(milliseconds(2'000));
  trial.damage([](const Bytes& frame) { return frame; });
  return trial.kept;
}

// A frame that begins and does not end, longer than any buffer; a poll looks at a part of it.
Kept flood(Subject& subject) {
  Trial trial(subject);
  Line* line = subject.line();
  if (line == nullptr || !trial.works()) return trial.kept;
  constexpr std::size_t kLong = 3'000;
  for (const std::size_t at : {std::size_t{0}, std::size_t{1}, std::size_t{3}, trial.size() / 2, trial.size() - 1}) {
    for (const std::uint8_t byte : std::initializer_list<std::uint8_t>{0, 0xFF, 'x', '0'}) {
      trial.damage(
          [=](const Bytes& frame) { return front_of(frame, std::min(at, frame.size())) + Bytes(kLong, byte); });
    }
    trial.damage(
        [=](const Bytes& frame) { return front_of(frame, std::min(at, frame.size())) + Bytes(kLong, frame[0]); });
  }
  constexpr std::size_t kMaxAPoll = 1'024;
  line->set_bytes_per_ms(4'096);
  line->noise(Bytes(2 * kMaxAPoll, 0xFF));
  for (const std::size_t before = line->waiting(); (void)subject.step(), line->waiting() == before;) {
  }
  if (line->waiting() < kMaxAPoll) trial.say("a poll takes all that there is");
  return trial.kept;
}

// A plug that is pulled while something is still to be said: what it says then is how it began.
constexpr std::uint8_t kPadding = 0x01;  // a Pixy2's, which asks again behind it
void forget_what_was_to_be_said(Subject& subject, const Bytes& opening, Kept& kept) {
  subject.plug().stall();
  subject.pass(milliseconds(2'000));
  subject.unplug();
  subject.pass(milliseconds(100));
  subject.plug().said().clear();
  subject.plug().resume();
  subject.plug().replug();
  (void)subject.step();
  if (subject.line() != nullptr && subject.link() > LinkState::kSilent)
    kept.broken.emplace_back("heard before it spoke");
  subject.pass(milliseconds(2'000));
  Bytes& said = subject.plug().said();
  while (said.size() > opening.size() && said[0] == kPadding && !opening.empty() && opening[0] != kPadding)
    said.erase(said.begin());
  if (said.size() < opening.size() || !std::equal(opening.begin(), opening.end(), said.begin()))
    kept.broken.emplace_back("what was to be said before a lost link is said after it");
}

// The plug is pulled within a frame, and the rest of it comes when the plug is in again.
Kept lost_link(Subject& subject) {
  Line* line = subject.line();
  if (line != nullptr) line->power(false);
  subject.pass(milliseconds(2'000));
  // Of whole transfers the first byte: the second is of another one.
  const Bytes& said = subject.plug().said();
  const Bytes opening = front_of(said, std::min<std::size_t>(said.size(), line != nullptr ? 4 : 1));
  if (line != nullptr) line->power(true);
  Trial trial(subject, true);
  for (std::size_t at = 1; at < trial.size() && trial.works(); at += 1 + trial.size() / 16) {
    Bytes rest;
    trial.fire([&](const Bytes& frame) {
      rest = back_of(frame, std::min(at, frame.size()));
      return line != nullptr ? front_of(frame, std::min(at, frame.size())) : frame;
    });
    ++trial.kept.tries;
    for (int turns = 0; line != nullptr && line->waiting() > 0 && turns < 100; ++turns)
      (void)trial.judge(subject.step());
    const std::uint32_t before = trial.kept.unnoticed;
    subject.unplug();
    subject.pass(milliseconds(600));
    if (subject.link() != LinkState::kAbsent) trial.say("a lost link is not said");
    if (line != nullptr) line->power(false);
    subject.plug().replug();
    if (line != nullptr) line->noise(rest);
    for (int turns = 0; line != nullptr && turns < 40; ++turns) {
      if (subject.step()) trial.say("half a frame from before is believed");
      if (sensor::works(subject.link())) trial.say("it works without its device");
    }
    if (line != nullptr) line->power(true);
    const base::Time begin = subject.now();
    for (int right = 0; right < 2 && trial.works();) {
      if (subject.now() - begin > kPatience) trial.say("it does not come back");
      right += trial.judge(subject.step()) ? 1 : 0;
    }
    trial.kept.longest = std::max(trial.kept.longest, subject.now() - begin);
    trial.kept.total = trial.kept.total + (subject.now() - begin);
    if (trial.kept.unnoticed != before) trial.say("a wrong frame after a lost link");
  }
  if (line != nullptr) line->power(false);
  forget_what_was_to_be_said(subject, opening, trial.kept);
  return trial.kept;
}

// A minute without a device, half of it on a port that takes nothing. Tries: bytes that it says meanwhile.
Kept unready(Subject& subject) {
  constexpr base::Duration kHalf = milliseconds(30'000);
  Kept kept;
  const auto expect = [&](bool good, const char* broken) {
    if (!good) kept.broken.emplace_back(broken);
  };
  if (Line* line = subject.line()) line->power(false);
  if (subject.line() == nullptr) subject.plug().stall();
  const auto wait = [&] {
    for (const base::Time end = subject.now() + kHalf; subject.now() < end;) {
      if (subject.step()) return expect(false, "a sample of nothing");
    }
    expect(subject.link() == LinkState::kSilent, "a silent line is not said");
  };
  wait();
  kept.tries = static_cast<std::uint32_t>(subject.plug().written());
  subject.plug().stall();
  wait();
  expect(subject.plug().written() == kept.tries, "it writes where nothing is taken");
  subject.plug().resume();
  if (Line* line = subject.line()) line->power(true);
  const Trial trial(subject);
  expect(trial.works(), "it does not begin when its device does");
  return kept;
}

// Frames with a few random bytes, and random bytes between them: whatever it says, it is possible, and it goes on.
Kept random(Subject& subject) {
  Trial trial(subject);
  std::mt19937 random(2);
  for (int round = 0; round < 400 && trial.works(); ++round) {
    trial.damage([&](const Bytes& frame) {
      Bytes damaged = frame;
      for (int i = 0; i < 4; ++i) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random() >> 8U);
      if (subject.line() == nullptr) return damaged;
      return random_bytes(random, random() % 8) + damaged + random_bytes(random, random() % 100);
    });
  }
  return trial.kept;
}

}  // namespace

std::span<const ContractCase> contract_cases() {
  static constexpr ContractCase kCases[] = {
      {"calm", calm, true},           {"garbage", garbage, true}, {"cut", cut, true},      {"flip", flip, true},
      {"split", split, true},         {"crowd", crowd, false},    {"flood", flood, false}, {"random", random, false},
      {"lost link", lost_link, true}, {"unready", unready, false}};
  return kCases;
}

}  // namespace fencepost::test
