// One robot: the loop with its own memory, its settings in flash, its STOP output; nothing of it is a model.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/config/settings.hpp"
#include "firmware/console/console_state.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/console/links.hpp"
#include "firmware/record/records.hpp"
#include "hal/fake/cut_flash.hpp"
#include "host/live/console_port.hpp"
#include "host/live/device.hpp"

namespace fencepost::test {

using StormFlash = fake::CutFlash<4096>;

/// The inputs of one turn of the loop.
struct Given {
  std::optional<sensor::OdometrySample> odometry;
  std::optional<sensor::BlobFrame> frame;
};

/// The configuration that a robot keeps.
struct Kept {
  config::Settings settings;
  sensor::CameraIntrinsics camera;
  std::vector<record::Signature> signatures;
  friend bool operator==(const Kept&, const Kept&) = default;
};

/// Borrowed by the robot.
struct RobotParts {
  host::CameraDevice& camera;
  host::OdometryDevice& odometry;
  host::PatientConsole& console;
  StormFlash& flash;
};

class StormRobot {
 public:
  virtual ~StormRobot() = default;

  /// Switches it on: the configuration in flash comes into force, over the camera that it is delivered with.
  virtual void start(const sensor::CameraIntrinsics& delivered) = 0;
  /// Somebody configures it once; that goes to flash with the next turns.
  virtual void tell(const Kept& configured) = 0;
  virtual void turn(base::Time now) = 0;
  /// In this turn it looked for a new configuration, and wrote it to flash.
  [[nodiscard]] virtual bool looked() const = 0;

  [[nodiscard]] virtual const Given& given() const = 0;
  [[nodiscard]] virtual record::Heartbeat in_force() const = 0;
  [[nodiscard]] virtual console::Links links() const = 0;
  /// As they were last reported.
  [[nodiscard]] virtual std::optional<sensor::LinkState> reported_camera() const = 0;
  [[nodiscard]] virtual std::optional<sensor::LinkState> reported_odometry() const = 0;
  [[nodiscard]] virtual bool may_drive() const = 0;  ///< the STOP output
  [[nodiscard]] virtual const console::Counters& counters() const = 0;
  [[nodiscard]] virtual std::uint64_t digest() const = 0;
  [[nodiscard]] virtual std::uint32_t frames_of_run() const = 0;
  [[nodiscard]] virtual std::optional<base::Time> stream_time() const = 0;
  [[nodiscard]] virtual bool testing() const = 0;
  /// Nothing waits: no answer, no input, no output.
  [[nodiscard]] virtual bool idle() const = 0;
  [[nodiscard]] virtual Kept kept() const = 0;
  [[nodiscard]] virtual const config::Settings& settings() const = 0;
  [[nodiscard]] virtual const sensor::CameraIntrinsics& camera() const = 0;
  [[nodiscard]] virtual bool alerts_are_said() const = 0;
  /// The words around its memory are as they were.
  [[nodiscard]] virtual bool guarded() const = 0;
  virtual void break_guard() = 0;
  /// Lines of the log beside the console.
  [[nodiscard]] virtual std::span<const char> journal() const = 0;
  virtual void journal_taken(std::size_t size) = 0;
};

/// Profile, bytes of the output queue and of the journal.
struct Variant {
  std::string_view profile;
  std::size_t output = 0;
  std::size_t journal = 0;  ///< 0: the console is the log
};
inline constexpr Variant kVariants[] = {{"micro", 1024, 0}, {"micro", 2048, 4096}, {"micro", 1024, 256 * 1024},
                                        {"small", 4096, 0}, {"small", 1024, 0},    {"small", 4096, 256 * 1024},
                                        {"full", 16384, 0}, {"full", 1024, 0},     {"full", 16384, 256 * 1024}};

/// `variant`: of kVariants.
std::unique_ptr<StormRobot> make_robot(std::size_t variant, const RobotParts& parts, console::Mode mode);
std::unique_ptr<StormRobot> make_micro(std::size_t variant, const RobotParts& parts, console::Mode mode);
std::unique_ptr<StormRobot> make_small(std::size_t variant, const RobotParts& parts, console::Mode mode);
std::unique_ptr<StormRobot> make_full(std::size_t variant, const RobotParts& parts, console::Mode mode);

}  // namespace fencepost::test
