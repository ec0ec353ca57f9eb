// The console: lines that people and programs send, and what they are answered.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/console/answers.hpp"
#include "firmware/console/command.hpp"
#include "firmware/console/help.hpp"
#include "firmware/loop/canned_stream.hpp"
#include "firmware/loop/intake.hpp"
#include "firmware/loop/listings.hpp"
#include "firmware/loop/map_listing.hpp"
#include "firmware/record/text.hpp"

namespace fencepost::app {

/// A line that begins like this is one of our own, sent back by a terminal or port that echoes: it is not answered.
inline constexpr std::string_view kErrorStart = "error:";

// What loop and console do for themselves is not inlined: its locals would lie under the reconstruction's stack.
template <class Profile>
class Console {
 public:
  Console(Pipeline<Profile>& pipeline, const CannedStream& canned) : pipeline_(pipeline), canned_(canned) {}

  /// Where the link's next bytes go, see InputLines.
  [[nodiscard]] std::span<std::uint8_t> room() { return state().input.room(); }
  void filled(std::size_t count) { state().input.filled(count); }

  enum class Took : std::uint8_t {
    kNothing,  ///< no whole line there, or a command that waits until the one before is answered
    kLine,
    kInput,  ///< a line that was an input of the loop: settle it
  };

  /// What `version` says at its end; lives on.
  void set_note(std::string_view note) { note_ = note; }

  /// Acts on the oldest line, which arrived at `now`.
  [[gnu::noinline]] Took take_line(base::Time now) {
    const std::optional<InputLines::Line> line = state().input.front();
    if (!line) return Took::kNothing;
    const std::string_view raw = without_noise({line->text.data(), line->text.size()});
    Took took = Took::kLine;
    if (raw.starts_with(record::kRecordStart)) {
      if (take_record(raw, line->too_long, now)) took = Took::kInput;
    } else if (state().answer.pending()) {
      return Took::kNothing;
    } else {
      take_command(line->text, line->too_long);
    }
    state().input.pop_front();
    return took;
  }

  /// The self-test's next line; true if it was an input: settle it.
  [[gnu::noinline]] bool rehearse() {
    std::array<char, kLongestCannedLine> room{};
    const std::string_view line = unpack_line(canned_.packed, state().selftest_at, room);
    if (line.empty()) {
      state().answer.reply = Reply::kSelftest;
      return false;
    }
    Intake<Profile> intake{pipeline_, Purpose::kSelftest};
    static_cast<void>(record::decode(line, {}, intake));
    return intake.input;
  }

  /// Writes at most one line of the pending answer.
  [[gnu::noinline]] void talk(const Links& links) {
    ConsoleState& console = state();
    if (!console.answer.pending()) return;
    auto& output = pipeline_.memory().output;
    const bool may = output.waiting().empty() || console.turns_without_room >= kPatience;
    if (!may || !output.put_line([&](std::span<char> out) { return write_line(links, out); })) {
      if (console.turns_without_room < kPatience) ++console.turns_without_room;
      return;
    }
    console.turns_without_room = 0;
    ++console.answer.line;
    if (!answered()) return;
    const bool tested = console.answer.reply == Reply::kSelftest;
    console.answer = {};
    if (tested) pipeline_.restart();
  }

 private:
  [[nodiscard]] ConsoleState& state() { return pipeline_.memory().console; }

  // True if it was an input of the loop.
  bool take_record(std::string_view line, bool too_long, base::Time now) {
    Intake<Profile> intake{pipeline_, Purpose::kRun};
    if (too_long) {
      intake.reject = pipeline_.reject(record::Reject::kLength);
    } else if (const auto kind = record::decode(line, {.arrival = now}, intake); !kind) {
      intake.reject = pipeline_.reject(kind.error());
    }
    if (intake.reject && state().mode == Mode::kText) {
      pipeline_.telling().say([&](std::span<char> out) { return describe_reject(line, *intake.reject, out); });
    }
    if (intake.table_full && !state().answer.pending()) {
      state().answer = Answer{Reply::kTableFull, Profile::kSignatures, 0, quote(record::before(line, ','))};
    }
    return intake.input && !intake.reject;
  }

  [[gnu::noinline]] void take_command(std::span<char> text, bool too_long) {
    const std::optional<std::string_view> line = typed(text);
    if (too_long) {
      state().answer.reply = Reply::kLineTooLong;
    } else if (!line) {
      state().answer.reply = Reply::kNotText;
    } else if (const Words words = split(*line); words.count > 0 && words.words[0] != kErrorStart) {
      state().answer = obey(words);
    }
  }

