// Every effect of one input: an odometry sample, a frame or a calibration. Knows no sensor and no link.
// All times in here are stream times, so a replay decides as the robot did.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/config/car.hpp"
#include "firmware/loop/memory.hpp"
#include "firmware/loop/path_watch.hpp"
#include "firmware/loop/reporter.hpp"
#include "firmware/record/run_rules.hpp"

namespace fencepost::loop {

/// Maximum clock-offset correction per input. The sender's clock may run slow.
inline constexpr base::Duration kMaxSlip = base::milliseconds(10);

template <class Profile>
class Pipeline {
 public:
  Pipeline(Memory<Profile>& memory, console::Mode mode) : m_(memory), reporter_(memory) { m_.console.mode = mode; }

  [[nodiscard]] console::Mode mode() const { return m_.console.mode; }
  /// In `log` everything that a replay must know is sent again.
  void set_mode(console::Mode mode) {
    m_.console.mode = mode;
    if (mode != console::Mode::kLog) return;
    reporter_.resend_from(reporter_.kHeaderRecord);
    reporter_.resend_links();
  }

  /// The first run: no calibration, no signatures. `header` is sent once the queue has room and must
  /// outlive this.
  void start_run(const record::Header& header) {
    m_.calibration = {};
    m_.signatures.clear();
    m_.run.header = &header;
    restart();
  }

  /// A new run: the map and the clock start again; calibration, settings and counters stay.
  void restart() {
    finish();
    m_.map.clear();
    forget_floor();
    m_.poses.clear();
    m_.car = {};
    m_.looming.clear();
    m_.alerts.fill({});
    m_.front_alert = {};
    m_.camera_doubt = {};
    m_.reports.fill({});
    m_.console.guide.new_run();
    m_.trail.clear();
    const record::Header* header = m_.run.header;
    m_.run = {};
    m_.run.header = header;
    m_.run.header_due = header != nullptr;
    reporter_.resend_from(reporter_.kHeaderRecord);
    if (reporter_.logs()) reporter_.resend_links();
  }

  /// In force for the frames after it. Waiting frames keep the calibration that they came with. With a third
  /// calibration in use, the frames of the oldest are refused.
  void set_camera(const sensor::CameraIntrinsics& intrinsics) {
    Calibration& calibration = m_.calibration;
    if (calibration.known && calibration.intrinsics == intrinsics) return;
    if (waits_with(calibration.current)) {
      calibration.current = spare_model();
      while (waits_with(calibration.current)) refuse_waiting();
    }
    forget_calibration();
    calibration.known = true;
    calibration.intrinsics = intrinsics;
    calibration.models[calibration.current] = recon::make_camera_model(intrinsics);
    reporter_.resend_from(reporter_.kCameraRecord);
  }

  /// A table that is full keeps what it has; false then. A pad is in force for the frames after it.
  bool set_signature(const record::Signature& signature) {
    std::size_t index = 0;
    while (index < m_.signatures.size() && m_.signatures[index].signature != signature.signature) ++index;
    std::int8_t pad = 0;
    if (index == m_.signatures.size()) {
      if (!m_.signatures.push_back(signature)) return false;
    } else if (m_.signatures[index] == signature) {
      return true;
    } else {
      pad = m_.signatures[index].pad;
    }
    m_.signatures[index] = signature;
    if (signature.pad != pad) forget_calibration();
    reporter_.resend_from(reporter_.kSignatureRecords + index);
    return true;
  }

  std::optional<config::SettingError> set(std::string_view key, std::string_view value) {
    const config::Settings before = m_.settings;
    const auto error = m_.settings.set(key, value);
    for (std::size_t i = 0; i < config::kKeys; ++i) {
      const auto changed = static_cast<config::Key>(i);
      if (before.raw(changed) != m_.settings.raw(changed)) reporter_.resend_from(reporter_.setting_records() + i);
    }
    return error;
  }

  /// The devices to choose from, which must outlive this. Those of an image without any setting are in force.
  void offer(const config::DeviceOffer& offer) {
    m_.offer = &offer;
    choose(offer.limits.initial);
    use_delivered_calibration();
  }
  /// Applies a stored setting as it is, whether or not it fits the settings restored before it.
  void restore_device(std::string_view key, std::string_view value) {
    config::Devices devices = m_.devices;
    if (devices.set(key, value)) return;
    const bool seen_otherwise = devices.calibration() != m_.devices.calibration();
    choose(devices);
    if (seen_otherwise) use_delivered_calibration();
  }
  /// After the last stored setting: if the devices cannot be had together, those of an image without any setting.
  void end_restoring() {
    if (refusal(m_.devices, m_.offer->limits) == config::Refusal::kNone) return;
    choose(m_.offer->limits.initial);
    use_delivered_calibration();
  }

