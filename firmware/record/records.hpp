// The records of the stream, one struct a kind; the sensor kinds are the vocabulary of hal/sensor itself.
// Field order, decimals and ranges: host/share/doc/stream.md. Every value is exactly what its line can express.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::record {

inline constexpr std::uint32_t kStreamFormat = 1;  ///< the only stream format there is
inline constexpr std::size_t kMaxLine = 1024;      ///< characters, line end included

enum class Kind : std::uint8_t {
  kHeader,
  kCamera,
  kSignature,
  kOdometry,
  kFrame,
  kPosition,
  kObject,
  kAlert,
  kDigest,
  kLink,
  kStatus,
  kSetting,
  kHeartbeat,
  kCalibrationDoubt,
  kCar,
  kSectors,
  kWays,
  kSpeedLimit,
};

/// FPHDR: starts a run; all state resets.
struct Header {
  std::uint32_t format = kStreamFormat;
  sensor::Text product;
  sensor::Text version;
  sensor::Text target;
  sensor::Text profile;
  friend constexpr bool operator==(const Header&, const Header&) = default;
};

/// FPSIG: one colour signature.
struct Signature {
  std::uint8_t signature = 0;
  sensor::Rgb rgb;
  sensor::Text name;
  std::int8_t pad = 0;      ///< px that boxes of this colour are too wide on each side
  std::uint16_t width = 0;  ///< mm, of all things of this colour, mean of all sides; 0: not known
  friend constexpr bool operator==(const Signature&, const Signature&) = default;
};

/// FPPOS: pose after correction by landmarks.
struct Position {
  base::Time t;
  base::Metres x;
  base::Metres y;
  base::Radians heading;
  base::Metres sigma_xy;
  base::Radians sigma_heading;
  friend constexpr bool operator==(const Position&, const Position&) = default;
};

enum class ObjectState : std::uint8_t { kTentative, kConfirmed, kLost };

constexpr std::string_view name(ObjectState state) {
  switch (state) {
    case ObjectState::kTentative: return "tentative";
    case ObjectState::kConfirmed: return "confirmed";
    case ObjectState::kLost: return "lost";
  }
  return "tentative";
}

/// FPOBJ: the estimate of one object. x, y in the map frame; bearing and distance as in FPALR.
struct ObjectReport {
  base::Time t;
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  std::uint32_t views = 0;
  base::Metres x;
  base::Metres y;
  base::Metres radius;
  base::Metres z_min;
  base::Metres z_max;
  base::Radians bearing;
  base::Metres distance;
  base::Ratio2 confidence;
  ObjectState state = ObjectState::kTentative;
  friend constexpr bool operator==(const ObjectReport&, const ObjectReport&) = default;
};

/// In order of urgency; to be blind is no less urgent than to stop.
enum class AlertLevel : std::uint8_t { kClear, kNotice, kWarn, kStop, kBlind };

constexpr std::string_view name(AlertLevel level) {
  switch (level) {
    case AlertLevel::kClear: return "clear";
    case AlertLevel::kNotice: return "notice";
    case AlertLevel::kWarn: return "warn";
    case AlertLevel::kStop: return "stop";
    case AlertLevel::kBlind: return "blind";
  }
  return "clear";
}

/// The id of an alert that is no object's: the guard saw something, or nothing can be seen.
inline constexpr std::uint32_t kNoObject = 0;

/// FPALR: bearing and distance in the robot frame, from its origin to the nearest point of the alert model. An alert of
/// the guard has those of its nearest point that is in the way. At level blind only t, level and id are given.
struct AlertReport {
  base::Time t;
  AlertLevel level = AlertLevel::kClear;
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  base::Radians bearing;
  base::Metres distance;
  std::optional<base::Duration> ttc;  ///< time to contact; empty when not closing
  base::Ratio2 confidence;
  friend constexpr bool operator==(const AlertReport&, const AlertReport&) = default;

  /// It says where something is or was; not so at level blind, nor where a robot says that it is blind no more.
  [[nodiscard]] constexpr bool has_place() const {
    if (level == AlertLevel::kBlind) return false;
    return id != kNoObject || level != AlertLevel::kClear || distance.raw != 0;
  }
};

/// FPALV: the robot is at work, ten times a second of stream time. `level` is the highest in force until now; the
/// states follow from what the stream holds, not from what a driver says of its cable.
struct Heartbeat {
  base::Time t;
  AlertLevel level = AlertLevel::kClear;
  sensor::LinkState camera = sensor::LinkState::kAbsent;
  sensor::LinkState odometry = sensor::LinkState::kAbsent;
  friend constexpr bool operator==(const Heartbeat&, const Heartbeat&) = default;
};

/// FPSPD: the largest speed from which the robot still stops in front of what it knows, on the way that it drives.
/// After each FPALV.
struct SpeedLimit {
  base::Time t;
  std::optional<base::Metres> speed;  ///< m/s; 0 at level stop; empty: not known
  friend constexpr bool operator==(const SpeedLimit&, const SpeedLimit&) = default;
};

