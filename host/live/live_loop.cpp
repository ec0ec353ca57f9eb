#include "host/live/live_loop.hpp"

#include <algorithm>

#include "firmware/app/loop.hpp"

namespace fencepost::host {
namespace {

/// The profile of a robot, with a journal: some hundred turns' worth of lines, and each turn empties it.
template <class Base>
struct Journaled : Base {
  static constexpr std::size_t kJournalBytes = 256 * 1024;
};

template <class Base>
class ProfileLoop final : public LiveLoop {
 public:
  using Profile = Journaled<Base>;

  ProfileLoop(CameraDevice& camera, OdometryDevice& odometry, PatientConsole& console, app::Mode mode)
      : console_(console), loop_(*memory_, camera, odometry, console, mode, app::canned_stream<Profile>()) {
    memory_->journal.start();
  }

  std::vector<std::string> start(const record::Header& header,
                                 const std::optional<sensor::CameraIntrinsics>& intrinsics,
                                 const RobotFile& robot) override {
    header_ = header;
    header_.profile = Profile::kName;
    app::Pipeline<Profile>& pipeline = loop_.pipeline();
    pipeline.start_run(header_);
    if (intrinsics) pipeline.set_camera(*intrinsics);
    std::vector<std::string> complaints;
    for (const record::Signature& signature : robot.signatures) {
      if (pipeline.set_signature(signature)) continue;
      complaints.push_back("signature " + std::to_string(signature.signature) + ": profile " +
                           std::string(Profile::kName) + " names only " + std::to_string(Profile::kSignatures));
    }
    for (const auto& [key, value] : robot.settings) static_cast<void>(pipeline.set(key, value));
    return complaints;
  }

  bool step(base::Time now) override {
    const std::uint64_t before = inputs();
    loop_.step(now);
    if (inputs() != before) return true;
    app::ConsoleState& console = memory_->console;
    return !output_waits() && (console.answer.pending() || loop_.pipeline().testing() || console.input.front());
  }
  void finish() override { loop_.pipeline().finish(); }
  void flush() override {
    const base::Result<std::size_t> taken = console_.write(app::as_octets(memory_->output.waiting()));
    if (taken) memory_->output.taken(*taken);
  }

  void tell(const record::LinkReport& report, std::string_view sentence) override {
    app::Telling<Profile>& telling = loop_.pipeline().telling();
    telling.report(report);
    if (sentence.empty() || !telling.shown_in(app::Mode::kText)) return;
    telling.say([sentence](std::span<char> room) -> std::size_t {
      if (room.size() < sentence.size() + 2) return 0;
      const auto end = std::copy(sentence.begin(), sentence.end(), room.begin());
      std::copy_n("\r\n", 2, end);
      return sentence.size() + 2;
    });
  }
  [[nodiscard]] bool output_waits() const override { return !memory_->output.waiting().empty(); }
  [[nodiscard]] std::span<const char> journal() const override { return memory_->journal.waiting(); }
  void journal_taken(std::size_t size) override { memory_->journal.taken(size); }
  void note_turn(std::uint32_t microseconds) override {
    memory_->counters.loop_us_max = std::max(memory_->counters.loop_us_max, microseconds);
  }

  [[nodiscard]] const app::Counters& counters() const override { return memory_->counters; }
  [[nodiscard]] std::uint64_t digest() const override { return memory_->map.digest(); }
  [[nodiscard]] std::uint64_t frames_logged() const override {
    const auto& refused = memory_->counters.refused;
    const auto of = [&](app::Refusal reason) { return std::uint64_t{refused[static_cast<std::size_t>(reason)]}; };
    return memory_->counters.frames + memory_->waiting.size() + of(app::Refusal::kNoPose) +
           of(app::Refusal::kOdometryGap) + of(app::Refusal::kNoCamera);
  }

 private:
  /// Grows with each input, used or not.
  [[nodiscard]] std::uint64_t inputs() const {
    const app::Counters& counters = memory_->counters;
    return frames_logged() + counters.odometry + counters.rejected +
           counters.refused[static_cast<std::size_t>(app::Refusal::kQueue)];
  }

  std::unique_ptr<app::Memory<Profile>> memory_ = std::make_unique<app::Memory<Profile>>();
  record::Header header_;
  PatientConsole& console_;
  app::Loop<Profile, CameraDevice, OdometryDevice, PatientConsole> loop_;
};

template <class Base, class... Arguments>
std::unique_ptr<LiveLoop> make(Arguments&&... arguments) {
  return std::make_unique<ProfileLoop<Base>>(std::forward<Arguments>(arguments)...);
}

}  // namespace

std::unique_ptr<LiveLoop> make_live_loop(std::string_view profile, CameraDevice& camera, OdometryDevice& odometry,
                                         PatientConsole& console, app::Mode mode) {
  if (profile == config::Micro::kName) return make<config::Micro>(camera, odometry, console, mode);
  if (profile == config::Small::kName) return make<config::Small>(camera, odometry, console, mode);
  if (profile == config::Full::kName) return make<config::Full>(camera, odometry, console, mode);
  return nullptr;
}

}  // namespace fencepost::host
