// One robot: a board, its cameras and odometries, the loop and all memory. There is one of it, and nothing else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "firmware/config/about_image.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/image/boot.hpp"
#include "firmware/image/keeper.hpp"
#include "firmware/image/unsaid.hpp"
#include "firmware/loop/bumper.hpp"
#include "firmware/loop/button.hpp"
#include "firmware/loop/loop.hpp"
#include "firmware/loop/motion_permit.hpp"
#include "firmware/loop/throttle.hpp"
#include FENCEPOST_BOARD
#include FENCEPOST_DEVICES
#include FENCEPOST_PANEL

namespace fencepost::image {

using Profile = config::FENCEPOST_PROFILE;
using Console = std::remove_reference_t<decltype(board::console())>;

// Of this file alone: the boards of one part give their name when the program begins, and inline that would be guarded.
// NOLINTNEXTLINE(cert-err58-cpp): nothing in there throws
const record::Header kHeader = {record::kStreamFormat, kProduct, FENCEPOST_VERSION, board::kTarget, Profile::kName};

/// The devices with which this image begins.
constexpr config::Devices initial_devices() {
  constexpr config::CameraId kCamera = config::camera_named(FENCEPOST_CAMERA);
  constexpr config::OdometryId kOdometry = config::odometry_named(FENCEPOST_ODOMETRY);
  config::Devices devices(kCamera, kOdometry);
#ifdef FENCEPOST_WHEELS
  constexpr std::array<double, 3> kWheels = {FENCEPOST_WHEELS};
  constexpr auto kTenths = [](double value) {
    return static_cast<std::int32_t>(value * 10 + (value < 0 ? -0.5 : 0.5));
  };
  devices.put(config::DeviceKey::kWheelDiameter, kTenths(kWheels[0]));
  devices.put(config::DeviceKey::kWheelCounts, kTenths(kWheels[1]));
  devices.put(config::DeviceKey::kWheelTrack, kTenths(kWheels[2]));
#endif
  devices.put(config::DeviceKey::kDrive, FENCEPOST_DRIVE);
  return devices;
}
inline constexpr config::DeviceLimits kLimits = {Camera::kContained,    Odometry::kContained, board::kOneLine,
                                                 board::kLowestAddress, board::kMotors,       initial_devices()};
static_assert(refusal(kLimits.initial, kLimits) == config::Refusal::kNone,
              "FENCEPOST_CAMERA and FENCEPOST_ODOMETRY: the image does not have them, or not together (Refusal)");
/// Read in the image's file, not by the image.
[[gnu::used, gnu::section(".about")]] inline constexpr config::AboutImage kAbout =
    config::about_image(FENCEPOST_VERSION, Profile::kSignatures, kLimits);
// NOLINTNEXTLINE(cert-err58-cpp): nothing in there throws
const config::DeviceOffer kOffer = {kLimits, board::kPinNames};

/// The board's flash. The loop stops while a page is erased, so the motors are stopped first.
// NOLINTBEGIN(readability-static-accessed-through-instance): only of the template board
struct FlashAtRest {
  [[nodiscard]] static std::size_t size() { return board::flash().size(); }
  [[nodiscard]] static std::span<const std::uint8_t> page(std::size_t n) { return board::flash().page(n); }
  static bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
    return !board::supply_low() && board::flash().program(n, offset, bytes);
  }
  static bool erase(std::size_t n) {
    board::allow_motion(false);
    return !board::supply_low() && board::flash().erase(n);
  }
};
// NOLINTEND(readability-static-accessed-through-instance)
static_assert(bus::FlashPages<FlashAtRest>);

class Robot {
 public:
  Robot()
      : loop_(memory_, camera_, odometry_, board::console(), console::Mode::kText),
        keeper_(pipeline(), flash_),
        panel_(pipeline()) {}

  // Not inlined: what it needs of the stack is free again when the loop turns.
  [[gnu::noinline]] void start() {
    board::start(FENCEPOST_CONSOLE_BAUD);
    pipeline().start_run(kHeader);
    loop_.set_note(FENCEPOST_NOTE);
    pipeline().offer(kOffer);
    keeper_.restore();
    open_devices();
    // NOLINTNEXTLINE(readability-static-accessed-through-instance): only where there is no panel
    panel_.start();
    facts_.reason = board::take_reset_reason();
    facts_.panic = board::take_panic();
    say_facts(kBootLines);
  }

  void turn() {
    work();
    board::idle();
  }

 private:
  // Not inlined: its instructions are counted by that name.
  [[gnu::noinline]] void work() {
    const std::uint32_t began = board::clock().microseconds();
    loop_.step(board::clock().now());
    if (memory_.choices != opened_) open_devices();
    follow_alert(board::clock().now());
    if (opened(board::console())) say_facts(kBootLines - 1);  // it is ready, and was
    if (++turns_ % kKeepEvery == 0 && !keeper_.keep())
      pipeline().reporter().say([](std::span<char> room) { return not_kept(room); });
    // NOLINTNEXTLINE(readability-static-accessed-through-instance): only where there is no panel
    panel_.turn(loop_.links());
    const std::uint32_t took = board::clock().microseconds() - began;
    std::uint32_t& longest = memory_.counters.loop_us_max;
    longest = took > longest ? took : longest;
    board::feed_watchdog();  // a turn that did not come to its end does not
  }

