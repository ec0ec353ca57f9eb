// Checks the configured focal length. While the robot turns, a static object moves across the image by the same angle.
// A focal length configured too long makes angles from pixels too small, so objects seem to turn too little. One too
// short makes them turn too much. A wrongly configured wheel track looks the same; the camera cannot separate the two.
//
// The check follows one object at a time, frame by frame. After each kLensTurn of the heading it compares the object's
// direction with the earlier one. It subtracts the parallax of the lens's own way at the object's distance. A mover
// contradicts the others, or itself when the robot turns the other way, and is forgotten in time.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/recon/observe/sighting.hpp"
#include "firmware/recon/track/object.hpp"
#include "hal/base/fnv1a.hpp"
#include "hal/base/stamp.hpp"
#include "hal/base/units.hpp"

namespace fencepost::recon {

class LensCheck {
 public:
  /// Nothing is known: a new run, or another calibration.
  void clear() { *this = LensCheck(); }

  /// Looks at one frame. `odometry`: the robot's pose at the exposure by odometry alone, for a corrected heading
  /// contains the camera's error. `lens`: in the map, where the objects are. cost: next to nothing, except in a frame
  /// that ends one turn of kLensTurn and begins the next one.
  template <class Table, class Matcher>
  void look(const Table& table, const Matcher& matcher, const CameraModel& camera, const LensPose& lens,
            const MapPose& odometry) {
    const bool turns = turn(odometry.heading, table.exposure());
    if (!turns || !shows(table, matcher, slot_)) id_ = 0;
    if (!turns) return;
    const bool begins = id_ == 0;
    if (begins && !choose(table, matcher)) return;
    if (!begins && !turned_on(odometry.heading)) return;
    take(table.objects()[slot_], matcher.observation_of(slot_), camera, lens, odometry, begins);
  }

  /// True if the configured focal length is wrong by a factor and a significance beyond kLensWrong; see kLensRight too.
  [[nodiscard]] bool wrong() const { return wrong_; }
  /// The configured focal length over the true one, if wrong().
  [[nodiscard]] std::optional<float> error() const {
    return wrong_ ? std::optional(configured_over_true()) : std::nullopt;
  }
  /// The estimated ratio of the configured focal length to the true one; 1 without a sample.
  [[nodiscard]] float configured_over_true() const;

  /// One part in turn: `turn` counts frames.
  void hash(base::Fnv1a64& hash, std::uint32_t turn) const;

 private:
  // Confirmed, where it is known, and in this frame seen from end to end.
  template <class Table, class Matcher>
  [[nodiscard]] bool may_follow(const Table& table, const Matcher& matcher, std::size_t slot) const {
    if (!matcher.seen(slot)) return false;
    const ObjectCore& object = table.objects()[slot];
    return object.confirmed && !object.cut_off() && object.placed() && object.cylinder.estimate().ok();
  }
  template <class Table, class Matcher>
  [[nodiscard]] bool shows(const Table& table, const Matcher& matcher, std::size_t slot) const {
    return id_ != 0 && may_follow(table, matcher, slot) && table.objects()[slot].id == id_;
  }
  // Each in turn: one that moves is not followed alone.
  template <class Table, class Matcher>
  bool choose(const Table& table, const Matcher& matcher) {
    for (std::size_t i = 0; i < Table::kObjects; ++i) {
      slot_ = static_cast<std::uint8_t>(slot_ + 1U < Table::kObjects ? slot_ + 1U : 0U);
      if (!may_follow(table, matcher, slot_)) continue;
      id_ = table.objects()[slot_].id;
      return true;
    }
    return false;
  }

  // The followed object in one frame.
  struct View {
    Vec2 bearing{1, 0};  // of its middle, unit, axes of the level camera
    float distance = 0;  // m, from the lens to its middle
  };

  bool turn(std::int32_t heading, base::Time exposure);
  [[nodiscard]] bool turned_on(std::int32_t heading) const;
  [[gnu::noinline]] void take(const ObjectCore& object, const Observation& seen, const CameraModel& camera,
                              const LensPose& lens, const MapPose& odometry, bool begins);
  void compare(const View& view, const CameraModel& camera, const MapPose& odometry);
  void learn(float turned, float configured);
  void judge();

  // Sums over samples, rad^2. `turned`: the robot's turn less parallax. `configured`: the object's turn by the
  // configured lens.
  float turned_square_ = 0;
  float turned_configured_ = 0;
  float configured_square_ = 0;

  // The frame that the next one is compared with.
  MapPose then_;
  View view_;
  float rate_ = 0;  // rad/s

  float rate_now_ = 0;
  std::int32_t heading_ = 0;  // of the latest frame, urad
  base::Stamp exposure_;
  std::uint32_t id_ = 0;  // of the object that is followed; 0: none
  std::uint8_t slot_ = 0;
  std::uint8_t samples_ = 0;
  std::uint8_t objects_ = 0;  // how often one was followed that gave a sample, up to kLensObjects
  bool fresh_ : 1 = true;     // the one that is followed has given none yet
  bool wrong_ : 1 = false;
};

static_assert(sizeof(LensCheck) < 64);

}  // namespace fencepost::recon
