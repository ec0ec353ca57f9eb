#include "firmware/recon/models/hybrid/sector_store.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "firmware/recon/models/hybrid/phase_tables.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

constexpr std::int32_t kBulge = 79;  // D^2/2 of 64 sectors, in 1/16384

std::int32_t whole_offset(const PackedCluster& packed) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(packed.offset_low | (packed.offset_high << 8U)));
}

void set_offset(PackedCluster& packed, std::int32_t offset) {
  const auto bits = static_cast<std::uint16_t>(static_cast<std::int16_t>(offset));
  packed.offset_low = static_cast<std::uint8_t>(bits & 0xFFU);
  packed.offset_high = static_cast<std::uint8_t>(bits >> 8U);
}

std::uint8_t to_eighths(float views) {
  const float eighths = std::clamp(views / kViewsStep + 0.5F, 1.0F, 255.0F);
  return static_cast<std::uint8_t>(eighths);
}

bool is_at_least(const PackedCluster& packed) { return (packed.phase & 1U) != 0; }

std::uint8_t packed_phase(const Cluster& cluster) {
  constexpr auto kMax = static_cast<float>(kPhases);
  const auto part = static_cast<unsigned>(std::clamp(cluster.phase * kMax, 0.0F, kMax - 1));
  return static_cast<std::uint8_t>(2 * part + (cluster.lower_bound ? 1 : 0));
}

// Squared deviation from the cluster in units of its gate.
float gate_share(const Cluster& cluster, float phase_angle, const Tangent& tangent, const StoreContext& context) {
  const float off = tangent.line.bound - cluster.offset - context.slope * phase_angle;
  const float sigma = kJoinSigmas * tangent.sigma * context.scale;
  return off * off / (sigma * sigma * (1.0F + 1.0F / std::max(1.0F, cluster.views)));
}

// True if the edge is as far out as the lower bound, within a sigma, so that the bound adds nothing.
bool reaches(const Cluster& edge, float phase_angle, const Tangent& tangent, const StoreContext& context) {
  return edge.offset + context.slope * phase_angle > tangent.line.bound - tangent.sigma;
}

// The mean of both, weighted by information. Offsets are compared at one direction.
Cluster merged(const Cluster& cluster, float phase, const Tangent& tangent, float novelty, float slope_per_sector) {
  Cluster sum = cluster;
  const float faded =
      cluster.views > kMaxClusterViews ? cluster.views * (kMaxClusterViews / (kMaxClusterViews + 1)) : cluster.views;
  const float before = faded / (cluster.sigma * cluster.sigma);
  const float added = novelty / (tangent.sigma * tangent.sigma);
  const float share = added / (before + added);
  const float offset_there = tangent.line.bound - slope_per_sector * (phase - cluster.phase);
  sum.phase = cluster.phase + share * (phase - cluster.phase);
  sum.offset =
      cluster.offset + share * (offset_there - cluster.offset) + slope_per_sector * (sum.phase - cluster.phase);
  sum.views = faded + novelty;
  sum.sigma = std::sqrt(sum.views / (before + added));
  return sum;
}

}  // namespace

std::uint8_t encode_sigma(float sigma) {
  float mantissa = std::clamp(sigma, kSmallestSigma, 6.0F) / kSigmaUnit;
  // The float's own exponent gives all halvings at once, to a mantissa of 16 up to 32.
  std::uint32_t bits = 0;
  std::memcpy(&bits, &mantissa, sizeof bits);
  constexpr std::uint32_t kExponentOf16 = 127 + 4;
  std::uint32_t exponent = std::max(bits >> 23U, kExponentOf16) - kExponentOf16;
  bits -= exponent << 23U;
  std::memcpy(&mantissa, &bits, sizeof bits);
  if (mantissa >= 31.5F) {
    ++exponent;
    mantissa *= 0.5F;
  }
  return static_cast<std::uint8_t>(exponent * 16 + static_cast<unsigned>(mantissa + 0.5F) - 16);
}

bool whole_steps(float offset, std::int32_t& steps) {
  const float exact = offset / kOffsetStep;
  constexpr auto kLimit = static_cast<float>(kFarthestOffset);
  if (!(exact > -kLimit && exact < kLimit)) return false;
  steps = static_cast<std::int32_t>(exact < 0 ? exact - 0.5F : exact + 0.5F);
  return true;
}

bool pack(const Cluster& cluster, PackedCluster& packed) {
  std::int32_t offset = 0;
  if (!whole_steps(cluster.offset, offset)) return false;
  set_offset(packed, offset);
  packed.phase = packed_phase(cluster);
  packed.sigma = encode_sigma(cluster.sigma);
  packed.views = to_eighths(cluster.views);
  return true;
}

Cluster unpack(const PackedCluster& packed) {
  return {static_cast<float>(whole_offset(packed)) * kOffsetStep, phase_at(place_in_sector(packed)),
          decode_sigma(packed.sigma), static_cast<float>(packed.views) * kViewsStep, is_at_least(packed)};
}

SectorPlace place_of(const Vec2& normal, std::size_t sectors) {
  constexpr float kPerTurn = 0.159154943F;
  const float angle = base::atan2_rad(normal.y(), normal.x());
  const float turns = angle * kPerTurn;
  const float at = (turns < 0 ? turns + 1.0F : turns) * static_cast<float>(sectors);
  const std::size_t sector = std::min(static_cast<std::size_t>(at), sectors - 1);
  return {sector, std::min(at - static_cast<float>(sector), 0.999F)};
}

