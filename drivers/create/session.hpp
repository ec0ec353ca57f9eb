// The protocol state machine of an iRobot Create 1, Create 2 or Roomba 600: start, stream, pose.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/create/requested_motion.hpp"
#include "drivers/create/stream_decoder.hpp"
#include "drivers/odometry/differential_drive.hpp"
#include "drivers/serial/outbox.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::create {

enum class Model : std::uint8_t {
  kCreate1,  ///< packets 41, 42: requested wheel speeds; 19, 20 now and then (requested_motion.hpp)
  kCreate2,  ///< packets 43, 44: encoder counts; Roomba 600 too
};

/// The robot's operating mode. Passive is enough to read; driving needs one of the others.
enum class Mode : std::uint8_t { kPassive, kSafe, kFull };

/// Arguments of the command Drive; the robot clips both.
struct Motion {
  static constexpr std::int16_t kStraight = 0x7FFF;
  static constexpr std::int16_t kOnTheSpotLeft = 1;
  static constexpr std::int16_t kOnTheSpotRight = -1;

  std::int16_t velocity_mm_s = 0;      ///< of the robot's middle, -500 to 500
  std::int16_t radius_mm = kStraight;  ///< of the circle, -2000 to 2000, positive to the left; or one of the above
  friend constexpr bool operator==(const Motion&, const Motion&) = default;
};

struct Config {
  Model model = Model::kCreate2;
  Mode mode = Mode::kPassive;
  odometry::WheelBase wheels = odometry::kCreate2Wheels;  ///< of a Create 1 (kCreate1Wheels) track and top speed
};

struct Counts {
  std::uint32_t frames = 0;
  std::uint32_t starts = 0;      ///< requests for the stream
  std::uint32_t impossible = 0;  ///< readings faster than the wheels can turn: not taken as motion
};

/// A frame comes every 15 ms. A lost frame loses no motion. The exception is a Create 1 that was moved unasked before a
/// reading that is lost. A Create 2 that was switched off counts from zero again. After a second of silence, counts as
/// near to zero as the robot can have driven since are a restart. The pose then continues from where it was.
class Session {
 public:
  using Sample = sensor::OdometrySample;
  static constexpr std::int16_t kFastest = 500;  ///< mm/s

  explicit Session(const Config& config);

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::OdometrySample& sample() const { return sample_; }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// Sends a whole command of the Open Interface, at most 8 bytes, for driving the robot over the same line.
  /// False when there is no room now.
  [[nodiscard]] bool command(std::span<const std::uint8_t> bytes) { return bytes.size() <= 8 && outbox_.put(bytes); }

  /// From now on the robot is driven while it is allowed to and the stream comes; otherwise it is stopped. In mode
  /// passive the robot does not obey. Until the first call nothing is ever sent that moves it, or stops it.
  void drive(const Motion& motion) { motion_ = motion; }
  /// At first it is not allowed. `most`: mm/s that its middle may have.
  void allow_motion(bool allowed, std::int16_t most = kFastest) {
    allowed_ = allowed;
    most_ = most;
  }
  /// At the end: it stands, and its motors are its own again (mode passive). Needs one more poll to be sent.
  void stand();

  /// kUnready: bytes come, but no good frame for half a second (baud rate, another program's stream).
  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] const StreamDecoder& decoder() const { return decoder_; }
  /// Of a Create 1.
  [[nodiscard]] const RequestedMotion& requested() const { return requested_; }

 private:
  void ask_if_due(base::Time now);
  void ask_for_stream(base::Time now);
  void steer(base::Time now);
  [[nodiscard]] bool put(const Motion& motion);
  void take_counts();
  [[nodiscard]] bool take_frame(std::uint8_t byte, base::Time now);
  [[nodiscard]] bool take_requested(bool reading);
  void ask_for_reading(base::Time now);
  [[nodiscard]] bool request_packets(bool reading);
  [[nodiscard]] bool may_have_restarted(base::Duration silence) const;
  [[nodiscard]] std::int64_t furthest_mm(base::Duration time) const;

  Config config_;
  StreamDecoder decoder_;
  odometry::DifferentialDrive wheels_;
  StreamDecoder reading_decoder_;  ///< a Create 1's frames with distance and angle
  RequestedMotion requested_;
  base::Time read_at_;
  base::Time reading_due_;
  base::Time asked_at_;  ///< for a reading
  serial::Outbox<64> outbox_;
  std::optional<Motion> motion_;   ///< that is asked for
  std::optional<Motion> steered_;  ///< that was sent last
  base::Time steered_at_;
  bool allowed_ = false;
  std::int16_t most_ = kFastest;
  bool begun_ = false;
  bool streaming_ = false;
  bool heard_ = false;
  bool any_ = false;
  std::uint8_t tries_ = 0;
  base::Time deadline_;
  base::Time heard_at_;
  base::Time last_t_;
  sensor::OdometrySample sample_;
  Counts counts_;
};

}  // namespace fencepost::create
