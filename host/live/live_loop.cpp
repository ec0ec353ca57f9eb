#include "host/live/live_loop.hpp"

#include <algorithm>

#include "firmware/loop/loop.hpp"
#include "host/scene/pitch_note.hpp"

namespace fencepost::host {
namespace {

/// Lines of some hundred iterations, and each one empties it.
constexpr std::size_t kJournalBytes = 256 * 1024;

/// The record stream's clock ends at 999,999 s, eleven days; a run that would reach it ends before.
constexpr base::Duration kLongestRun = base::milliseconds(999'000'000);

/// The devices' clock continues where the run's restarts.
class ShiftedCamera {
 public:
  ShiftedCamera(CameraDevice& camera, const base::Duration& shift) : camera_(camera), shift_(shift) {}
  base::Result<sensor::BlobFrame> poll(base::Time now) {
    const base::Result<sensor::BlobFrame> seen = camera_.poll(now + shift_);
    if (!seen) return seen;
    sensor::BlobFrame frame = *seen;
    frame.t = frame.t - shift_;
    return frame;
  }
  [[nodiscard]] sensor::LinkState link() const { return camera_.link(); }
  [[nodiscard]] LinkWording link_words(sensor::LinkState state) const { return camera_.link_words(state); }
  [[nodiscard]] std::uint32_t dropped() const { return camera_.dropped(); }
  [[nodiscard]] bool stamped_here() const { return camera_.cabled(); }

 private:
  CameraDevice& camera_;
  const base::Duration& shift_;
};

class ShiftedOdometry {
 public:
  ShiftedOdometry(OdometryDevice& odometry, const base::Duration& shift) : odometry_(odometry), shift_(shift) {}
  base::Result<sensor::OdometrySample> poll(base::Time now) {
    const base::Result<sensor::OdometrySample> told = odometry_.poll(now + shift_);
    if (!told) return told;
    sensor::OdometrySample sample = *told;
    sample.t = sample.t - shift_;
    return sample;
  }
  [[nodiscard]] sensor::LinkState link() const { return odometry_.link(); }
  [[nodiscard]] LinkWording link_words(sensor::LinkState state) const { return odometry_.link_words(state); }
  [[nodiscard]] bool stamped_here() const { return odometry_.cabled(); }

 private:
  OdometryDevice& odometry_;
  const base::Duration& shift_;
};

template <class Base>
class ProfileLoop final : public LiveLoop {
 public:
  using Profile = loop::Journaled<Base, kJournalBytes>;

  ProfileLoop(CameraDevice& camera, OdometryDevice& odometry, PatientConsole& console, console::Mode mode)
      : camera_device_(camera),
        odometry_device_(odometry),
        console_(console),
        camera_(camera, shift_),
        odometry_(odometry, shift_),
        loop_(*memory_, camera_, odometry_, console, mode, loop::canned_stream<Profile>()) {
    memory_->journal.start();
  }

  std::vector<std::string> start(const record::Header& header,
                                 const std::optional<sensor::CameraIntrinsics>& intrinsics,
                                 const RobotFile& robot) override {
    header_ = header;
    header_.profile = Profile::kName;
    loop::Pipeline<Profile>& pipeline = loop_.pipeline();
    pipeline.start_run(header_);
    std::vector<std::string> complaints;
    if (intrinsics) {
      pipeline.set_camera(*intrinsics);
      if (const std::optional<std::string> note = pitch_note(intrinsics->mount)) complaints.push_back(*note);
    }
    for (const record::Signature& signature : robot.signatures) {
      if (pipeline.set_signature(signature)) continue;
      complaints.push_back("signature " + std::to_string(signature.signature) + ": profile " +
                           std::string(Profile::kName) + " names only " + std::to_string(Profile::kSignatures));
    }
    for (const auto& [key, value] : robot.settings) static_cast<void>(pipeline.set(key, value));
    return complaints;
  }

  bool step(base::Time now) override {
    if (now - shift_ >= base::Time{} + kLongestRun) begin_anew(now);
    const std::uint64_t before = inputs();
    step_and_watch(now);
    if (inputs() != before) return true;
    console::ConsoleState& console = memory_->console;
    return !output_waits() && (console.answer.pending() || loop_.pipeline().testing() || console.input.front());
  }
  void finish() override { loop_.pipeline().finish(); }
  void flush() override {
    const base::Result<std::size_t> taken = console_.write(loop::as_octets(memory_->output.waiting()));
    if (taken) memory_->output.taken(*taken);
  }

