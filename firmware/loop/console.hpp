// Handles the received lines: records are inputs, all others are commands.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/console/command.hpp"
#include "firmware/loop/answers.hpp"
#include "firmware/loop/canned_stream.hpp"
#include "firmware/loop/intake.hpp"
#include "firmware/record/text.hpp"

namespace fencepost::loop {

/// A line that begins like this is one of our own, sent back by a terminal or port that echoes: it is not answered.
inline constexpr std::string_view kErrorStart = "error:";

// Functions of loop and console alone are not inlined: their locals would lie under the reconstruction's stack.
template <class Profile>
class Console {
 public:
  Console(Pipeline<Profile>& pipeline, const CannedStream& canned)
      : pipeline_(pipeline), canned_(canned), answers_(pipeline.memory(), canned.digest) {}

  /// The room for the link's next bytes, see InputLines.
  [[nodiscard]] std::span<std::uint8_t> room() { return state().input.room(); }
  void filled(std::size_t count) { state().input.filled(count); }

  enum class Handled : std::uint8_t {
    kNothing,  ///< no whole line there, or a command that waits until the one before is answered
    kLine,
    kInput,  ///< a line that was an input of the loop: its effects are due
  };

  /// Appended to the answer of `version`; must outlive this.
  void set_note(std::string_view note) { answers_.set_note(note); }

