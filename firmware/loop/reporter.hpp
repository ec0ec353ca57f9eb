// The loop's own output: records in mode log, sentences in mode text, numbers in mode plot.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/console/link_words.hpp"
#include "firmware/console/reports.hpp"
#include "firmware/console/signatures.hpp"
#include "firmware/console/text.hpp"
#include "firmware/loop/memory.hpp"

namespace fencepost::loop {

inline constexpr base::Duration kRepeatCalibration = base::milliseconds(10'000);
inline constexpr base::Duration kStatusInterval = base::milliseconds(1000);
inline constexpr base::Duration kObjectInterval = base::milliseconds(500);
inline constexpr base::Duration kPoseInterval = base::milliseconds(500);
inline constexpr base::Duration kPlotInterval = base::milliseconds(100);
inline constexpr base::Duration kHeartbeatInterval = base::milliseconds(100);
inline constexpr std::uint32_t kDigestEvery = 50;  ///< frames

/// Back-pressure: an answer of the console waits for an empty queue, so that the log comes first. After this many turns
/// it takes any room, and until then inputs and reports are refused. A console must answer on the slowest link.
inline constexpr std::uint8_t kTurnsBeforeYield = 64;

template <class Profile>
class Reporter {
 public:
  explicit Reporter(Memory<Profile>& memory) : m_(memory) {}

  [[nodiscard]] bool shown_in(console::Mode mode) const { return m_.console.mode == mode && !m_.run.testing; }
  /// Records are emitted: to the console, or to the journal.
  [[nodiscard]] bool logs() const {
    return (m_.console.mode == console::Mode::kLog || m_.journal.on()) && !m_.run.testing;
  }
  /// Into each of them, or into none.
  template <class Record>
  [[nodiscard]] bool put_in_logs(const Record& record) {
    const bool shown = m_.console.mode == console::Mode::kLog;
    if (m_.journal.on() && !m_.journal.has_room()) return false;
    if (shown && !m_.output.put(record)) return false;
    return !m_.journal.on() || m_.journal.put(record);
  }

  /// Reports and inputs yield to an answer that has waited too long.
  [[nodiscard]] bool yields() const { return m_.console.turns_without_room >= kTurnsBeforeYield; }

  /// Index of the first of the calibration's records. They are sent in the order header, camera, signatures, settings,
  /// result of the camera's check.
  static constexpr std::size_t kHeaderRecord = 0;
  static constexpr std::size_t kCameraRecord = 1;      ///< index of the camera's record
  static constexpr std::size_t kSignatureRecords = 2;  ///< index of the first signature's
  [[nodiscard]] std::size_t setting_records() const { return kSignatureRecords + m_.signatures.size(); }
  [[nodiscard]] std::size_t doubt_record() const { return setting_records() + config::kKeys; }

  /// A car's settings make poses of its readings, and a log has the poses.
  static constexpr bool in_log(config::Key key) {
    return key < config::Key::kCarCounts || key > config::Key::kGyroBias;
  }

  /// The records after one that has changed are sent again, too: cheaper than to remember which of them did.
  void resend_from(std::size_t record) {
    if (record < m_.run.next_record) m_.run.next_record = static_cast<std::uint8_t>(record);
    m_.run.calibration_sent = false;
  }

  /// Before an input: all of it again from time to time, so that a recording may begin anywhere.
  void calibration_if_due() {
    const bool sent = logs() && m_.run.calibration_sent && m_.run.time;
    if (sent && m_.run.calibration_at.since(*m_.run.time) >= kRepeatCalibration) {
      m_.run.next_record = 0;
      m_.run.calibration_at = base::Stamp(*m_.run.time);
    }
    calibration();
  }

  /// Sends as many of the calibration's records as the queue has room for. Inputs wait for all of them, so that the log
  /// holds the calibration before any input that uses it.
  void calibration() {
    if (!logs()) return;
    while (m_.run.next_record <= doubt_record()) {
      if (!calibration_record(m_.run.next_record)) return;
      ++m_.run.next_record;
    }
    m_.run.calibration_sent = true;
  }

  void alert(const record::AlertReport& report) {
    emit(report, [&](std::span<char> room) { return console::describe(report, name_of(report.signature), room); });
  }
  /// A report that may repeat an earlier one: in words it is said only if is_new() says so.
  void alert(const record::AlertReport& report, alert::AlertState& state) {
    const bool in_words = m_.console.alerts && shown_in(console::Mode::kText);
    if (!in_words) state.said = record::AlertLevel::kClear;  // a reader from now on gets all alerts
    if (!in_words || is_new(state, report)) return alert(report);
    journal_or_drop(report);
  }

  /// The same at level blind; its sentence has the reason.
  void blind(alert::Blindness reason, base::Time now) {
    emit(console::report_blind(now), [reason](std::span<char> room) { return console::describe_blind(reason, room); });
  }

  /// The result of the camera's check has changed. Its record goes before the next input.
  void camera_doubt() {
    resend_from(doubt_record());
    if (!shown_in(console::Mode::kText)) return;
    say([&](std::span<char> room) { return console::describe(m_.camera_doubt.said(), room); });
  }

  /// A line for plotters is due.
  [[nodiscard]] bool plots(base::Time now) const {
    return shown_in(console::Mode::kPlot) && m_.console.plotted_at.since(now) >= kPlotInterval;
  }
  void plot(const std::optional<alert::Obstacle>& obstacle, const record::Heartbeat& beat) {
    std::optional<console::Nearest> nearest;
    if (obstacle) nearest = console::nearest_of(*obstacle);
    m_.console.plotted_at = base::Stamp(beat.t);
    const record::Doubt doubt = m_.camera_doubt.said().doubt;
    say([&](std::span<char> room) { return console::describe_plot(nearest, beat, doubt, room); });
  }

  void digest(std::uint32_t frame) {
    if (!logs() || m_.map.frames() % kDigestEvery != 0) return;
    report(record::DigestReport{frame, m_.map.digest()});
  }

  void objects(base::Time now) {
    if (!logs()) return;
    const auto objects = m_.map.slots_in_use();
    for (std::size_t o = 0; o < objects.size(); ++o) {
      const recon::Object<Profile>& object = objects[o];
      if (!object.used() || !object.cylinder.estimate().ok()) continue;
      ReportState& last = m_.reports[o];
      const record::ObjectState state = console::state_of(object, now);
      const bool changed = !last.sent || last.state != state;
      const bool due = m_.map.seen_now(o) && last.at.since(now) >= kObjectInterval;
      if (!changed && !due) continue;
      last = {true, state, base::Stamp(now)};
      const alert::Obstacle seen = see_obstacle(object, alert::RobotPlace(robot_pose(m_)), {});
      report(console::report_object(object, seen, now));
    }
  }

  /// Reports the robot's pose at an exposure, while it is corrected.
  void pose(base::Time exposure) {
    if (!logs() || !m_.map.correction().corrects()) return;
    if (m_.run.pose_sent_at.since(exposure) < kPoseInterval) return;
    m_.run.pose_sent_at = base::Stamp(exposure);
    report(console::report_pose(m_.map.correction().pose(), m_.map.correction().sigma(), exposure));
  }

  void status() {
    if (!logs() || !m_.run.time || m_.run.status_at.since(*m_.run.time) < kStatusInterval) return;
    m_.run.status_at = base::Stamp(*m_.run.time);
    report(console::report_status(*m_.run.time, m_.counters, m_.map.size()));
  }

  /// A cable's state: a record in mode log, a sentence in mode text. It is sent only once, so it waits for room and for
  /// the end of an answer rather than being dropped. `source` is asked for its words only then.
  template <class Source>
  void link(LinkWatch& watch, const Source& source, std::string_view name, base::Time now) {
    if (m_.run.testing || m_.console.answer.pending() || (logs() && !m_.run.calibration_sent)) return;
    const std::optional<sensor::LinkState> state = watch.observe(source.link(), now);
    if (state && send_link(console::link_words(source, name, *state), *state, now)) watch.sent();
  }
  /// A new reader of records: both links are sent again.
  void resend_links() {
    m_.links.camera.resend();
    m_.links.odometry.resend();
  }

  /// To console and journal, where they get records; dropped and counted where there is no room.
  template <class Record>
  void report(const Record& record) {
    journal_or_drop(record);
    if (shown_in(console::Mode::kLog)) put_or_drop(record);
  }

  /// A line for people, dropped and counted if there is no room.
  template <class Write>
  void say(Write&& write) {
    if (yields() || !m_.output.put_line(write)) ++m_.counters.records_dropped;
  }

  /// The signature's name, or empty.
  [[nodiscard]] std::string_view name_of(std::uint8_t signature) const {
    return console::name_of(signature, m_.signatures.view());
  }

 private:
  // A switched-off console gets nothing; the journal has it all the same.
  template <class Sentence>
  void emit(const record::AlertReport& report, Sentence&& sentence) {
    if (!m_.run.testing) m_.listener.tell(report, sentence);
    journal_or_drop(report);
    if (!m_.console.alerts) return;
    if (shown_in(console::Mode::kLog)) put_or_drop(report);
    if (shown_in(console::Mode::kText)) say(sentence);
  }

  template <class Words>
  [[gnu::noinline]] bool send_link(const Words& words, sensor::LinkState state, base::Time now) {
    if (std::string_view(words.device).empty()) return true;
    const bool logged =
        !logs() || put_in_logs(record::LinkReport{now, sensor::Text(words.device), state, sensor::Text(words.detail)});
    if (!logged || !shown_in(console::Mode::kText) || std::string_view(words.name).empty()) return logged;
    const bool fits = m_.output.put_line(
        [&](std::span<char> room) { return console::describe_link(state, words.name, words.remedy, room); });
    // A line that does not fit into an empty queue never will. With a journal, the record is there already.
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
    if (index == doubt_record()) return !m_.camera_doubt.spoke() || put_in_logs(m_.camera_doubt.said());
    const auto key = static_cast<config::Key>(index - setting_records());
    if (!in_log(key)) return true;
    return put_in_logs(record::Setting{config::info(key).name, m_.settings.text(key)});
  }

  template <class Record>
  void journal_or_drop(const Record& record) {
    if (m_.journal.on() && !m_.run.testing && !m_.journal.put(record)) ++m_.counters.records_dropped;
  }

  template <class Record>
  void put_or_drop(const Record& record) {
    if (yields() || !m_.output.put(record)) ++m_.counters.records_dropped;
  }

  Memory<Profile>& m_;
};

}  // namespace fencepost::loop
