// Straight ahead by the board's own motors, until anything speaks against it: what a first robot does. It never sets
// off by itself, neither after a reset nor after a stop: `go` on the console starts it, or the board's button.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/recon/observe/pose_history.hpp"
#include "hal/base/stamp.hpp"
#include "hal/base/trig.hpp"
#include "hal/base/units.hpp"

namespace fencepost::loop {

/// The reason for a stop.
enum class Standstill : std::uint8_t { kAlert, kLine, kPort, kBlocked, kTurned, kBackwards };

constexpr std::string_view reason(Standstill standstill) {
  switch (standstill) {
    case Standstill::kAlert: return "STOP, BLIND or a silent sensor";
    case Standstill::kLine: return "a line was typed";
    case Standstill::kPort: return "the port was closed, or its cable pulled";
    case Standstill::kBlocked: return "by odometry they have not moved it for a second: is it blocked?";
    case Standstill::kTurned: return "by odometry it has turned: both motors, the same way round?";
    case Standstill::kBackwards: return "by odometry it goes backwards: swap the motors' wires, or wheel.counts' sign";
  }
  return {};
}

class Bumper {
 public:
  /// To be called several times in 20 ms. `wanted`: by the console, withdrawn by any typed line. `may_move`: by
  /// MotionPermit. `odometry`: its latest pose. True: the motors run.
  [[nodiscard]] bool judge(bool wanted, bool may_move, const std::optional<recon::MapPose>& odometry, base::Time now) {
    if (!going_) {
      if (wanted && may_move && odometry) set_off(*odometry, now);
      return going_;
    }
    if (const auto why = against(wanted, may_move, odometry, now)) stand(*why);
    return going_;
  }

  /// Stops for a reason that judge() does not know.
  void stand(Standstill why) {
    if (going_) stood_ = why;
    going_ = false;
  }

  /// Once for each time that it stopped.
  [[nodiscard]] std::optional<Standstill> take_standstill() {
    const std::optional<Standstill> why = stood_;
    stood_.reset();
    return why;
  }

 private:
  static constexpr base::Duration kPatience = base::milliseconds(1'000);
  /// m; what a slow robot moves in a tenth of its patience, and several counts of any encoder.
  static constexpr float kMoved = 0.005F;
  static constexpr float kBack = -0.03F;            // m along the first heading; more than a gear's play
  static constexpr std::int32_t kTurned = 785'000;  // urad, 45 degrees: no drift of two motors on a straight does that

  void set_off(const recon::MapPose& odometry, base::Time now) {
    going_ = true;
    from_ = last_ = odometry;
    moved_ = base::Stamp(now);
  }

  std::optional<Standstill> against(bool wanted, bool may_move, const std::optional<recon::MapPose>& odometry,
                                    base::Time now) {
    if (!may_move || !odometry) return Standstill::kAlert;
    if (!wanted) return Standstill::kLine;
    if (recon::offset_from(last_.position, odometry->position).squared_norm() >= kMoved * kMoved) {
      last_ = *odometry;
      moved_ = base::Stamp(now);
    }
    const std::int64_t turn = std::int64_t{odometry->heading} - from_.heading;
    if (turn > kTurned || turn < -kTurned) return Standstill::kTurned;
    const base::SinCos ahead = base::sincos_urad(from_.heading);
    const recon::Vec2 way = recon::offset_from(from_.position, odometry->position);
    if (way.x() * ahead.cos + way.y() * ahead.sin < kBack) return Standstill::kBackwards;
    if (moved_.since(now) > kPatience) return Standstill::kBlocked;
    return std::nullopt;
  }

  bool going_ = false;
  std::optional<Standstill> stood_;
  recon::MapPose from_;  ///< at the start of the drive
  recon::MapPose last_;  ///< at the last motion seen
  base::Stamp moved_;
};

}  // namespace fencepost::loop