  /// In `watch` the map is drawn again from time to time; the first one at once.
  void draw_again(base::Time now) {
    console::ConsoleState& console = state();
    constexpr base::Duration kEvery = base::milliseconds(2'000);
    if (!console.watching || console.answer.pending()) return;
    if (console.drawn && console.drawn_at.since(now) < kEvery) return;
    console.drawn = true;
    console.drawn_at = base::Stamp(now);
    console.answer.reply = console::Reply::kMap;
  }

  /// The board's button: `stop` while its motors run, else `go`.
  [[gnu::noinline]] void press_button() {
    console::Motion& motion = state().motion;
    const console::Answer answer = motion.ahead ? hold() : go();
    motion.by_button = motion.ahead;
    if (!state().answer.pending()) state().answer = answer;
  }

  /// Acts on the oldest line, which arrived at `now`.
  [[gnu::noinline]] Handled handle_line(base::Time now) {
    const std::optional<console::InputLines::Line> line = state().input.front();
    if (!line) return Handled::kNothing;
    const std::string_view raw = console::without_noise({line->text.data(), line->text.size()});
    Handled handled = Handled::kLine;
    if (raw.starts_with(record::kRecordStart)) {
      if (handle_record(raw, line->too_long, now)) handled = Handled::kInput;
    } else if (state().answer.pending()) {
      return Handled::kNothing;
    } else {
      handle_command(line->text, line->too_long);
    }
    state().input.pop_front();
    return handled;
  }

  /// The self-test's next line; true if it was an input: its effects are due.
  [[gnu::noinline]] bool feed_selftest() {
    std::array<char, kLongestCannedLine> room{};
    const std::string_view line = unpack_line(canned_.packed, state().selftest_at, room);
    if (line.empty()) {
      state().answer.reply = console::Reply::kSelftest;
      return false;
    }
    Intake<Profile> intake{pipeline_, Purpose::kSelftest};
    static_cast<void>(record::decode(line, {}, intake));
    return intake.input;
  }

  /// Queues at most one line of the pending answer.
  [[gnu::noinline]] void send_answer(const console::Links& links) {
    console::ConsoleState& console = state();
    if (!console.answer.pending()) return;
    auto& output = pipeline_.memory().output;
    const bool may = output.waiting().empty() || console.turns_without_room >= kTurnsBeforeYield;
    if (!may || !output.put_line([&](std::span<char> out) { return answers_.write_line(links, out); })) {
      if (console.turns_without_room < kTurnsBeforeYield) ++console.turns_without_room;
      return;
    }
    console.turns_without_room = 0;
    ++console.answer.line;
    if (!answers_.complete()) return;
    const bool tested = console.answer.reply == console::Reply::kSelftest;
    console.answer = {};
    if (tested) pipeline_.restart();
  }

 private:
  [[nodiscard]] console::ConsoleState& state() { return pipeline_.memory().console; }

  // True if it was an input of the loop.
  bool handle_record(std::string_view line, bool too_long, base::Time now) {
    if (state().locked && !too_long && changes_settings(line)) {
      if (!state().answer.pending()) {
        state().answer = {console::Reply::kWaitsForReset, 0, 0, console::quote(record::before(line, ','))};
      }
      return false;
    }
    Intake<Profile> intake{pipeline_, Purpose::kRun};
    if (too_long) {
      intake.reject = pipeline_.reject(record::Reject::kLength);
    } else if (const auto kind = record::decode(line, {.arrival = now}, intake); !kind) {
      intake.reject = pipeline_.reject(kind.error());
    }
    if (intake.reject && state().mode == console::Mode::kText) {
      pipeline_.reporter().say([&](std::span<char> out) {
        return console::describe_reject(line, *intake.reject, config::reason(intake.car_problem), out);
      });
    }
    if (intake.table_full && !state().answer.pending()) {
      state().answer = console::Answer{console::Reply::kTableFull, Profile::kSignatures, 0,
                                       console::quote(record::before(line, ','))};
    }
    return intake.input && !intake.reject;
  }

  static bool changes_settings(std::string_view line) {
    const std::string_view kind = record::before(line, ',');
    return kind == "$FPCFG" || kind == "$FPCAM" || kind == "$FPSIG" || kind == "$FPHDR";
  }

  [[gnu::noinline]] void handle_command(std::span<char> text, bool too_long) {
    state().motion.ahead = false;  // any typed line stops the robot, even noise
    state().motion.by_button = false;
    state().watching = false;
    const std::optional<std::string_view> line = console::typed(text);
    if (too_long) {
      state().answer.reply = console::Reply::kLineTooLong;
    } else if (!line) {
      state().answer.reply = console::Reply::kNotText;
    } else if (const console::Words words = console::split(*line); words.count > 0 && words.words[0] != kErrorStart) {
      state().answer = obey(words);
    }
  }

  console::Answer obey(const console::Words& words) {
    using console::Reply;
    using console::Verb;
    const console::Answer checked = check(words);
    if (checked.pending()) return checked;
    const std::string_view word = words.words[1];
    if (state().locked && waits_for_reset(static_cast<Verb>(checked.subject), word)) {
      return {Reply::kWaitsForReset, 0, 0, console::quote(words.words[0])};
    }
    switch (static_cast<Verb>(checked.subject)) {
      case Verb::kHelp: return {Reply::kHelp};
      case Verb::kSettings: return {Reply::kAllSettings};
      case Verb::kStatus: return {Reply::kStatus};
      case Verb::kObjects: return {Reply::kObjects};
      case Verb::kMap: return {Reply::kMap};
      case Verb::kWatch:
        state().watching = true;
        state().drawn = false;
        return {};
      case Verb::kNext: return next(word);
      case Verb::kSectors: return {Reply::kSectors};
      case Verb::kWays: return {Reply::kWays};
      case Verb::kCalibrate:
        if (!state().guide.on()) state().guide.begin();
        return {Reply::kCalibrate};
      case Verb::kAlerts: state().alerts = word == "on"; return {Reply::kAlertsAre};
      case Verb::kMode: pipeline_.set_mode(*console::mode_named(word)); return {Reply::kModeIs};
      case Verb::kSet: return set(word, words.words[2]);
      case Verb::kGet:
        if (words.count == 1) return {Reply::kAllSettings};
        return console::about_key(Reply::kOneSetting, Reply::kOneDevice, offers(), word);
      case Verb::kSelftest:
        pipeline_.start_selftest();
        state().selftest_at = 0;
        return {};
      case Verb::kReset: pipeline_.restart(); return {Reply::kNewRun};
      case Verb::kGo: return go();
      case Verb::kStop: return hold();
      case Verb::kLock: state().locked = true; return {Reply::kLocked};
      case Verb::kVersion: return {Reply::kVersion};
      case Verb::kQuit: return {Reply::kQuit};
    }
    return {};
  }

  console::Answer go() {
    using console::Reply;
    const loop::Memory<Profile>& memory = pipeline_.memory();
    const bool motors = offers() && memory.offer->limits.motors;
    if (!motors || memory.devices.raw(config::DeviceKey::kBumper) == 0) {
      state().motion.held = false;
      return {Reply::kReleased};
    }
    if (!state().motion.may) return {Reply::kMayNotGo};
    state().motion.held = false;
    state().motion.ahead = true;
    return {Reply::kGoes};
  }

  console::Answer hold() {
    state().motion.held = true;
    state().motion.ahead = false;
    return {console::Reply::kHeld};
  }

  // The next view of one object, by its number, or of all.
  [[nodiscard]] console::Answer next(std::string_view id) {
    using console::Reply;
    if (id.empty()) return {Reply::kNext};
    const auto number = record::read_decimal(id, record::kCount);
    const auto slots = pipeline_.memory().map.slots();
    for (std::size_t slot = 0; slot < Profile::kObjects; ++slot) {
      if (!number || !slots[slot].used() || slots[slot].id != *number) continue;
      return {Reply::kNext, static_cast<std::uint8_t>(slot + 1)};
    }
    return {Reply::kNoSuchObject, 0, 0, console::quote(id)};
  }

  console::Answer set(std::string_view key, std::string_view value) {
    using console::Reply;
    console::Answer answer = console::about_key(Reply::kSettingIs, Reply::kDeviceIs, offers(), key);
    if (answer.reply == Reply::kDeviceIs) return set_device(key, value, answer);
    if (answer.reply != Reply::kSettingIs) return answer;
    if (pipeline_.set(key, value)) {
      answer.reply = Reply::kNoSuchValue;
      answer.quote = console::quote(value);
    }
    return answer;
  }

  // One that the image does not contain is answered by those that it does.
  console::Answer set_device(std::string_view key, std::string_view value, console::Answer answer) {
    using config::Refusal;
    const auto change = pipeline_.set_device(key, value);
    if (change.done()) return answer;
    answer.quote = console::quote(value);
    const bool missing = change.refusal == Refusal::kCameraNotInImage || change.refusal == Refusal::kOdometryNotInImage;
    if (change.error || missing) {
      answer.reply = console::Reply::kNoSuchDevice;
    } else {
      answer.reply = console::Reply::kDeviceRefused;
      answer.subject = static_cast<std::uint8_t>(change.refusal);
    }
    return answer;
  }
  [[nodiscard]] bool offers() const { return pipeline_.memory().offer != nullptr; }

  Pipeline<Profile>& pipeline_;
  CannedStream canned_;
  Answers<Profile> answers_;
};

}  // namespace fencepost::loop
