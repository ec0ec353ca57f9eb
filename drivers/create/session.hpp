// The conversation with an iRobot Create 1, Create 2 or Roomba 600: start, stream, and a pose of it.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/create/stream_decoder.hpp"
#include "drivers/odometry/differential_drive.hpp"
#include "drivers/serial/outbox.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::create {

enum class Model : std::uint8_t {
  kCreate1,  ///< packets 19, 20: whole mm and degrees since the last reading, fractions cut off by the robot
  kCreate2,  ///< packets 43, 44: encoder counts; Roomba 600 too
};

/// What the robot lets its host do. Passive is enough to read; whoever drives needs one of the others.
enum class Mode : std::uint8_t { kPassive, kSafe, kFull };

struct Config {
  Model model = Model::kCreate2;
  Mode mode = Mode::kPassive;
  odometry::WheelBase wheels = odometry::kCreate2Wheels;  ///< of a Create 1, only the top speed is used
};

struct Counts {
  std::uint32_t frames = 0;
  std::uint32_t starts = 0;      ///< times the stream was asked for
  std::uint32_t impossible = 0;  ///< readings that no wheel can have done: not taken as motion
};

/// A frame comes every 15 ms. A Create 1's frame that is lost on the way takes its motion with it; a Create 2's does
/// not. A robot that was switched off counts from zero again: after a second of silence, counts that lie as near to
/// zero as the robot can have come since are taken as a new start, and the pose goes on from where it was.
class Session {
 public:
  using Sample = sensor::OdometrySample;

  explicit Session(const Config& config);

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::OdometrySample& sample() const { return sample_; }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// For whoever drives the robot over the same line: a whole command of the Open Interface, at most 8 bytes.
  /// False when there is no room now.
  [[nodiscard]] bool command(std::span<const std::uint8_t> bytes) { return bytes.size() <= 8 && outbox_.put(bytes); }

  /// kUnready: bytes come, but no good frame for half a second (baud rate, another program's stream).
  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] const StreamDecoder& decoder() const { return decoder_; }

 private:
  void ask_for_stream(base::Time now);
  void take_counts();
  void take_distance();
  [[nodiscard]] bool may_have_restarted(base::Duration silence) const;
  [[nodiscard]] std::int64_t furthest_mm(base::Duration time) const;

  Config config_;
  StreamDecoder decoder_;
  odometry::DifferentialDrive wheels_;
  odometry::ArcIntegrator pose_;
  std::int64_t degrees_ = 0;
  serial::Outbox<48> outbox_;
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