  Answer obey(const Words& words) {
    const Answer checked = check(words);
    if (checked.pending()) return checked;
    const std::string_view word = words.words[1];
    switch (static_cast<Verb>(checked.subject)) {
      case Verb::kHelp: return {Reply::kHelp};
      case Verb::kStatus: return {Reply::kStatus};
      case Verb::kObjects: return {Reply::kObjects};
      case Verb::kMap: return {Reply::kMap};
      case Verb::kAlerts: state().alerts = word == "on"; return {Reply::kAlertsAre};
      case Verb::kMode: pipeline_.set_mode(*mode_named(word)); return {Reply::kModeIs};
      case Verb::kSet: return set(word, words.words[2]);
      case Verb::kGet: return words.count == 1 ? Answer{Reply::kAllSettings} : about_key(Reply::kOneSetting, word);
      case Verb::kSelftest:
        pipeline_.start_selftest();
        state().selftest_at = 0;
        return {};
      case Verb::kReset: pipeline_.restart(); return {Reply::kNewRun};
      case Verb::kVersion: return {Reply::kVersion};
    }
    return {};
  }

  Answer set(std::string_view key, std::string_view value) {
    Answer answer = about_key(Reply::kSettingIs, key);
    if (answer.reply != Reply::kSettingIs) return answer;
    if (pipeline_.set(key, value)) {
      answer.reply = Reply::kNoSuchValue;
      answer.quote = quote(value);
    }
    return answer;
  }

  // --- answers ---

  // The answer's next line; 0 if it does not fit.
  std::size_t write_line(const Links& links, std::span<char> out) {
    const Answer& answer = state().answer;
    const Memory<Profile>& memory = pipeline_.memory();
    switch (answer.reply) {
      case Reply::kHelp: return write_help(answer.line, memory.settings, out);
      case Reply::kAllSettings: return write_setting(static_cast<config::Key>(answer.line), memory.settings, out);
      case Reply::kStatus: return write_status(answer.line, status_facts(links), out);
      case Reply::kObjects: return write_objects(links, out);
      case Reply::kMap:
        if (memory.poses.empty()) return write_none("map", status_facts(links), out);
        if (answer.line == 0) state().view = view_of(memory);
        return write_map(pipeline_, answer.line, out);
      default:
        return write_answer(answer,
                            {memory.console.mode, memory.console.alerts, memory.run.whole, memory.settings,
                             memory.run.header, memory.map.digest(), canned_.digest, note_},
                            out);
    }
  }

  // The heading, then one line a used slot.
  std::size_t write_objects(const Links& links, std::span<char> out) {
    const Memory<Profile>& memory = pipeline_.memory();
    if (memory.map.size() == 0) return write_none("objects", status_facts(links), out);
    if (state().answer.line == 0) return write_objects_head(out);
    const std::size_t slot = next_used(state().answer.line - 1U);
    if (slot == Profile::kObjects) return Sentence(out).put("end of list").end();
    const recon::Object<Profile>& object = memory.map.slots()[slot];
    const Obstacle seen = see_obstacle(object, RobotPlace(robot_pose(memory)), {});
    const std::size_t size = write_object(letter_of(slot), object, pipeline_.telling().name_of(object.signature), seen,
                                          memory.run.time.value_or(base::Time{}), out);
    if (size > 0) state().answer.line = static_cast<std::uint8_t>(slot + 1);
    return size;
  }
  [[nodiscard]] std::size_t next_used(std::size_t slot) const {
    while (slot < Profile::kObjects && !pipeline_.memory().map.slots()[slot].used()) ++slot;
    return slot;
  }

  // Was the line before answer.line the last one?
  [[nodiscard]] bool answered() {
    const Answer& answer = state().answer;
    switch (answer.reply) {
      case Reply::kHelp: return answer.line >= kHelpLines;
      case Reply::kAllSettings: return answer.line >= config::kKeys;
      case Reply::kStatus: return answer.line >= kStatusLines;
      case Reply::kObjects: return next_used(answer.line - 1U) == Profile::kObjects;
      case Reply::kMap: return pipeline_.memory().poses.empty() || answer.line >= kMapLines;
      default: return true;
    }
  }

  [[nodiscard]] StatusFacts status_facts(const Links& links) {
    const Memory<Profile>& memory = pipeline_.memory();
    StatusFacts facts{Profile::kName, memory.console.mode, memory.console.alerts, links,
                      memory.run,     memory.counters,     memory.calibration};
    if (!memory.poses.empty()) facts.robot = robot_pose(memory);
    facts.objects = memory.map.size();
    for (const recon::ObjectCore& object : memory.map.slots()) {
      facts.confirmed += object.used() && object.confirmed ? 1U : 0U;
    }
    facts.capacity = Profile::kObjects;
    facts.digest = memory.map.digest();
    return facts;
  }

  Pipeline<Profile>& pipeline_;
  CannedStream canned_;
  std::string_view note_;
};

}  // namespace fencepost::app