  struct DeviceChange {
    std::optional<config::SettingError> error;
    config::Refusal refusal = config::Refusal::kNone;
    [[nodiscard]] bool done() const { return !error && refusal == config::Refusal::kNone; }
  };
  /// In force at once. A camera and a lens come with their calibration, except for where they are mounted. A new run
  /// begins: everything measured with other devices is forgotten. Nothing changes on an error, or if the devices cannot
  /// be had together.
  DeviceChange set_device(std::string_view key, std::string_view value) {
    config::Devices devices = m_.devices;
    const DeviceChange change{devices.set(key, value), refusal(devices, m_.offer->limits)};
    if (!change.done()) return change;
    const std::size_t index = config::device_key_named(key);
    const bool of_camera = static_cast<config::DeviceKey>(index) <= config::DeviceKey::kLens;
    finish();
    if (devices != m_.devices) choose(devices);
    if (of_camera) use_delivered_calibration();
    restart();
    return change;
  }

  /// Applies an input, refuses it (and counts that), or rejects it: then a reader would reject its record.
  /// errors: range (position or heading, see record::inside_range), time
  std::optional<record::Reject> accept(const sensor::OdometrySample& sample) {
    m_.run.used = false;
    if (!record::inside_range(sample)) return reject(record::Reject::kRange);
    const bool late = !m_.poses.empty() && sample.t <= m_.poses.latest_time();
    if (late && !m_.run.testing) return reject(record::Reject::kTime);
    reporter_.calibration_if_due();
    if (!loggable(sample)) {
      ++m_.counters.records_dropped;
      return std::nullopt;
    }
    m_.run.used = true;
    apply(sample);
    ++m_.counters.odometry;
    return std::nullopt;
  }

  /// Why a car's reading cannot be used with these settings.
  [[nodiscard]] odometry::CarProblem problem_of(const sensor::CarSample& sample) const {
    return odometry::problem_of(sample, config::car_of(m_.settings));
  }
  /// The pose that it leads to, to be accepted as any other: the log has poses only.
  /// errors: range (see problem_of), time
  [[gnu::noinline]] base::Result<sensor::OdometrySample, record::Reject> integrate(const sensor::CarSample& sample) {
    if (problem_of(sample) != odometry::CarProblem::kNone) return *reject(record::Reject::kRange);
    const bool late = !m_.poses.empty() && sample.t <= m_.poses.latest_time();
    if (late) return *reject(record::Reject::kTime);
    return m_.car.take(sample, config::car_of(m_.settings));
  }

  /// errors: range (a box leaves the image), time
  std::optional<record::Reject> accept(const sensor::BlobFrame& frame) {
    m_.run.used = false;
    const sensor::CameraIntrinsics& camera = m_.calibration.intrinsics;
    const bool outside = m_.calibration.known && !record::inside_image(frame, camera.width, camera.height);
    if (outside) return reject(record::Reject::kRange);
    const bool late = m_.run.last_frame && frame.t <= *m_.run.last_frame;
    if (late && !m_.run.testing) return reject(record::Reject::kTime);
    reporter_.calibration_if_due();
    if (!loggable(frame)) {
      refuse(console::Refusal::kQueue);
      return std::nullopt;
    }
    m_.run.used = true;
    if (m_.calibration.known) {
      apply(frame, m_.calibration.current);
    } else {
      advance_frame(frame.t);
      refuse(console::Refusal::kNoCamera);
    }
    return std::nullopt;
  }

  /// Counts a record that was not used because a reader would not have read it.
  std::optional<record::Reject> reject(record::Reject reason) {
    ++m_.counters.rejected;
    return reason;
  }

