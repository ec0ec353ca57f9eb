// Tangents by direction: a few clusters a sector, each the mean of the tangents that agreed. A wrong tangent opens a
// cluster of its own; nothing is deleted because one view contradicts it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/hybrid/tangent.hpp"

namespace fencepost::recon {

inline constexpr std::size_t kClustersPerSector = 2;
inline constexpr float kOffsetStep = 1e-4F;  ///< m; offsets reach to 3.27 m from the origin
/// 1/32 of a turn, 11 degrees: the maximum angle between a side and an edge that counts as an edge of this side.
inline constexpr std::size_t kSideSectors = 32;
inline constexpr float kViewsStep = 0.125F;     ///< weights are counted in eighths of a view
inline constexpr float kSmallestSigma = 1e-4F;  ///< m, of a stored sigma

/// Five bytes: offset in kOffsetStep, little endian; where in the sector, and its kind; sigma as encode_sigma(); views.
struct PackedCluster {
  std::uint8_t offset_low = 0;
  std::uint8_t offset_high = 0;
  std::uint8_t phase = 0;  ///< 1/128 of the sector, doubled; plus 1 if the cluster says `at least`
  std::uint8_t sigma = 0;
  std::uint8_t views = 0;  ///< in kViewsStep; 0: empty
};
static_assert(sizeof(PackedCluster) == 5);

/// The same in numbers.
struct Cluster {
  float offset = 0;  ///< m
  float phase = 0;   ///< share of the sector, in (0, 1)
  float sigma = 0;   ///< m, of one view in it
  float views = 0;
  bool lower_bound = false;  ///< of tangents beyond which the object goes on
};

/// A float of 4 + 4 bits, steps of 3 to 6 %, from 0.1 mm to 6.3 m; nearest, clamped.
std::uint8_t encode_sigma(float sigma);
/// The same in whole kSigmaUnit, exactly: 16 to 31 << 15.
inline constexpr float kSigmaUnit = 6.25e-6F;  ///< m
constexpr std::uint32_t whole_sigma(std::uint8_t code) { return (16U + code % 16U) << (code / 16U); }
inline float decode_sigma(std::uint8_t code) { return static_cast<float>(whole_sigma(code)) * kSigmaUnit; }

/// The largest offset, in kOffsetStep, on either side.
inline constexpr std::int32_t kFarthestOffset = 32'767;

/// Metres to whole kOffsetStep, nearest. False if out of range.
bool whole_steps(float offset, std::int32_t& steps);

/// False if the offset is out of range: nothing is written.
bool pack(const Cluster& cluster, PackedCluster& packed);
Cluster unpack(const PackedCluster& packed);

/// The place of a direction among `sectors` sectors, of which the first begins at the x axis.
struct SectorPlace {
  std::size_t sector = 0;
  float phase = 0;  ///< [0, 1)
};
SectorPlace place_of(const Vec2& normal, std::size_t sectors);
Vec2 direction_of(const SectorPlace& place, std::size_t sectors);

using Clusters = std::span<PackedCluster>;
using ConstClusters = std::span<const PackedCluster>;

/// Which of kPhases places of its sector.
constexpr std::size_t place_in_sector(const PackedCluster& packed) { return packed.phase >> 1U; }
/// The direction of cluster `index`; 64 or 32 sectors.
Vec2 direction_of(ConstClusters clusters, std::size_t index);

/// Values of the model that the store needs to compare tangents of slightly different directions.
struct StoreContext {
  float slope = 0;  ///< h'(direction) of the model there, m/rad
  float scale = 1;  ///< how much larger residuals are than sigmas say
};

/// Inserts a tangent with weight `novelty` in (0, 1]. It joins the cluster that it agrees with, or opens a new one. If
/// there is no room, it replaces the weaker cluster, or weakens that one if it is stronger than the tangent. A lower
/// bound joins lower bounds only. It is dropped where an edge is known that far out, and never weakens an edge.
void insert(Clusters clusters, const SectorPlace& place, const Tangent& tangent, float novelty,
            const StoreContext& context);

/// A step of the origin in kOffsetStep, at most kFarthestOffset in x and y. With integers a whole store moves in a few
/// thousand instructions.
struct OriginShift {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

inline constexpr std::int32_t kParts = 512;  ///< of a sector
/// The amount that a shift subtracts from an offset, in kOffsetStep. The direction lies `part` of kParts into the
/// sector.
std::int32_t change_of_offset(const OriginShift& shift, std::size_t sector, std::int32_t part, std::size_t sectors);

/// Coordinates from a point `shift` away. What gets out of range is forgotten.
void move_origin(Clusters clusters, const OriginShift& shift);

/// Share of its views that cluster `index` counts for. It is less if the neighbour in the sector has a larger offset
/// and is not much weaker. Lost pieces and occluders bias offsets down far more often than up. Lower bounds never
/// reduce it.
float standing(ConstClusters clusters, std::size_t index);

/// True if an edge of the side with this outward normal was seen. Otherwise the side is open: the object reaches beyond
/// the seen part there, or no view showed it.
bool edge_seen(ConstClusters clusters, const Vec2& normal);

}  // namespace fencepost::recon