/// The part of the calibration that cannot be right.
enum class Doubt : std::uint8_t {
  kNone,
  kRows,  ///< pitch or height of the camera: the rows of most feet say a wrong depth
  kLens,  ///< focal length of the camera, or track of the wheels: what it sees does not turn as they say
};

constexpr std::string_view name(Doubt doubt) {
  switch (doubt) {
    case Doubt::kNone: return "none";
    case Doubt::kRows: return "rows";
    case Doubt::kLens: return "lens";
  }
  return "none";
}

/// FPCAL: the result of the camera's check, from t on. `factor` is the depth by rows, or the focal length, of the
/// calibration over the one that was found. Above 1, things are nearer than the calibration says.
struct CalibrationDoubt {
  base::Time t;
  Doubt doubt = Doubt::kNone;
  base::Ratio2 factor{base::Ratio2::kPerUnit};
  friend constexpr bool operator==(const CalibrationDoubt&, const CalibrationDoubt&) = default;
};

/// FPDIG: state digest after that frame.
struct DigestReport {
  std::uint32_t frame = 0;
  std::uint64_t digest = 0;
  friend constexpr bool operator==(const DigestReport&, const DigestReport&) = default;
};

/// FPLNK: a device's link changed.
struct LinkReport {
  base::Time t;
  sensor::Text device;
  sensor::LinkState state = sensor::LinkState::kAbsent;
  sensor::Text detail;
  friend constexpr bool operator==(const LinkReport&, const LinkReport&) = default;
};

/// FPSTA: counters since boot, once a second. loop_us_max is not reproducible.
struct StatusReport {
  base::Time t;
  std::uint32_t frames = 0;
  std::uint32_t blobs = 0;
  std::uint32_t blobs_dropped = 0;
  std::uint32_t odometry = 0;
  std::uint32_t rejected = 0;
  std::uint32_t refused = 0;
  std::uint32_t records_dropped = 0;
  std::uint32_t objects = 0;
  std::uint32_t loop_us_max = 0;
  friend constexpr bool operator==(const StatusReport&, const StatusReport&) = default;
};

/// FPSEC: nearest distance from the robot's origin in equal sectors, the first centred straight ahead,
/// counter-clockwise. On request.
struct SectorReport {
  static constexpr std::size_t kMax = 36;
  struct Sector {
    std::optional<base::Metres> distance;  ///< empty: not known
    friend constexpr bool operator==(const Sector&, const Sector&) = default;
  };
  base::Time t;
  base::FixedVector<Sector, kMax> sectors;
  friend constexpr bool operator==(const SectorReport&, const SectorReport&) = default;
};

/// The motion along a way: on a straight line or an arc, or on the spot.
enum class WayMotion : std::uint8_t { kForward, kBack, kSpin };

constexpr std::string_view name(WayMotion motion) {
  constexpr std::string_view kNames[] = {"forward", "back", "spin"};
  return kNames[static_cast<std::size_t>(motion)];
}

/// The end of a way: nothing as far as it is followed, a known thing, or floor that was not seen.
enum class WayEnd : std::uint8_t { kNothing, kThing, kUnknown };

constexpr std::string_view name(WayEnd end) {
  constexpr std::string_view kNames[] = {"nothing", "thing", "unknown"};
  return kNames[static_cast<std::size_t>(end)];
}

/// FPWAY: how far the robot may go, and how fast, along a few ways from where it is. On request.
struct WayReport {
  static constexpr std::size_t kMax = 9;
  struct Way {
    WayMotion motion = WayMotion::kForward;
    base::Ratio2 curvature;  ///< 1/m, positive to the left; 0 on the spot
    base::Metres free;       ///< along the way of its origin; rad on the spot
    base::Metres speed;      ///< m/s or rad/s, the largest; never negative
    WayEnd end = WayEnd::kUnknown;
    friend constexpr bool operator==(const Way&, const Way&) = default;
  };
  base::Time t;
  base::FixedVector<Way, kMax> ways;
  friend constexpr bool operator==(const WayReport&, const WayReport&) = default;
};

/// FPCFG: a setting in force or changed.
struct Setting {
  sensor::Text key;
  sensor::Text value;
  friend constexpr bool operator==(const Setting&, const Setting&) = default;
};

/// Why a line that starts with $FP was not used.
enum class Reject : std::uint8_t {
  kCrc,
  kKind,
  kFields,
  kNumber,
  kRange,
  kLength,
  kTruncated,
  kTime,
  kFormat,
};
inline constexpr std::size_t kRejectReasons = 9;

constexpr std::string_view name(Reject reason) {
  constexpr std::string_view kNames[kRejectReasons] = {"crc",    "kind",      "fields", "number", "range",
                                                       "length", "truncated", "time",   "format"};
  return kNames[static_cast<std::size_t>(reason)];
}

}  // namespace fencepost::record
