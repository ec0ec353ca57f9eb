// Selects the objects whose models are updated in a frame. The update is most of a frame's work, so a small part does
// it for few objects a frame.
#pragma once

#include <cstddef>

#include "firmware/recon/observe/sighting.hpp"
#include "firmware/recon/track/object_table.hpp"
#include "hal/base/stamp.hpp"

namespace fencepost::recon {

/// Selects the frames whose views go to the models: some of a fast camera's, whose views repeat, and all of a slow
/// one's.
class ModelPace {
 public:
  void clear() { *this = {}; }

  /// True if models take sightings of this frame, and fits go on.
  bool due(base::Time exposure, base::Duration interval) {
    const base::Duration passed = taken_.since(exposure);
    if (begun_ && passed < interval && passed.raw >= 0) return false;
    begun_ = true;
    taken_ = base::Stamp(exposure);
    return true;
  }

 private:
  base::Stamp taken_;  ///< when they did last
  bool begun_ = false;
};

/// The object of this frame whose foot is lowest in the image: the robot is about to hit that one. kObjects: none was
/// seen.
template <class Profile>
std::size_t lowest_foot(const typename ObjectTable<Profile>::MatcherType& matcher) {
  std::size_t lowest = Profile::kObjects;
  for (std::size_t o = 0; o < matcher.slots(); ++o) {
    if (!matcher.seen(o)) continue;
    if (lowest == Profile::kObjects || matcher.foot_of(o) > matcher.foot_of(lowest)) lowest = o;
  }
  return lowest;
}

/// The object of this frame that has waited longest for its models' turn; for `nearest` the wait counts twice. Of two
/// the nearer one. kObjects if none waits. No object waits for ever: new or near ones go first only while the others
/// have waited less than twice the capacity.
template <class Profile>
std::size_t most_urgent(const ObjectTable<Profile>& table, const typename ObjectTable<Profile>::MatcherType& matcher,
                        std::size_t nearest) {
  std::size_t urgent = Profile::kObjects;
  int longest = 0;
  for (std::size_t o = 0; o < matcher.slots(); ++o) {
    const ObjectCore& object = table.objects()[o];
    if (!matcher.seen(o) || object.waiting == 0) continue;
    const int waited = object.waiting * (o == nearest ? 2 : 1);
    const bool before = waited == longest && matcher.foot_of(o) > matcher.foot_of(urgent);
    if (waited < longest || (waited == longest && !before)) continue;
    urgent = o;
    longest = waited;
  }
  return urgent;
}

/// The models of Profile::kModelTurns objects take what the frame shows of them from `lens`.
template <class Profile>
[[gnu::noinline]] void update_models(ObjectTable<Profile>& table,
                                     const typename ObjectTable<Profile>::MatcherType& matcher,
                                     const CameraModel& camera, const LensPose& lens, const MeasurementNoise& noise) {
  const std::size_t nearest = lowest_foot<Profile>(matcher);
  for (std::size_t turn = 0; turn < Profile::kModelTurns; ++turn) {
    const std::size_t o = most_urgent(table, matcher, nearest);
    if (o == Profile::kObjects) return;
    table.objects()[o].model(make_sighting(camera, lens, matcher.observation_of(o)), noise);
  }
}

}  // namespace fencepost::recon