  /// Handles the oldest waiting frame if its pose is known or will never be. True if it left the queue.
  bool place_next_frame() {
    return place_next_frame([](const recon::WaitingFrame&) {});
  }
  /// The same; `placed(frame)` is called for a frame that the map was updated with, its pieces joined.
  template <class Placed>
  bool place_next_frame(Placed&& placed) {
    if (m_.waiting.empty()) return false;
    recon::WaitingFrame& frame = m_.waiting[0];
    const auto pose = m_.poses.at(frame.t - m_.calibration.models[frame.camera].latency);
    if (!pose) {
      const bool waits = pose.error() == recon::PoseMiss::kNotYet && *m_.run.time - frame.t < recon::kMaxWait;
      if (waits) return false;
      refuse_waiting(pose.error() == recon::PoseMiss::kGap ? console::Refusal::kOdometryGap
                                                           : console::Refusal::kNoPose);
      return true;
    }
    m_.run.sight.frame_used(frame, m_.calibration.models[frame.camera], *pose);
    m_.looming.look(frame, m_.calibration.models[frame.camera], &*pose);
    reconstruct(frame, *pose);
    if (m_.console.guide.on() && reporter_.logs()) guide_drive(frame, *pose);
    watch_.follow_objects(frame.t);
    if (!m_.run.testing) watch_.judge_camera(frame.t);
    placed(frame);
    watch_.watch_path(frame.t);
    reporter_.digest(frame.frame);
    reporter_.pose(frame.t - m_.calibration.models[frame.camera].latency);
    reporter_.objects(frame.t);
    m_.waiting.pop_front();
    return true;
  }

  /// After each input: the alerts and the heartbeat that do not wait for a frame.
  void watch_without_frames() {
    watch_.watch_without_frames();
    if (m_.run.time && !m_.run.testing && beat_due(*m_.run.time)) beat(*m_.run.time);
  }

  /// True if the latest input was used: it is in the logs, where there are any, and has effects.
  [[nodiscard]] bool used_input() const { return m_.run.used; }

  /// This robot's clock stamps (some of) its inputs: it is `now` by it, and one was just used, or may be. From now on
  /// time passes without inputs, too. A delayed input never moves stream time back; otherwise stale data would be
  /// treated as current.
  void set_clock(base::Time now) {
    base::Duration behind = now - m_.run.time.value_or(now);
    if (m_.run.behind && behind > *m_.run.behind) {
      if (!m_.run.newest) return;
      behind = std::min(behind, *m_.run.behind + kMaxSlip);
    }
    m_.run.behind = behind;
  }
  /// No input has come for a while. A log has each of these moments as a heartbeat, by which a replay has them, too.
  void pass_time(base::Time now) {
    if (!m_.run.behind || m_.run.testing) return;
    const base::Time t = now - *m_.run.behind;
    const bool due = !m_.run.time || (t > *m_.run.time && (beat_due(t) || watch_.turns_blind(t)));
    if (due) accept_passing(t);
  }
  /// One of those moments.
  void accept_passing(base::Time t) {
    if ((m_.run.time && t <= *m_.run.time) || m_.run.testing) return;
    reporter_.calibration_if_due();
    const record::Heartbeat beat = watch_.heartbeat(t);
    if (!loggable(beat)) return;
    if (reporter_.logs()) reporter_.report(watch_.speed_limit(beat));
    advance(t);
    m_.run.beat_at = base::Stamp(t);
    watch_.watch_path(t);
  }

  void send_status() { reporter_.status(); }

  /// The stream has ended: frames that still wait will never have a pose.
  void finish() {
    while (!m_.waiting.empty()) refuse_waiting();
    m_.map.finish();
  }

  /// The self-test: a run of its own in this memory, of which nothing is reported or counted. Inputs that come
  /// meanwhile are refused. It ends with a new run.
  void start_selftest() {
    restart();
    m_.run.testing = true;
  }
  [[nodiscard]] bool testing() const { return m_.run.testing; }
  void accept_selftest(const sensor::CameraIntrinsics& camera) {
    m_.calibration.models[spare_model()] = recon::make_camera_model(camera);
  }
  void accept_selftest(const sensor::OdometrySample& sample) { apply(sample); }
  void accept_selftest(const sensor::BlobFrame& frame) { apply(frame, spare_model()); }

  [[nodiscard]] const Memory<Profile>& memory() const { return m_; }
  [[nodiscard]] Memory<Profile>& memory() { return m_; }
  [[nodiscard]] Reporter<Profile>& reporter() { return reporter_; }
  [[nodiscard]] const Reporter<Profile>& reporter() const { return reporter_; }
  [[nodiscard]] std::optional<base::Time> stream_time() const { return m_.run.time; }
  [[nodiscard]] bool has_clock() const { return m_.run.behind.has_value(); }
  /// The heartbeat in force now, sent or not. During the self-test the robot sees nothing else and is blind.
  [[nodiscard]] record::Heartbeat in_force() const {
    record::Heartbeat beat = watch_.heartbeat(m_.run.time.value_or(base::Time{}));
    if (m_.run.testing) beat.level = record::AlertLevel::kBlind;
    return beat;
  }

