// StormRobot of one profile, put together as firmware/image/robot.hpp does it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "firmware/image/boot.hpp"
#include "firmware/image/keeper.hpp"
#include "firmware/loop/loop.hpp"
#include "firmware/loop/motion_permit.hpp"
#include "tests/studies/storm/robot.hpp"

namespace fencepost::test {

/// Base with the buffers of a variant.
template <class Base, std::size_t kVariant>
struct StormProfile : Base {
  static constexpr std::size_t kOutputBytes = kVariants[kVariant].output;
  static constexpr std::size_t kJournalBytes = kVariants[kVariant].journal;
};

/// Asks the device, and remembers the answer.
template <class Device, class Sample>
class Watched {
 public:
  Watched(Device& device, std::optional<Sample>& given) : device_(device), given_(given) {}

  base::Result<Sample> poll(base::Time now) {
    const base::Result<Sample> sample = device_.poll(now);
    given_ = sample ? std::optional(*sample) : std::nullopt;
    return sample;
  }
  [[nodiscard]] sensor::LinkState link() const { return device_.link(); }
  [[nodiscard]] host::LinkWording link_words(sensor::LinkState state) const { return device_.link_words(state); }
  [[nodiscard]] bool stamped_here() const { return device_.cabled(); }
  [[nodiscard]] std::uint32_t dropped() const requires requires(const Device& device) { device.dropped(); }
  { return device_.dropped(); }

 private:
  Device& device_;
  std::optional<Sample>& given_;
};

template <class Profile>
class ProfileRobot final : public StormRobot {
 public:
  ProfileRobot(const RobotParts& parts, console::Mode mode)
      : camera_(parts.camera, given_.frame),
        odometry_(parts.odometry, given_.odometry),
        loop_(guarded_->memory, camera_, odometry_, parts.console, mode),
        keeper_(loop_.pipeline(), parts.flash) {
    guarded_->before.fill(kGuard);
    guarded_->after.fill(kGuard);
    if constexpr (Profile::kJournalBytes > 0) memory().journal.start();
  }

  void start(const sensor::CameraIntrinsics& delivered) override {
    loop_.pipeline().start_run(header_);
    loop_.pipeline().set_camera(delivered);
    keeper_.restore();
    const image::BootFacts facts{"storm", "desk", Profile::kName, mcu::ResetReason::kPowerOn, std::nullopt};
    for (std::size_t n = 0; n < image::kBootLines; ++n) {
      loop_.pipeline().reporter().say([&](std::span<char> room) { return image::write_boot_line(n, facts, room); });
    }
  }
  void tell(const Kept& configured) override {
    loop_.pipeline().set_camera(configured.camera);
    for (const record::Signature& signature : configured.signatures) {
      static_cast<void>(loop_.pipeline().set_signature(signature));
    }
    for (std::size_t i = 0; i < config::kKeys; ++i) {
      const auto key = static_cast<config::Key>(i);
      static_cast<void>(loop_.pipeline().set(config::info(key).name, configured.settings.text(key).view()));
    }
  }
  void turn(base::Time now) override {
    given_ = {};
    loop_.step(now);
    follow_alert(now);
    if (++turns_ % kKeepEvery == 0) static_cast<void>(keeper_.keep());
  }
  [[nodiscard]] bool looked() const override { return turns_ % kKeepEvery == 0; }

  [[nodiscard]] const Given& given() const override { return given_; }
  [[nodiscard]] record::Heartbeat in_force() const override { return loop_.pipeline().in_force(); }
  [[nodiscard]] console::Links links() const override { return loop_.links(); }
  [[nodiscard]] std::optional<sensor::LinkState> reported_camera() const override {
    return memory().links.camera.last_sent();
  }
  [[nodiscard]] std::optional<sensor::LinkState> reported_odometry() const override {
    return memory().links.odometry.last_sent();
  }
  [[nodiscard]] bool may_drive() const override { return may_drive_; }
  [[nodiscard]] const console::Counters& counters() const override { return memory().counters; }
  [[nodiscard]] std::uint64_t digest() const override { return memory().map.digest(); }
  [[nodiscard]] std::uint32_t frames_of_run() const override { return memory().map.frames(); }
  [[nodiscard]] std::optional<base::Time> stream_time() const override { return memory().run.time; }
  [[nodiscard]] bool testing() const override { return loop_.pipeline().testing(); }
  [[nodiscard]] bool idle() const override {
    const loop::Memory<Profile>& m = memory();
    return !testing() && !m.console.answer.pending() && m.output.waiting().empty() && m.run.calibration_sent;
  }
  [[nodiscard]] Kept kept() const override {
    const loop::Memory<Profile>& m = memory();
    return {m.settings, m.calibration.intrinsics, {m.signatures.begin(), m.signatures.end()}};
  }
  [[nodiscard]] const config::Settings& settings() const override { return memory().settings; }
  [[nodiscard]] const sensor::CameraIntrinsics& camera() const override { return memory().calibration.intrinsics; }
  [[nodiscard]] bool alerts_are_said() const override { return memory().console.alerts; }
  [[nodiscard]] bool guarded() const override {
    const auto right = [](std::uint64_t word) { return word == kGuard; };
    return std::all_of(guarded_->before.begin(), guarded_->before.end(), right) &&
           std::all_of(guarded_->after.begin(), guarded_->after.end(), right);
  }
  void break_guard() override { guarded_->after[0] ^= 1; }
  [[nodiscard]] std::span<const char> journal() const override {
    if constexpr (Profile::kJournalBytes > 0) return memory().journal.waiting();
    return {};
  }
  void journal_taken(std::size_t size) override {
    if constexpr (Profile::kJournalBytes > 0) memory().journal.taken(size);
  }

 private:
  static constexpr std::uint64_t kGuard = 0xFE5CE9057DEADBE5ULL;
  static constexpr std::uint8_t kKeepEvery = 16;  // as the image has them
  static constexpr base::Duration kJudgeEvery = base::milliseconds(5);

  struct Guarded {
    std::array<std::uint64_t, 64> before{};
    loop::Memory<Profile> memory;
    std::array<std::uint64_t, 64> after{};
  };

  void follow_alert(base::Time now) {
    // An image's clock begins at zero, this one anywhere.
    if (judged_ && judged_->since(now) < kJudgeEvery) return;
    judged_ = base::Stamp(now);
    may_drive_ = permit_.judge(in_force(), links(), now) && !memory().console.motion.held;
  }
  [[nodiscard]] loop::Memory<Profile>& memory() { return guarded_->memory; }
  [[nodiscard]] const loop::Memory<Profile>& memory() const { return guarded_->memory; }

  using Camera = Watched<host::CameraDevice, sensor::BlobFrame>;
  using Odometry = Watched<host::OdometryDevice, sensor::OdometrySample>;

  Given given_;
  std::unique_ptr<Guarded> guarded_ = std::make_unique<Guarded>();
  record::Header header_{record::kStreamFormat, "fencepost", "storm", "desk", Profile::kName};
  Camera camera_;
  Odometry odometry_;
  loop::Loop<Profile, Camera, Odometry, host::PatientConsole> loop_;
  image::Keeper<Profile, StormFlash> keeper_;
  loop::MotionPermit permit_;
  std::optional<base::Stamp> judged_;
  bool may_drive_ = false;
  std::uint8_t turns_ = 0;
};

template <class Base, std::size_t kVariant>
std::unique_ptr<StormRobot> make_variant(const RobotParts& parts, console::Mode mode) {
  return std::make_unique<ProfileRobot<StormProfile<Base, kVariant>>>(parts, mode);
}

}  // namespace fencepost::test