  [[nodiscard]] const std::vector<std::string>& link_messages() const override { return link_messages_; }
  [[nodiscard]] bool output_waits() const override { return !memory_->output.waiting().empty(); }
  [[nodiscard]] std::span<const char> journal() const override { return memory_->journal.waiting(); }
  void journal_taken(std::size_t size) override { memory_->journal.taken(size); }
  void note_turn(std::uint32_t microseconds) override {
    memory_->counters.loop_us_max = std::max(memory_->counters.loop_us_max, microseconds);
  }

  [[nodiscard]] record::Heartbeat in_force() const override { return loop_.pipeline().in_force(); }
  [[nodiscard]] record::SpeedLimit speed_limit(const record::Heartbeat& beat) const override {
    return loop_.pipeline().speed_limit(beat);
  }
  [[nodiscard]] bool held() const override { return loop_.pipeline().memory().console.motion.held; }
  [[nodiscard]] const console::Counters& counters() const override { return memory_->counters; }
  [[nodiscard]] std::uint64_t digest() const override { return memory_->map.digest(); }
  [[nodiscard]] std::uint64_t frames_logged() const override {
    const auto& refused = memory_->counters.refused;
    const auto of = [&](console::Refusal reason) { return std::uint64_t{refused[static_cast<std::size_t>(reason)]}; };
    return memory_->counters.frames + memory_->waiting.size() + of(console::Refusal::kNoPose) +
           of(console::Refusal::kOdometryGap) + of(console::Refusal::kNoCamera);
  }

 private:
  void begin_anew(base::Time now) {
    loop_.pipeline().restart();
    shift_ = now - base::Time{};
  }

  /// Grows with each input, used or not.
  [[nodiscard]] std::uint64_t inputs() const {
    const console::Counters& counters = memory_->counters;
    return frames_logged() + counters.odometry + counters.rejected +
           counters.refused[static_cast<std::size_t>(console::Refusal::kQueue)];
  }

  void step_and_watch(base::Time now) {
    loop_.step(now - shift_);
    link_messages_.clear();
    note_change(camera_device_, memory_->links.camera, camera_known_, true);
    note_change(odometry_device_, memory_->links.odometry, odometry_known_, loop_.odometry().in_range());
  }
  // A new run logs the present link states again; those are no changes.
  void note_change(const Device& device, const loop::LinkWatch& watch, std::optional<sensor::LinkState>& known,
                   bool in_range) {
    if (!device.cabled() || !watch.last_sent() || watch.last_sent() == known) return;
    known = watch.last_sent();
    const sensor::LinkState state = *known;
    LinkWording words = device.wording(state);
    if (!in_range && state == sensor::LinkState::kUnready) loop::explain_range(words);
    std::array<char, record::kMaxLine> line{};
    const std::size_t size = console::describe_link(state, words.name, words.remedy, line);
    if (size > 2) link_messages_.emplace_back(line.data(), size - 2);
  }

  std::unique_ptr<loop::Memory<Profile>> memory_ = std::make_unique<loop::Memory<Profile>>();
  record::Header header_;
  std::vector<std::string> link_messages_;
  std::optional<sensor::LinkState> camera_known_;
  std::optional<sensor::LinkState> odometry_known_;
  CameraDevice& camera_device_;
  OdometryDevice& odometry_device_;
  PatientConsole& console_;
  base::Duration shift_;  ///< of the run's zero from the devices'
  ShiftedCamera camera_;
  ShiftedOdometry odometry_;
  loop::Loop<Profile, ShiftedCamera, ShiftedOdometry, PatientConsole> loop_;
};

template <class Base, class... Arguments>
std::unique_ptr<LiveLoop> make(Arguments&&... arguments) {
  return std::make_unique<ProfileLoop<Base>>(std::forward<Arguments>(arguments)...);
}

}  // namespace

std::unique_ptr<LiveLoop> make_live_loop(std::string_view profile, CameraDevice& camera, OdometryDevice& odometry,
                                         PatientConsole& console, console::Mode mode) {
  if (profile == config::Micro::kName) return make<config::Micro>(camera, odometry, console, mode);
  if (profile == config::Small::kName) return make<config::Small>(camera, odometry, console, mode);
  if (profile == config::Full::kName) return make<config::Full>(camera, odometry, console, mode);
  return nullptr;
}

}  // namespace fencepost::host