  /// The maximum speed of the robot while that is in force.
  [[nodiscard]] record::SpeedLimit speed_limit(const record::Heartbeat& beat) const { return watch_.speed_limit(beat); }

  // The contents of a screen, see view::MapSource.
  static constexpr std::size_t kObjects = Profile::kObjects;
  [[nodiscard]] std::span<const recon::Object<Profile>> objects() const { return m_.map.slots(); }
  [[nodiscard]] std::optional<recon::MapPose> robot() const {
    if (m_.poses.empty()) return std::nullopt;
    return robot_pose(m_);
  }
  [[nodiscard]] std::span<const record::Signature> signatures() const { return m_.signatures.view(); }
  [[nodiscard]] record::AlertLevel alert_level(std::size_t slot) const { return m_.alerts[slot].level; }

 private:
  void choose(const config::Devices& devices) {
    m_.devices = devices;
    ++m_.choices;
  }
  // The camera's mounting belongs to the robot and stays, whichever camera it is.
  void use_delivered_calibration() {
    sensor::CameraIntrinsics camera = m_.devices.calibration();
    if (camera.width == 0) {
      m_.calibration = {};  // not known until $FPCAM comes
      return;
    }
    if (m_.calibration.known) camera.mount = m_.calibration.intrinsics.mount;
    set_camera(camera);
  }

  void advance(base::Time t) {
    if (!m_.run.time) {
      m_.run.sight.start(t);
      m_.run.watched_at = m_.run.status_at = m_.run.calibration_at = m_.run.beat_at = base::Stamp(t);
      m_.run.time = t;
    }
    m_.run.newest = t >= *m_.run.time;
    if (m_.run.newest) m_.run.time = t;
  }
  void advance_frame(base::Time t) {
    advance(t);
    m_.run.last_frame = t;
    m_.run.sight.frame_came(t);
  }

  [[nodiscard]] bool beat_due(base::Time t) const { return m_.run.beat_at.since(t) >= kHeartbeatInterval; }
  void beat(base::Time t) {
    m_.run.beat_at = base::Stamp(t);
    if (!reporter_.logs()) return;
    const record::Heartbeat beat = watch_.heartbeat(t);
    reporter_.report(beat);
    reporter_.report(watch_.speed_limit(beat));
  }

  void apply(const sensor::OdometrySample& sample) {
    advance(sample.t);
    m_.run.sight.odometry_came(sample);
    m_.poses.push(sample);
  }
  void apply(const sensor::BlobFrame& frame, std::uint8_t model) {
    advance_frame(frame.t);
    if (m_.waiting.full()) refuse_waiting();
    wait(frame, model);
  }
  // Not inlined: the frame that it makes then takes no stack from the functions called beside it.
  [[gnu::noinline]] void wait(const sensor::BlobFrame& frame, std::uint8_t model) {
    recon::WaitingFrame waiting = recon::make_waiting(frame, model);
    recon::take_off_pads(
        m_.calibration.models[model], [this](std::uint8_t signature) { return pad_of(signature); }, waiting);
    m_.waiting.push_over_oldest(waiting);
  }

  // True if this input may be used: in mode log only if its record is on its way.
  template <class Input>
  [[nodiscard]] bool loggable(const Input& input) {
    if (m_.run.testing) return false;
    const bool shown = m_.console.mode == console::Mode::kLog;
    if (!shown) m_.run.whole = false;  // a log that begins now does not hold the whole run
    if (reporter_.logs())
      return m_.run.calibration_sent && !(shown && reporter_.yields()) && reporter_.put_in_logs(input);
    m_.run.header_due = false;
    return true;
  }

  [[nodiscard]] std::uint8_t spare_model() const { return static_cast<std::uint8_t>(1 - m_.calibration.current); }
  [[nodiscard]] bool waits_with(std::uint8_t model) const {
    for (std::size_t i = 0; i < m_.waiting.size(); ++i) {
      if (m_.waiting[i].camera == model) return true;
    }
    return false;
  }

