// Which blob may be which object: by signature, predicted place and size in the image, and where its foot should be.
#pragma once

#include <cstdint>

#include "firmware/recon/observe/observation.hpp"
#include "firmware/recon/track/assignment.hpp"
#include "firmware/recon/track/prediction.hpp"
#include "firmware/recon/track/tuning.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

/// Cost of matching the blob to the object, 0 (perfect) to 200; kImpossible: the gate excludes it. It is the mean over
/// the box's visible sides of the squared deviation in units of three sigmas, at most 1 a side. Place, size and shape
/// all count in it.
std::uint8_t match_cost(const Prediction& prediction, const Observation& seen);

/// Ids of a camera that tracks as evidence, by how often they stayed with their objects so far.
class IdEvidence {
 public:
  /// A blob was matched to an object that had an id a moment ago: it has the same one, or another.
  void count(bool kept) {
    ++(kept ? kept_ : changed_);
    if (kept_ < kMemory && changed_ < kMemory) return;
    kept_ = static_cast<std::uint8_t>(kept_ / 2);
    changed_ = static_cast<std::uint8_t>((changed_ + 1) / 2);
  }

  /// Cost units by which an id speaks for a pair or against it: the log-likelihood ratio, from the odds of kept ids to
  /// changed ones. 0 if ids change as often as not.
  [[nodiscard]] std::uint8_t cost() const {
    unsigned octaves = 0;
    while (unsigned{changed_} << (octaves + 1) <= kept_) ++octaves;
    return static_cast<std::uint8_t>(octaves * kCostOfOctave);
  }

  /// Nothing is hashed while the counts are those of the start.
  void hash(base::Fnv1a64& hash) const {
    if (kept_ == kIdsKept && changed_ == 1) return;
    hash.u8(kept_);
    hash.u8(changed_);
  }

 private:
  static constexpr std::uint8_t kMemory = 2 * kIdsKept;  ///< of either kind, whereupon all count half
  std::uint8_t kept_ = kIdsKept;
  std::uint8_t changed_ = 1;
};

/// The cost of a pair with its ids, each 0 if there is none. It is less by `id_cost` if the blob has the id of the
/// object's last sighting, and more by as much if it has another. A pair that cannot be stays so.
std::uint8_t cost_with_ids(std::uint8_t cost, std::uint8_t last_track, std::uint8_t track, std::uint8_t id_cost);

/// True if the blob lies within the predicted interval, give or take three sigmas: it may be a piece of the object.
bool covers(const Prediction& prediction, const Observation& seen);

/// True if the blob's middle lies in the predicted interval, give or take a sigma.
bool has_middle_of(const Prediction& prediction, const Observation& seen);

/// The ends of a blob that are edges more than three sigmas outside the predicted interval; `inside`: or inside.
struct EndsOff {
  bool left = false;
  bool right = false;
};
EndsOff ends_off(const Prediction& prediction, const Observation& seen, bool inside);

/// Counts the frames in a row in which an edge that was seen is more than three sigmas off, always to the same side.
/// Not one that was `open`: of something longer than the image it is the end, seen at last.
void compare_ends(ObjectCore& object, const Prediction& prediction, const Observation& seen, EndsOff open = {});
/// True if a stationary robot sees the object's foot elsewhere: its lower piece is lost, or another object is there
/// now.
[[nodiscard]] bool compare_foot(ObjectCore& object, const Observation& seen, bool stands);

/// True if the blob overlaps the predicted interval, tolerance left out: it may hide the object.
bool overlaps(const Prediction& prediction, const Observation& seen);
/// True if the blob's foot was seen clearly higher in the image than the object's. The blob is then farther away and
/// hides nothing of the object. Compared is the last foot if the robot is stationary since, else the predicted one.
/// False where there is neither.
bool stands_behind(const Observation& seen, const Prediction& prediction);

/// True if the robot has been stationary since it saw the object, and the blob's foot is elsewhere. The top has to be
/// elsewhere too, or the blob has to reach beyond the object's sides: a piece of the object does neither. For a refuted
/// object another foot is enough.
bool stands_elsewhere(const Prediction& prediction, const Observation& seen);

/// True if the blob is two objects of one signature that touch in the image. Its ends are those of a left and a right
/// object, and neither alone would be so wide. The distance of one of them must be known. If that of the other is not,
/// it must have been seen last beside the known one.
bool shows_both(const Prediction& left, const Prediction& right, const Observation& seen);

/// True if the object, predicted nearer than `behind`, reaches over the blob's end at this column (px): that end is
/// then not the blob's own. `side` is -1 for the left end and 1 for the right one.
bool hides_end(const Prediction& nearer, const Prediction& behind, std::int16_t column, int side);

}  // namespace fencepost::recon
