// What the loop says of its own accord: records in mode log, sentences in mode text, numbers in mode plot.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/console/link_words.hpp"
#include "firmware/console/text.hpp"
#include "firmware/loop/memory.hpp"
#include "firmware/loop/reports.hpp"

namespace fencepost::app {

inline constexpr base::Duration kRepeatCalibration = base::milliseconds(10'000);
inline constexpr base::Duration kStatusInterval = base::milliseconds(1000);
inline constexpr base::Duration kObjectInterval = base::milliseconds(500);
inline constexpr base::Duration kPoseInterval = base::milliseconds(500);
inline constexpr base::Duration kPlotInterval = base::milliseconds(100);
inline constexpr std::uint32_t kDigestEvery = 50;  ///< frames

/// An answer of the console waits for an empty queue, so that the log comes first. After this many turns it takes any
/// room, and inputs and reports are refused until it got it: a console must answer on the slowest link.
inline constexpr std::uint8_t kPatience = 64;

template <class Profile>
class Telling {
 public:
  explicit Telling(Memory<Profile>& memory) : m_(memory) {}

  [[nodiscard]] bool shown_in(Mode mode) const { return m_.console.mode == mode && !m_.run.testing; }
  /// Records are told: to the console, or to the journal.
  [[nodiscard]] bool logs() const { return (m_.console.mode == Mode::kLog || m_.journal.on()) && !m_.run.testing; }
  /// Into each of them, or into none.
  template <class Record>
  [[nodiscard]] bool put_in_logs(const Record& record) {
    const bool shown = m_.console.mode == Mode::kLog;
    if (m_.journal.on() && !m_.journal.has_room()) return false;
    if (shown && !m_.output.put(record)) return false;
    return !m_.journal.on() || m_.journal.put(record);
  }

  /// Reports and inputs stand back for an answer that has waited too long.
  [[nodiscard]] bool stands_back() const { return m_.console.turns_without_room >= kPatience; }

  /// The calibration's records in the order in which they are told: header, camera, signatures, settings.
  static constexpr std::size_t kHeaderRecord = 0;
  static constexpr std::size_t kCameraRecord = 1;
  static constexpr std::size_t kSignatureRecords = 2;
  [[nodiscard]] std::size_t setting_records() const { return kSignatureRecords + m_.signatures.size(); }

  /// What comes after a record that has changed is told again too: cheaper than to remember which did.
  void retell_from(std::size_t record) {
    if (record < m_.run.telling) m_.run.telling = static_cast<std::uint8_t>(record);
    m_.run.told = false;
  }

  /// Before an input: all of it again from time to time, so that a recording may begin anywhere.
  void calibration_if_due() {
    if (logs() && m_.run.told && m_.run.time && m_.run.calibration_at.since(*m_.run.time) >= kRepeatCalibration) {
      m_.run.telling = 0;
      m_.run.calibration_at = Stamp(*m_.run.time);
    }
    calibration();
  }

  /// Mode log: one record at a time, as the queue has room; inputs wait for it, so that none is used before the log
  /// says how.
  void calibration() {
    if (!logs()) return;
    while (m_.run.telling < setting_records() + config::kKeys) {
      if (!calibration_record(m_.run.telling)) return;
      ++m_.run.telling;
    }
    m_.run.told = true;
  }

  void alert(const record::AlertReport& report) {
    journal_or_drop(report);
    if (!m_.console.alerts) return;
    if (shown_in(Mode::kLog)) put_or_drop(report);
    if (!shown_in(Mode::kText)) return;
    say([&](std::span<char> room) { return describe(report, name_of(report.signature), room); });
  }

  void plot(const std::optional<Obstacle>& obstacle, record::AlertLevel level, base::Time now) {
    if (!shown_in(Mode::kPlot) || m_.console.plotted_at.since(now) < kPlotInterval) return;
    std::optional<Nearest> nearest;
    if (obstacle) nearest = nearest_of(*obstacle);
    m_.console.plotted_at = Stamp(now);
    say([&](std::span<char> room) { return describe_plot(nearest, level, room); });
  }

  void digest(std::uint32_t frame) {
    if (!logs() || m_.map.frames() % kDigestEvery != 0) return;
    report(record::DigestReport{frame, m_.map.digest()});
  }

  void objects(base::Time now) {
    if (!logs()) return;
    for (std::size_t o = 0; o < Profile::kObjects; ++o) {
      const recon::Object<Profile>& object = m_.map.slots()[o];
      if (!object.used() || !object.cylinder.estimate().ok()) continue;
      ReportState& last = m_.reports[o];
      const record::ObjectState state = state_of(object, now);
      const bool changed = last.id != object.id || last.state != state;
      const bool due = m_.map.seen_now(o) && last.at.since(now) >= kObjectInterval;
      if (!changed && !due) continue;
      last = {object.id, state, Stamp(now)};
      report(report_object(object, see_obstacle(object, RobotPlace(robot_pose(m_)), {}), now));
    }
  }

  /// Where the robot was at an exposure, while the pose is corrected.
  void pose(base::Time exposure) {
    if (!logs() || !m_.map.correction().running()) return;
    if (m_.run.pose_told_at.since(exposure) < kPoseInterval) return;
    m_.run.pose_told_at = Stamp(exposure);
    report(report_pose(m_.map.correction().pose(), m_.map.correction().sigma(), exposure));
  }

  void status() {
    if (!logs() || !m_.run.time || m_.run.status_at.since(*m_.run.time) < kStatusInterval) return;
    m_.run.status_at = Stamp(*m_.run.time);
    report(report_status(*m_.run.time, m_.counters, m_.map.size()));
  }

  /// A cable's state: a record in mode log, a sentence in mode text. It waits for room, and for the end of an answer,
  /// rather than be lost, for it is said only once. `source` is asked for its words only then.
  template <class Source>
  void link(LinkWatch& watch, const Source& source, std::string_view name, base::Time now) {
    if (m_.run.testing || m_.console.answer.pending() || (logs() && !m_.run.told)) return;
    const std::optional<sensor::LinkState> state = watch.observe(source.link(), now);
    if (state && told_link(link_words(source, name, *state), *state, now)) watch.told();
  }
  /// Somebody begins to read records: both links again.
  void retell_links() {
    m_.links.camera.retell();
    m_.links.odometry.retell();
  }

  /// To whoever gets records; dropped and counted where there is no room.
  template <class Record>
  void report(const Record& record) {
    journal_or_drop(record);
    if (shown_in(Mode::kLog)) put_or_drop(record);
  }

  /// A line for people, dropped and counted if there is no room.
  template <class Write>
  void say(Write&& write) {
    if (stands_back() || !m_.output.put_line(write)) ++m_.counters.records_dropped;
  }

  /// The signature's name, or empty.
  [[nodiscard]] std::string_view name_of(std::uint8_t signature) const {
    for (const record::Signature& known : m_.signatures) {
      if (known.signature == signature) return known.name.view();
    }
    return {};
  }

 private:
  template <class Words>
  [[gnu::noinline]] bool told_link(const Words& words, sensor::LinkState state, base::Time now) {
    if (std::string_view(words.device).empty()) return true;
    const bool logged =
        !logs() || put_in_logs(record::LinkReport{now, sensor::Text(words.device), state, sensor::Text(words.detail)});
    if (!logged || !shown_in(Mode::kText) || std::string_view(words.name).empty()) return logged;
    const bool fits =
        m_.output.put_line([&](std::span<char> room) { return describe_link(state, words.name, words.remedy, room); });
    // What does not fit into an empty queue never will. With a journal, the record has been told already.
    if (!fits && (logs() || m_.output.waiting().empty())) ++m_.counters.records_dropped;
    return fits || logs() || m_.output.waiting().empty();
  }

  [[nodiscard]] bool calibration_record(std::size_t index) {
    if (index == kHeaderRecord) {
      if (!m_.run.header_due) return true;
      m_.run.header_due = !put_in_logs(*m_.run.header);
      return !m_.run.header_due;
    }
    if (index == kCameraRecord) return !m_.calibration.known || put_in_logs(m_.calibration.intrinsics);
    if (index < setting_records()) return put_in_logs(m_.signatures[index - kSignatureRecords]);
    const auto key = static_cast<config::Key>(index - setting_records());
    return put_in_logs(record::Setting{config::info(key).name, m_.settings.text(key)});
  }

  template <class Record>
  void journal_or_drop(const Record& record) {
    if (m_.journal.on() && !m_.run.testing && !m_.journal.put(record)) ++m_.counters.records_dropped;
  }

  template <class Record>
  void put_or_drop(const Record& record) {
    if (stands_back() || !m_.output.put(record)) ++m_.counters.records_dropped;
  }

  Memory<Profile>& m_;
};

}  // namespace fencepost::app
