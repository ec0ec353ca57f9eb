// The pending answer of the console, line by line, from the state of that moment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/console/answers.hpp"
#include "firmware/console/help.hpp"
#include "firmware/console/listings.hpp"
#include "firmware/console/map_listing.hpp"
#include "firmware/loop/memory.hpp"
#include "firmware/record/encode.hpp"

namespace fencepost::loop {

// Not inlined where its locals would lie under the reconstruction's stack.
template <class Profile>
class Answers {
 public:
  Answers(Memory<Profile>& memory, std::uint64_t canned_digest) : m_(memory), canned_digest_(canned_digest) {}

  /// Appended to the answer of `version`; must outlive this.
  void set_note(std::string_view note) { note_ = note; }

  /// The answer's next line; 0 if it does not fit.
  std::size_t write_line(const console::Links& links, std::span<char> out) {
    using console::Reply;
    const console::Answer& answer = m_.console.answer;
    switch (answer.reply) {
      case Reply::kHelp: return console::write_help(answer.line, out);
      case Reply::kAllSettings: return console::write_setting(answer.line, in_force(), out);
      case Reply::kStatus: return console::write_status(answer.line, status_facts(links), out);
      case Reply::kObjects: return write_objects(links, out);
      case Reply::kMap: return write_map(links, out);
      case Reply::kNext: return write_next(links, out);
      case Reply::kSectors:
        return write_report("sectors", links, out, [](const auto& memory) { return sectors_of(memory); });
      case Reply::kWays:
        return write_report("ways", links, out, [](const auto& memory) { return ways_of(memory, kPassAnywhere); });
      case Reply::kCalibrate: return m_.console.guide.write(answer.line, logs(), out);
      default:
        return console::write_answer(answer,
                                     {m_.console.mode, m_.console.alerts, m_.run.whole, in_force(), m_.run.header,
                                      m_.map.digest(), canned_digest_, note_},
                                     out);
    }
  }

  /// True if the line before answer.line was the last one.
  [[nodiscard]] bool complete() const {
    using console::Reply;
    const console::Answer& answer = m_.console.answer;
    switch (answer.reply) {
      case Reply::kHelp: return answer.line >= console::kHelpLines;
      case Reply::kAllSettings: return answer.line >= in_force().lines();
      case Reply::kStatus: return answer.line >= console::status_lines(m_.camera_doubt.said(), m_.offer != nullptr);
      case Reply::kObjects: return next_used(answer.line - 1U) == Profile::kObjects;
      case Reply::kNext: return answer.subject > 0 || next_used(answer.line) == Profile::kObjects;
      case Reply::kCalibrate: return answer.line >= m_.console.guide.lines(logs());
      case Reply::kMap: return m_.poses.empty() || answer.line >= console::kMapLines;
      default: return true;
    }
  }

 private:
  // `report_of`: makes the record of the memory.
  template <class ReportOf>
  std::size_t write_report(std::string_view verb, const console::Links& links, std::span<char> out,
                           const ReportOf& report_of) {
    if constexpr (Profile::kSeesFloor) {
      if (m_.poses.empty()) return console::write_none(verb, status_facts(links), out);
      return record::encode(report_of(m_), out);
    } else {
      return console::Sentence(out).put(verb).put(": this board has no room for them").end();
    }
  }
  std::size_t write_map(const console::Links& links, std::span<char> out) {
    if (m_.poses.empty()) return console::write_none("map", status_facts(links), out);
    const console::MapContents<Profile> map{m_.map.slots(), m_.signatures.view(), m_.trail.places()};
    if (m_.console.answer.line == 0) m_.console.view = view_of(map, robot_pose(m_));
    return console::write_map(map, m_.console.view, m_.console.answer.line, out);
  }

  // The heading, then one line a used slot.
  std::size_t write_objects(const console::Links& links, std::span<char> out) {
    if (m_.map.size() == 0) return console::write_none("objects", status_facts(links), out);
    if (m_.console.answer.line == 0) return console::write_objects_head(out);
    const std::size_t slot = next_used(m_.console.answer.line - 1U);
    if (slot == Profile::kObjects) return console::Sentence(out).put("end of list").end();
    const recon::Object<Profile>& object = m_.map.slots()[slot];
    const alert::Obstacle seen = see_obstacle(object, alert::RobotPlace(robot_pose(m_)), {});
    const std::size_t size = console::write_object(console::letter_of(slot), object,
                                                   console::name_of(object.signature, m_.signatures.view()), seen,
                                                   m_.run.time.value_or(base::Time{}), out);
    if (size > 0) m_.console.answer.line = static_cast<std::uint8_t>(slot + 1);
    return size;
  }
  // One line a used slot, or that of the one that was asked for.
  std::size_t write_next(const console::Links& links, std::span<char> out) {
    console::Answer& answer = m_.console.answer;
    const std::size_t slot = answer.subject > 0 ? answer.subject - 1U : next_used(answer.line);
    if (slot == Profile::kObjects || !m_.map.slots()[slot].used()) {
      return console::write_none("objects", status_facts(links), out);
    }
    const recon::Object<Profile>& object = m_.map.slots()[slot];
    const std::size_t size = console::write_next(object, console::name_of(object.signature, m_.signatures.view()),
                                                 next_view_of(m_, slot), object.hybrid().origin, out);
    if (size > 0 && answer.subject == 0) answer.line = static_cast<std::uint8_t>(slot);
    return size;
  }
  [[nodiscard]] bool logs() const { return m_.console.mode == console::Mode::kLog || m_.journal.on(); }
  [[nodiscard]] std::size_t next_used(std::size_t slot) const {
    while (slot < Profile::kObjects && !m_.map.slots()[slot].used()) ++slot;
    return slot;
  }

  [[nodiscard]] console::StatusFacts status_facts(const console::Links& links) const {
    console::StatusFacts facts{Profile::kName, m_.console.mode, m_.console.alerts, links, m_.counters, m_.run.time};
    if (m_.calibration.known) facts.camera = &m_.calibration.intrinsics;
    if (!m_.poses.empty()) facts.robot = robot_pose(m_);
    facts.objects = m_.map.size();
    for (const recon::ObjectCore& object : m_.map.slots()) {
      facts.confirmed += object.used() && object.confirmed ? 1U : 0U;
    }
    facts.capacity = Profile::kObjects;
    facts.digest = m_.map.digest();
    facts.doubt = m_.camera_doubt.said();
    facts.devices = &m_.devices;
    facts.offer = m_.offer;
    return facts;
  }
  [[nodiscard]] console::SettingsInForce in_force() const { return {m_.settings, m_.devices, m_.offer}; }

  Memory<Profile>& m_;
  std::uint64_t canned_digest_;
  std::string_view note_;
};

}  // namespace fencepost::loop