Vec2 direction_of(const SectorPlace& place, std::size_t sectors) {
  const float angle = place.phase * node_step(sectors).angle;
  return rotated({small_cosine(angle), small_sine(angle)}, node_direction(place.sector, sectors));
}

Vec2 direction_of(ConstClusters clusters, std::size_t index) {
  const std::size_t sectors = clusters.size() / kClustersPerSector;
  const std::size_t place = place_in_sector(clusters[index]);
  const Turn turn = sectors == kDirections ? kTurns<kDirections>[place] : kTurns<kDirections / 2>[place];
  return rotated({turn.cosine, turn.sine}, node_direction(index / kClustersPerSector, sectors));
}

void insert(Clusters clusters, const SectorPlace& place, const Tangent& tangent, float novelty,
            const StoreContext& context) {
  const float angle = node_step(clusters.size() / kClustersPerSector).angle;
  const Clusters own = clusters.subspan(place.sector * kClustersPerSector, kClustersPerSector);
  PackedCluster* best = nullptr;
  PackedCluster* weakest = own.data();
  float closest = 1.0F;
  for (PackedCluster& packed : own) {
    if (packed.views < weakest->views) weakest = &packed;
    if (packed.views == 0) continue;
    const Cluster cluster = unpack(packed);
    const float turned = (place.phase - cluster.phase) * angle;
    if (cluster.lower_bound != tangent.lower_bound) {
      if (tangent.lower_bound && reaches(cluster, turned, tangent, context)) return;
      continue;
    }
    if (tangent.lower_bound) {
      // The lower bound that is farther out implies the other one.
      const float beyond = tangent.line.bound - cluster.offset - context.slope * turned;
      if (beyond < -tangent.sigma) return;
      if (beyond > tangent.sigma) {
        static_cast<void>(pack({tangent.line.bound, place.phase, tangent.sigma, novelty, true}, packed));
        return;
      }
    }
    const float share = gate_share(cluster, turned, tangent, context);
    if (share >= closest) continue;
    closest = share;
    best = &packed;
  }
  if (best != nullptr) {
    static_cast<void>(pack(merged(unpack(*best), place.phase, tangent, novelty, context.slope * angle), *best));
    return;
  }
  const float views = static_cast<float>(weakest->views) * kViewsStep;
  if (tangent.lower_bound && views > 0 && !is_at_least(*weakest)) return;
  if (views > novelty) {
    weakest->views = to_eighths(views - kWeakening * novelty);
    return;
  }
  static_cast<void>(pack({tangent.line.bound, place.phase, tangent.sigma, novelty, tangent.lower_bound}, *weakest));
}

std::int32_t change_of_offset(const OriginShift& shift, std::size_t sector, std::int32_t part, std::size_t sectors) {
  const WholeVector from = whole_direction(sector, sectors);
  const WholeVector to = whole_direction(sector + 1, sectors);
  // Along the chord, and back out to the circle: 1 + D^2/2 p (1 - p).
  const std::int32_t x = from.x + (to.x - from.x) * part / kParts;
  const std::int32_t y = from.y + (to.y - from.y) * part / kParts;
  const std::int32_t bulge =
      part * (kParts - part) * (sectors == kDirections ? kBulge : 4 * kBulge) / (kParts * kParts);
  std::int32_t sum = x * shift.x + y * shift.y;
  sum += sum / kWholeUnit * bulge;
  return (sum + (sum < 0 ? -kWholeUnit / 2 : kWholeUnit / 2)) / kWholeUnit;
}

void move_origin(Clusters clusters, const OriginShift& shift) {
  const std::size_t sectors = clusters.size() / kClustersPerSector;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    PackedCluster& packed = clusters[i];
    if (packed.views == 0) continue;
    const std::int32_t offset =
        whole_offset(packed) - change_of_offset(shift, i / kClustersPerSector, 2 * (packed.phase | 1), sectors);
    if (offset > kFarthestOffset || offset < -kFarthestOffset) {
      packed = {};
    } else {
      set_offset(packed, offset);
    }
  }
}

bool edge_seen(ConstClusters clusters, const Vec2& normal) {
  const std::size_t sectors = clusters.size() / kClustersPerSector;
  const std::size_t reach = sectors / kSideSectors;
  const std::size_t first = place_of(normal, sectors).sector + sectors - reach;
  for (std::size_t i = 0; i <= 2 * reach; ++i) {
    const std::size_t sector = (first + i) % sectors;
    for (const PackedCluster& packed : clusters.subspan(sector * kClustersPerSector, kClustersPerSector)) {
      if (packed.views != 0 && !is_at_least(packed)) return true;
    }
  }
  return false;
}

float standing(ConstClusters clusters, std::size_t index) {
  const std::size_t first = index - index % kClustersPerSector;
  if (is_at_least(clusters[index])) return 1.0F;
  for (std::size_t i = first; i < first + kClustersPerSector; ++i) {
    if (clusters[i].views == 0 || whole_offset(clusters[i]) <= whole_offset(clusters[index])) continue;
    const Cluster own = unpack(clusters[index]);
    const float enough = kOverrulingShare * own.views;
    const Cluster other = unpack(clusters[i]);
    if (other.views >= enough && other.offset > own.offset + 2 * own.sigma) return kOverruled;
  }
  return 1.0F;
}

}  // namespace fencepost::recon