  // The motors are released only while the robot may drive.
  void follow_alert(base::Time now) {
    if (judged_.since(now) < kJudgeEvery) return;
    judged_ = base::Stamp(now);
    const record::Heartbeat beat = pipeline().in_force();
    console::Motion& motion = memory_.console.motion;
    motion.may = permit_.judge(beat, loop_.links(), now);
    if (board::kMotors && button_.pressed(board::button_held(), now)) loop_.press_button();
    const bool may_move = !supply_low() && motion.may && !motion.held;
    board::allow_motion(may_move);
    const record::SpeedLimit limit = pipeline().speed_limit(beat);
    odometry_.allow_motion(drive_.judge(may_move, beat.level, limit));
    if constexpr (board::kMotors) drive_ahead(may_move, loop::most_of(limit), now);
  }
  bool supply_low() {
    const bool low = board::supply_low();
    if (low && !supply_was_low_) pipeline().reporter().say([](std::span<char> room) { return charge(room); });
    supply_was_low_ = low;
    return low;
  }
  // Once the motors stop, they wait for the next `go`.
  void drive_ahead(bool may_move, std::int16_t most, base::Time now) {
    std::optional<recon::MapPose> odometry;
    if (!memory_.poses.empty()) odometry = memory_.poses.latest();
    console::Motion& motion = memory_.console.motion;
    if (gone(board::console()) && !motion.by_button) {
      motion.ahead = false;
      bumper_.stand(loop::Standstill::kPort);
    }
    bool& ahead = motion.ahead;
    ahead = bumper_.judge(ahead, may_move && most > 0, odometry, now);
    const std::int32_t wanted = ahead ? memory_.devices.raw(config::DeviceKey::kBumper) : 0;
    board::drive_motors(throttle_.judge(wanted, most, memory_.poses.motion(loop::kMotionSpan).forward, now));
    if (const auto why = bumper_.take_standstill()) {
      pipeline().reporter().say([&](std::span<char> room) {
        return console::Sentence(room).put("the motors stand: ").put(loop::reason(*why)).end();
      });
    }
  }

  [[nodiscard]] Opening opening() const { return {memory_.devices, memory_.counters, memory_.signatures.view()}; }
  // All of them: a camera's line may be the base's.
  [[gnu::noinline]] void open_devices() {
    board::allow_motion(false);
    opened_ = memory_.choices;
    odometry_.open(opening(), board::clock().now());
    camera_.open(opening());
  }

  void say_facts(std::size_t lines) {
    for (std::size_t n = 0; n < lines; ++n) {
      pipeline().reporter().say([&](std::span<char> room) { return write_boot_line(n, facts_, room); });
    }
  }
  /// True if a user has opened the console since the boot report.
  template <class Link>
  static bool opened([[maybe_unused]] Link& link) {
    if constexpr (requires { link.take_opened(); }) return link.take_opened();
    return false;
  }

  /// True if the port was closed: its user can stop nothing any more.
  template <class Link>
  static bool gone([[maybe_unused]] Link& link) {
    if constexpr (requires { link.take_gone(); }) return link.take_gone();
    return false;
  }

  /// Turns between two checks for changed settings, which compare some hundred bytes; the loop turns at least a
  /// thousand times a second.
  static constexpr std::uint8_t kKeepEvery = 16;

  /// A stop reaches the pin within this and a turn.
  static constexpr base::Duration kJudgeEvery = base::milliseconds(5);

  static std::size_t not_kept(std::span<char> room) {
    return console::Sentence(room).put("error: the change holds until the next reset: it could not be written").end();
  }
  static std::size_t charge(std::span<char> room) {
    return console::Sentence(room).put("error: the supply is too low: nothing moves, nothing is kept; charge it").end();
  }
  loop::Pipeline<Profile>& pipeline() { return loop_.pipeline(); }

  BootFacts facts_{FENCEPOST_VERSION, board::kTarget, Profile::kName, mcu::ResetReason::kUnknown, std::nullopt};
  loop::Memory<Profile> memory_;
  Camera camera_{opening()};
  Odometry odometry_{opening()};
  loop::Loop<Profile, Camera, Odometry, Console> loop_;
  FlashAtRest flash_;
  Keeper<Profile, FlashAtRest> keeper_;
  Panel<Profile> panel_;
  loop::MotionPermit permit_;
  loop::DrivePermit drive_;
  loop::Bumper bumper_;
  loop::Button button_;
  loop::Throttle throttle_;
  base::Stamp judged_;
  std::uint8_t turns_ = 0;
  std::uint8_t opened_ = 0;  ///< which of the choices
  bool supply_was_low_ = false;
};

}  // namespace fencepost::image
