// The robot's loop with a log beside its console, one instance a profile, behind one interface.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "firmware/console/console_state.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/record/records.hpp"
#include "host/live/console_port.hpp"
#include "host/live/device.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host {

class LiveLoop {
 public:
  virtual ~LiveLoop() = default;

  /// Starts the first run with `robot`'s signatures and settings. Answers those that do not fit the profile, a sentence
  /// each.
  virtual std::vector<std::string> start(const record::Header& header,
                                         const std::optional<sensor::CameraIntrinsics>& intrinsics,
                                         const RobotFile& robot) = 0;
  /// One turn. True: there is more to do at once, without waiting for anything. After eleven days, before the stream's
  /// clock ends, a new run begins, with a new FPHDR and t from 0.
  virtual bool step(base::Time now) = 0;
  /// The stream has ended.
  virtual void finish() = 0;
  /// Hands waiting output to the console, as far as it takes it now.
  virtual void flush() = 0;

  /// The messages about links of the last iteration, a sentence each, whatever the console shows.
  [[nodiscard]] virtual const std::vector<std::string>& link_messages() const = 0;
  /// Something waits for room on the console.
  [[nodiscard]] virtual bool output_waits() const = 0;
  /// Whole lines of the log, in order; the caller takes all of them.
  [[nodiscard]] virtual std::span<const char> journal() const = 0;
  virtual void journal_taken(std::size_t size) = 0;
  /// The longest turn so far, for FPSTA.
  virtual void note_turn(std::uint32_t microseconds) = 0;

  /// The state in force now.
  [[nodiscard]] virtual record::Heartbeat in_force() const = 0;
  /// How fast the robot may be while that is in force.
  [[nodiscard]] virtual record::SpeedLimit speed_limit(const record::Heartbeat& beat) const = 0;
  /// Somebody typed `stop`, and not `go` since.
  [[nodiscard]] virtual bool held() const = 0;
  [[nodiscard]] virtual const console::Counters& counters() const = 0;
  [[nodiscard]] virtual std::uint64_t digest() const = 0;
  /// FPFRM records in the log so far.
  [[nodiscard]] virtual std::uint64_t frames_logged() const = 0;
};

/// `console` is borrowed, as are the devices. nullptr for an unknown profile name.
std::unique_ptr<LiveLoop> make_live_loop(std::string_view profile, CameraDevice& camera, OdometryDevice& odometry,
                                         PatientConsole& console, console::Mode mode);

/// The names that make_live_loop knows.
inline constexpr std::string_view kLiveProfiles = "micro, small, full";

}  // namespace fencepost::host
