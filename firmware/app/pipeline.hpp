// What one input does: every effect of an odometry sample, a frame, a calibration. Knows no sensor and no link.
// All times in here are stream times, so a replay takes the same decisions as the robot did.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/app/memory.hpp"
#include "firmware/app/reports.hpp"
#include "firmware/app/text.hpp"

namespace fencepost::app {

/// What the console shows. In `log` an input is used only if its record could be queued.
enum class Mode : std::uint8_t { kText, kLog, kQuiet };

inline constexpr base::Duration kRepeatCalibration = base::milliseconds(10'000);
inline constexpr base::Duration kStatusInterval = base::milliseconds(1000);
inline constexpr base::Duration kObjectInterval = base::milliseconds(500);
inline constexpr base::Duration kWatchInterval = base::milliseconds(100);
inline constexpr base::Duration kMotionSpan = base::milliseconds(200);
inline constexpr std::uint32_t kDigestEvery = 50;  ///< frames

template <class Profile>
class Pipeline {
 public:
  Pipeline(Memory<Profile>& memory, Mode mode) : m_(memory), mode_(mode) {}

  /// A new run: the map, the clock and the calibration start again; counters and settings stay. `header` is told once
  /// the queue has room and must live until then.
  void start_run(const record::Header& header) {
    m_.map.clear();
    m_.waiting.clear();
    m_.poses.clear();
    m_.calibration = {};
    m_.signatures.clear();
    m_.alerts.fill({});
    m_.reports.fill({});
    m_.output.clear();
    m_.run = {};
    m_.run.header = &header;
    retell_all();
  }

  void set_camera(const sensor::CameraIntrinsics& intrinsics) {
    Calibration& calibration = m_.calibration;
    if (calibration.known && calibration.intrinsics == intrinsics) return;
    const auto other = static_cast<std::uint8_t>(1 - calibration.current);
    for (std::size_t i = 0; i < m_.waiting.size(); ++i) {
      if (m_.waiting[i].camera != other) continue;
      refuse_waiting();  // two calibrations ago: the model it needs is gone
      i = 0;
    }
    calibration.known = true;
    calibration.current = other;
    calibration.intrinsics = intrinsics;
    calibration.models[other] = recon::make_camera_model(intrinsics);
    retell_all();
  }

  /// A table that is full keeps what it has; false then.
  bool set_signature(const record::Signature& signature) {
    for (record::Signature& known : m_.signatures) {
      if (known.signature != signature.signature) continue;
      if (!(known == signature)) {
        known = signature;
        retell_all();
      }
      return true;
    }
    if (!m_.signatures.push_back(signature)) return false;
    retell_all();
    return true;
  }

  std::optional<config::SettingError> set(std::string_view key, std::string_view value) {
    const config::Settings before = m_.settings;
    const auto error = m_.settings.set(key, value);
    if (!(m_.settings == before)) retell_all();
    return error;
  }

  void take(const sensor::OdometrySample& sample) {
    tell_calibration();
    if (mode_ == Mode::kLog && !m_.output.put(sample)) {
      ++m_.counters.records_dropped;
      return;
    }
    advance(sample.t);
    m_.poses.push(sample);
    ++m_.counters.odometry;
  }

  void take(const sensor::BlobFrame& frame) {
    tell_calibration();
    if (mode_ == Mode::kLog && (!m_.run.told || !m_.output.put(frame))) {
      refuse(Refusal::kQueue);
      return;
    }
    advance(frame.t);
    if (!m_.calibration.known) {
      refuse(Refusal::kNoCamera);
      return;
    }
    if (m_.waiting.full()) refuse_waiting();
    m_.waiting.push_over_oldest(recon::make_waiting(frame, m_.calibration.current));
  }

  /// Handles the oldest waiting frame if its pose is known or will never be. True if it left the queue.
  bool place_next_frame() {
    return place_next_frame([](const recon::WaitingFrame&) {});
  }
  /// The same; `seen(frame)` is called for a frame that the map has taken, with its pieces joined.
  template <class Seen>
  bool place_next_frame(Seen&& seen) {
    if (m_.waiting.empty()) return false;
    recon::WaitingFrame& frame = m_.waiting[0];
    const auto pose = m_.poses.at(frame.t - m_.calibration.models[frame.camera].latency);
    if (!pose) {
      const bool waits = pose.error() == recon::PoseMiss::kNotYet && *m_.run.time - frame.t < recon::kMaxWait;
      if (waits) return false;
      refuse(pose.error() == recon::PoseMiss::kGap ? Refusal::kOdometryGap : Refusal::kNoPose);
      m_.waiting.pop_front();
      return true;
    }
    reconstruct(frame, *pose);
    seen(frame);
    watch_path(frame.t);
    tell_digest(frame.frame);
    tell_objects(frame.t);
    m_.waiting.pop_front();
    return true;
  }

  /// The camera is silent, the robot still drives: the map goes on warning.
  void watch_without_frames() {
    if (!m_.run.time || m_.poses.empty() || *m_.run.time - m_.run.watched_at < kWatchInterval) return;
    watch_path(*m_.run.time);
  }

  void tell_status() {
    if (mode_ != Mode::kLog || !m_.run.time || *m_.run.time - m_.run.status_at < kStatusInterval) return;
    m_.run.status_at = *m_.run.time;
    put_or_drop(status());
  }

  /// The stream has ended: frames that still wait will never have a pose.
  void finish() {
    while (!m_.waiting.empty()) refuse_waiting();
  }

  [[nodiscard]] const Memory<Profile>& memory() const { return m_; }
  [[nodiscard]] Memory<Profile>& memory() { return m_; }
  [[nodiscard]] std::optional<base::Time> stream_time() const { return m_.run.time; }

 private:
  void advance(base::Time t) {
    if (!m_.run.time) m_.run.watched_at = m_.run.status_at = m_.run.calibration_at = t;
    if (!m_.run.time || t > *m_.run.time) m_.run.time = t;
  }

  void refuse(Refusal reason) { ++m_.counters.refused[static_cast<std::size_t>(reason)]; }
  void refuse_waiting() {
    refuse(Refusal::kNoPose);
    m_.waiting.pop_front();
  }

  void reconstruct(recon::WaitingFrame& frame, const recon::MapPose& pose) {
    const recon::Confirmation confirmation{m_.settings.raw(config::Key::kConfirmK),
                                           m_.settings.raw(config::Key::kConfirmN)};
    m_.map.add_frame(frame, m_.calibration.models[frame.camera], pose, m_.noise, confirmation);
    ++m_.counters.frames;
    m_.counters.blobs += static_cast<std::uint32_t>(frame.blobs.size());
  }

  void watch_path(base::Time now) {
    m_.run.watched_at = now;
    RobotPath path;
    path.motion = m_.poses.motion(kMotionSpan);
    path.body_radius = 0.5F * m_.settings.number(config::Key::kRobotWidth);
    path.half_width = path.body_radius + m_.settings.number(config::Key::kRobotMargin);
    for (std::size_t o = 0; o < Profile::kObjects; ++o) {
      const recon::ObjectCore& object = m_.map.slots()[o];
      if (!object.used()) continue;
      const Obstacle obstacle = see_obstacle(object, m_.poses.latest(), path);
      const auto level = judge(m_.alerts[o], object, obstacle, m_.settings, now);
      if (level) tell_alert(report_alert(object, obstacle, *level, now));
    }
  }

  void tell_alert(const record::AlertReport& alert) {
    if (mode_ == Mode::kLog) put_or_drop(alert);
    if (mode_ != Mode::kText) return;
    const bool put =
        m_.output.put_line([&](std::span<char> room) { return describe(alert, name_of(alert.signature), room); });
    if (!put) ++m_.counters.records_dropped;
  }

  void tell_digest(std::uint32_t frame) {
    if (mode_ != Mode::kLog || m_.map.frames() % kDigestEvery != 0) return;
    put_or_drop(record::DigestReport{frame, m_.map.digest()});
  }

  void tell_objects(base::Time now) {
    if (mode_ != Mode::kLog) return;
    for (std::size_t o = 0; o < Profile::kObjects; ++o) {
      const recon::ObjectCore& object = m_.map.slots()[o];
      if (!object.used() || !object.cylinder.estimate().ok()) continue;
      ReportState& last = m_.reports[o];
      const record::ObjectState state = state_of(object, now);
      const bool changed = last.id != object.id || last.state != state;
      const bool due = m_.map.seen_now(o) && now - last.at >= kObjectInterval;
      if (!changed && !due) continue;
      last = {object.id, state, now};
      put_or_drop(report_object(object, see_obstacle(object, m_.poses.latest(), {}), now));
    }
  }

  [[nodiscard]] record::StatusReport status() const {
    record::StatusReport report;
    report.t = *m_.run.time;
    report.frames = m_.counters.frames;
    report.blobs = m_.counters.blobs;
    report.blobs_dropped = m_.counters.blobs_dropped;
    report.odometry = m_.counters.odometry;
    report.rejected = m_.counters.rejected;
    report.refused = m_.counters.refused_in_all();
    report.records_dropped = m_.counters.records_dropped;
    report.objects = m_.map.size();
    report.loop_us_max = m_.counters.loop_us_max;
    return report;
  }

  // Header, camera, signatures and settings are told one record at a time, as the queue has room; frames wait for it.
  void retell_all() {
    m_.run.telling = 0;
    m_.run.told = false;
  }
  void tell_calibration() {
    if (mode_ != Mode::kLog) return;
    if (m_.run.told && m_.run.time && *m_.run.time - m_.run.calibration_at >= kRepeatCalibration) {
      m_.run.telling = 0;
      m_.run.calibration_at = *m_.run.time;
    }
    const std::size_t settings_from = 2 + m_.signatures.size();
    const std::size_t all = settings_from + config::kKeys;
    while (m_.run.telling < all) {
      if (!tell_calibration_record(m_.run.telling, settings_from)) return;
      ++m_.run.telling;
    }
    m_.run.told = true;
  }
  [[nodiscard]] bool tell_calibration_record(std::size_t index, std::size_t settings_from) {
    if (index == 0) {
      if (!m_.run.header) return true;
      const bool put = m_.output.put(*m_.run.header);
      if (put) m_.run.header = nullptr;
      return put;
    }
    if (index == 1) return !m_.calibration.known || m_.output.put(m_.calibration.intrinsics);
    if (index < settings_from) return m_.output.put(m_.signatures[index - 2]);
    const auto key = static_cast<config::Key>(index - settings_from);
    return m_.output.put(record::Setting{config::info(key).name, m_.settings.text(key)});
  }

  template <class Record>
  void put_or_drop(const Record& record) {
    if (!m_.output.put(record)) ++m_.counters.records_dropped;
  }

  [[nodiscard]] std::string_view name_of(std::uint8_t signature) const {
    for (const record::Signature& known : m_.signatures) {
      if (known.signature == signature) return known.name.view();
    }
    return {};
  }

  Memory<Profile>& m_;
  Mode mode_;
};

}  // namespace fencepost::app
