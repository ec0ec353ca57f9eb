// Finds a lost robot's pose in a map that it has: a filter over candidate poses. A sighting of a known thing determines
// the pose but for a circle around the thing. Candidates are put all around it, a Gaussian each, and driven along. Each
// other thing is where a candidate predicts it, or where a stranger's things are: anywhere. A place is reported only if
// one candidate outweighs all others and the chance of an unknown place.
//
// A search by objects that have a place (constellation.hpp) needs three of these, and a narrow lens places one a
// minute.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "firmware/recon/observe/sighting.hpp"
#include "host/relocation/constellation.hpp"

namespace fencepost::recon {

/// A sighting as a place. Metres, axes of the odometry.
struct RangedSighting {
  Vec2 from_robot{0, 0};  ///< from the robot's origin
  Vec2 direction{1, 0};   ///< from the lens, unit
  float range = 0;        ///< from the lens
  float along = 0;        ///< m^2, variances along the direction and across it
  float across = 0;
};

/// The radius of things of a colour, from the known map. m.
struct KnownRadius {
  float mean = 0;
  float sigma = 0;
};
/// Nothing: the map has no such thing.
std::optional<KnownRadius> radius_of(std::span<const ConstellationPoint> known, std::uint8_t signature);

/// Range by width and foot. Nothing where an end is cut off, or the range's sigma exceeds a third of it.
std::optional<RangedSighting> ranged(const Sighting& sighting, const KnownRadius& radius,
                                     const MeasurementNoise& noise);

/// A pose that the robot may have.
struct Candidate {
  Vec2 place{0, 0};     ///< of the robot in the known map
  Vec2 rotation{1, 0};  ///< from the axes of its odometry to the map's, cosine and sine
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();  ///< of place and rotation, m and rad
  float weight = 0;                                      ///< 1: as likely as that it is in a place it does not know
  std::uint32_t met = 0;                                 ///< things of the map that were where it says, by bits
};

struct Relocation {
  Vec2 place{0, 0};     ///< of the robot in the known map at the last sighting
  Vec2 rotation{1, 0};  ///< from the axes of its odometry to the map's
  float doubt = 1;      ///< probability of all else
  int met = 0;          ///< things of the map that are where it says
};

/// No heap: 64 bytes a candidate. Cost of a sighting: some 200 operations for each candidate and thing of its colour.
class RelocationFilter {
 public:
  static constexpr std::size_t kCandidates = 384;
  static constexpr std::size_t kMaxKnown = 32;  ///< things; those behind are not used

  /// `known` is borrowed until the end.
  explicit RelocationFilter(std::span<const ConstellationPoint> known);

  /// Since the last call, by odometry: `step` m along its axes, `turned` rad.
  void drive(const Vec2& step, float turned);
  /// A thing in sight, of a colour that the map has. Where it has more of it than there is room for candidates around
  /// them, others have to propose.
  void see(const RangedSighting& sighted, std::uint8_t signature);
  /// Nothing: not sure.
  [[nodiscard]] std::optional<Relocation> found() const;

 private:
  void weigh(Candidate& candidate, const RangedSighting& sighted, std::uint8_t signature) const;
  void propose(const RangedSighting& sighted, std::uint8_t signature);
  void put(const Candidate& candidate);

  std::span<const ConstellationPoint> known_;
  float area_ = 0;  ///< m^2, where a stranger's things may be
  std::array<Candidate, kCandidates> candidates_{};
  std::uint32_t proposed_ = 0;  ///< things of the map around which candidates were put, by bits
};

}  // namespace fencepost::recon