  void refuse(console::Refusal reason) { ++m_.counters.refused[static_cast<std::size_t>(reason)]; }
  void refuse_waiting(console::Refusal reason = console::Refusal::kNoPose) {
    if (!m_.run.testing) refuse(reason);
    // The robot's pose is not known; looming works without it.
    recon::WaitingFrame& frame = m_.waiting[0];
    m_.looming.look(frame, m_.calibration.models[frame.camera], nullptr);
    m_.waiting.pop_front();
  }

  void reconstruct(recon::WaitingFrame& frame, const recon::MapPose& pose) {
    const config::Settings& settings = in_use();
    const recon::Confirmation confirmation{settings.raw(config::Key::kConfirmK), settings.raw(config::Key::kConfirmN)};
    const std::int32_t correct = settings.raw(config::Key::kCorrectPose);
    recon::CorrectionOrder correction;
    const recon::CameraModel& camera = m_.calibration.models[frame.camera];
    correction.always = correct == config::kCorrectOn;
    // Needs ranges by rows, configured widths or bearings: unknown widths place landmarks too badly to judge odometry.
    const bool may_judge =
        correct == config::kCorrectAuto && (camera.pitch_known || widths_told() || m_.map.knows_bearings());
    if (correction.always || may_judge) correction.drift = 0.01F * settings.number(config::Key::kCorrectDrift);
    m_.map.add_frame(frame, camera, pose, noise_of(camera), confirmation, correction,
                     [this](std::uint8_t signature) { return width_of(signature); });
    if (m_.run.testing) return;
    if constexpr (Profile::kSeesFloor) m_.floor.look(frame, camera, pose);
    ++m_.counters.frames;
    m_.counters.blobs += static_cast<std::uint32_t>(frame.blobs.size());
  }

  // Says what a calibration drive still needs, each time that it needs less.
  [[gnu::noinline]] void guide_drive(const recon::WaitingFrame& frame, const recon::MapPose& pose) {
    unsigned known = 0;
    for (const recon::ObjectCore& object : m_.map.slots()) known += object.used() && object.confirmed ? 1U : 0U;
    console::DriveGuide& guide = m_.console.guide;
    const bool changed = guide.look(frame, m_.calibration.models[frame.camera], pose, known);
    if (!changed || m_.console.answer.pending()) return;
    guide.say();
    m_.console.answer = {console::Reply::kCalibrate};
  }

  // Boxes lie otherwise from now on: what was learned of the camera, of the floor and of what grows may be wrong.
  void forget_calibration() {
    if (m_.calibration.known) {
      m_.map.recalibrated();
      forget_floor();
    }
    m_.looming.clear();
    if (m_.camera_doubt.forget(m_.run.time.value_or(base::Time{}))) reporter_.camera_doubt();
  }

  void forget_floor() {
    if constexpr (Profile::kSeesFloor) m_.floor.clear();
  }

  // The noise of the camera's edges: by the setting, else by its number of columns.
  [[nodiscard]] recon::MeasurementNoise noise_of(const recon::CameraModel& camera) const {
    recon::MeasurementNoise noise = m_.noise;
    const config::Settings& settings = in_use();
    const bool told = settings.raw(config::Key::kCameraNoise) > 0;
    noise.edge_px = told ? settings.number(config::Key::kCameraNoise) : camera.edge_px;
    return noise;
  }

  // The width of things of this colour, mm; 0: not configured. The self-test is the same on every robot.
  [[nodiscard]] std::uint16_t width_of(std::uint8_t signature) const {
    const record::Signature* known = console::find_signature(signature, m_.signatures.view());
    return known != nullptr && !m_.run.testing ? known->width : std::uint16_t{0};
  }

  // Of boxes of this colour, px on each side; 0 in the self-test.
  [[nodiscard]] std::int8_t pad_of(std::uint8_t signature) const {
    const record::Signature* known = console::find_signature(signature, m_.signatures.view());
    return known != nullptr && !m_.run.testing ? known->pad : std::int8_t{0};
  }

  [[nodiscard]] bool widths_told() const {
    const auto told = [](const record::Signature& signature) { return signature.width > 0; };
    return !m_.run.testing && std::any_of(m_.signatures.begin(), m_.signatures.end(), told);
  }

  // The self-test is the same on every robot.
  [[nodiscard]] const config::Settings& in_use() const {
    static constexpr config::Settings kDelivered;
    return m_.run.testing ? kDelivered : m_.settings;
  }

  Memory<Profile>& m_;
  Reporter<Profile> reporter_;
  PathWatch<Profile> watch_{m_, reporter_};
};

}  // namespace fencepost::loop
