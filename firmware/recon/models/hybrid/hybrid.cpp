#include "firmware/recon/models/hybrid/hybrid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/models/hash.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"
#include "firmware/recon/models/tuning.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::recon {
namespace {

void add_one(const HybridCore& core, Clusters clusters, const OutlineView& outline, const Tangent& tangent,
             float novelty) {
  const SectorPlace place = place_of(tangent.line.normal, outline.offsets.size());
  StoreContext context;
  if (core.refusal == HybridRefusal::kNone) context = {outline.slope(place), decode_sigma(core.spread)};
  insert(clusters, place, tangent, novelty, context);
}

// It reaches farther than the outline by more than noise: what goes on beyond the image grows while the robot drives
// along it.
bool outgrows(const HybridCore& core, const OutlineView& outline, const Tangent& tangent) {
  if (core.refusal != HybridRefusal::kNone) return false;
  const std::size_t sectors = outline.offsets.size();
  const std::size_t sector = place_of(tangent.line.normal, sectors).sector;
  const float reach = std::max(outline.offset(sector), outline.offset((sector + 1) % sectors));
  return tangent.line.bound > reach + kOutgrown + tangent.sigma;
}

// The weight of a view in 1 / kWholeView, at least one.
int weight_of(float novelty) { return std::max(1, static_cast<int>(kWholeView * novelty + 0.5F)); }

// Lower bounds that exceed the current outline.
unsigned outgrowing(const HybridCore& core, const OutlineView& outline, const ViewTangents& view) {
  unsigned which = 0;
  const auto look = [&](ViewTangents::Which one, const Tangent& tangent) {
    if ((view.lower_bound & one) != 0 && outgrows(core, outline, tangent)) which |= one;
  };
  look(ViewTangents::kLeft, view.left);
  look(ViewTangents::kRight, view.right);
  look(ViewTangents::kFront, view.front);
  return which;
}

// The side of a ring that `at`, in kOffsetStep, is farthest outside of. OutlineView::distance_from() finds the same
// side with a loop; this version compares the sides in parallel.
FENCEPOST_FOR_EACH_PROCESSOR
std::size_t side_before(std::span<const std::int16_t, kDirections> offsets, const WholeVector& at) {
  constexpr std::size_t kQuarter = kDirections / 4;
  std::array<std::array<std::int32_t, kQuarter>, 4> outside;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t k = 0; k < kQuarter; ++k) {
    const std::int32_t x = kWholeCosines[k];
    const std::int32_t y = kWholeCosines[kQuarter - k];
    const std::int32_t along = x * at.x + y * at.y;
    const std::int32_t left = x * at.y - y * at.x;
    outside[0][k] = along - offsets[k] * kWholeUnit;
    outside[1][k] = left - offsets[k + kQuarter] * kWholeUnit;
    outside[2][k] = -along - offsets[k + 2 * kQuarter] * kWholeUnit;
    outside[3][k] = -left - offsets[k + 3 * kQuarter] * kWholeUnit;
  }
  std::int32_t most = outside[0][0];
  for (const auto& quarter : outside) {
    for (const std::int32_t one : quarter) most = one > most ? one : most;
  }
  for (std::size_t k = 0; k < kQuarter; ++k) {
    for (std::size_t quarter = 0; quarter < outside.size(); ++quarter) {
      if (outside[quarter][k] == most) return k + quarter * kQuarter;
    }
  }
  return 0;
}

}  // namespace

float OutlineView::radius() const {
  std::int32_t sum = 0;
  for (const std::int16_t steps : offsets) sum += steps;
  return std::max(kMinRadius, static_cast<float>(sum) * kOffsetStep / static_cast<float>(offsets.size()));
}

float OutlineView::mean_sigma() const {
  std::uint32_t sum = 0;
  for (const std::uint8_t code : sigmas) sum += whole_sigma(code);
  return static_cast<float>(sum) * kSigmaUnit / static_cast<float>(sigmas.size());
}

float OutlineView::slope(const SectorPlace& place) const {
  const NodeStep step = node_step(offsets.size());
  const float t = place.phase * step.angle;
  const float here = offset(place.sector);
  const float there = offset(after(place.sector));
  return (small_cosine(t) * there - small_cosine(step.angle - t) * here) / step.sine;
}

float OutlineView::confidence() const { return 1.0F - std::sqrt(std::min(1.0F, mean_sigma() / radius())); }

// Whole numbers of kOffsetStep find the side, for cores that have nothing else; the distance is that side's in floats.
float OutlineView::distance_from(const Vec2& point, std::size_t& nearest) const {
  constexpr float kReach = 6.0F;  // m: products of a coordinate that is no larger fit
  const float size = std::max(std::fabs(point.x()), std::fabs(point.y()));
  const float steps = (size > kReach ? kReach / size : 1.0F) / kOffsetStep;
  const WholeVector at{static_cast<std::int32_t>(point.x() * steps), static_cast<std::int32_t>(point.y() * steps)};
  if (base::kVectors && offsets.size() == kDirections) {
    nearest = side_before(offsets.first<kDirections>(), at);
    return node_direction(nearest, kDirections).dot(point) - offset(nearest);
  }
  std::int32_t most = std::numeric_limits<std::int32_t>::min();
  const auto consider = [&](std::size_t k, std::int32_t along) {
    const std::int32_t outside = along - offsets[k] * kWholeUnit;
    if (outside <= most) return;
    most = outside;
    nearest = k;
  };
  // Four directions at a time, a quarter turn apart.
  const std::size_t quarter = offsets.size() / 4;
  for (std::size_t k = 0; k < quarter; ++k) {
    const WholeVector direction = whole_direction(k, offsets.size());
    const std::int32_t along = direction.x * at.x + direction.y * at.y;
    const std::int32_t left = direction.x * at.y - direction.y * at.x;
    consider(k, along);
    consider(k + quarter, left);
    consider(k + 2 * quarter, -along);
    consider(k + 3 * quarter, -left);
  }
  return node_direction(nearest, offsets.size()).dot(point) - offset(nearest);
}

float inflation(float share) {
  // Corners are rounded outwards, and what lies between tangents is: known well, an outline is a little large.
  const float rounded = 0.35F * std::clamp((0.4F - share) / 0.2F, 0.0F, 1.0F);
  return std::min(share, kVagueShare) - rounded;
}

Vec2 OutlineView::corner(std::size_t k) const {
  const NodeStep step = node_step(offsets.size());
  const float next = offset(after(k));
  const Vec2 normal = node_direction(k, offsets.size());
  const float along = (next - step.cosine * offset(k)) / step.sine;
  return offset(k) * normal + along * left_of(normal);
}

Chord OutlineView::chord_at(float x) const {
  Chord chord{-kOutlineSquare, kOutlineSquare};
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const Vec2 out = node_direction(k, offsets.size());
    const float left = offset(k) - out.x() * x;
    if (out.y() > 0) {
      chord.high = std::min(chord.high, left / out.y());
    } else if (out.y() < 0) {
      chord.low = std::max(chord.low, left / out.y());
    } else if (left < 0) {
      return {1, 0};
    }
  }
  return chord;
}

std::size_t outline_polygon(const OutlineView& outline, float more, std::span<Vec2> vertices) {
  const float radius = outline.radius();
  vertices[0] = {-kOutlineSquare, -kOutlineSquare};
  vertices[1] = {kOutlineSquare, -kOutlineSquare};
  vertices[2] = {kOutlineSquare, kOutlineSquare};
  vertices[3] = {-kOutlineSquare, kOutlineSquare};
  std::size_t size = 4;
  for (std::size_t k = 0; k < outline.offsets.size() && size > 0; ++k) {
    const float sigma = outline.sigma(k);
    const float moved_out = std::max(inflation(sigma / radius) * sigma, -kMaxInward);
    const float bound = outline.offset(k) + moved_out + more * sigma;
    size = clip_convex(vertices, size, {node_direction(k, outline.offsets.size()), bound});
  }
  return size;
}

Vec2 guessed_middle(const Sighting& first) {
  const RowDepth row = row_depth(first, {});
  const float along = first.axis.dot(first.center);
  const float by_foot = row.known && along > 0 ? row.depth / along + radius_prior(first.known_radius).mean : 0.0F;
  const float distance = by_foot > 0 ? std::clamp(by_foot, kNearestObject, kRowMaxDepth) : prior_distance(first);
  return first.lens_from(first.anchor) + distance * first.center;
}

void add_view(HybridCore& core, Clusters clusters, const OutlineView& outline, const Sighting& sighting,
              const MeasurementNoise& noise) {
  const Vec2 lens = sighting.lens_from(core.origin);
  const float distance = std::max(kNearestLens, lens.norm());
  const float moved_by = (lens - core.last_lens).norm() / (kNovelShare * distance);
  const bool elsewhere = core.views == 0 || moved_by >= kMinNewView;
  const std::uint8_t known = elsewhere ? std::uint8_t{0} : core.used;
  const float novelty = core.views == 0 || !elsewhere ? 1.0F : std::min(1.0F, moved_by);
  const ViewTangents view = tangents_of(sighting, core.origin, distance, noise);
  // A lower bound alone is no new information, unless the outline ends before it.
  if ((view.present & ~known) == 0 && outgrowing(core, outline, view) == 0) return;
  const unsigned edges = view.present & ~unsigned{known};
  const unsigned limits = view.lower_bound & ~(known | unsigned{known} >> ViewTangents::kBits);
  const unsigned fresh = edges | limits;
  if ((fresh & ViewTangents::kLeft) != 0) add_one(core, clusters, outline, view.left, novelty);
  if ((fresh & ViewTangents::kRight) != 0) add_one(core, clusters, outline, view.right, novelty);
  if ((fresh & ViewTangents::kFront) != 0) add_one(core, clusters, outline, view.front, novelty);
  if ((limits & ViewTangents::kFront) != 0 && view.straight > 0) {
    add_one(core, clusters, outline, {view.front.line, view.straight, false}, novelty);
  }
  core.used = static_cast<std::uint8_t>(known | edges | limits << ViewTangents::kBits);
  core.new_weight = static_cast<std::uint8_t>(std::min(255, core.new_weight + weight_of(novelty)));
  if (!elsewhere) return;
  core.last_lens = lens;
  if (core.views < 255) ++core.views;
}

bool edges_contradict(ConstClusters clusters, const OutlineView& outline, const Vec2& lens, const Vec2& normal) {
  const std::size_t sectors = outline.offsets.size();
  const SectorPlace place = place_of(normal, sectors);
  const float bound = normal.dot(lens);
  // The point of contact is not known; it may be far away on a long wall that is seen along its side.
  const float per_sector = node_step(sectors).angle * kOutlineSquare;
  for (int beside = -1; beside <= 1; ++beside) {
    const std::size_t sector = (place.sector + sectors + static_cast<std::size_t>(beside + 1) - 1) % sectors;
    for (std::size_t i = 0; i < kClustersPerSector; ++i) {
      const PackedCluster& packed = clusters[sector * kClustersPerSector + i];
      if (packed.views == 0) continue;
      const Cluster edge = unpack(packed);
      const float turned = std::fabs(static_cast<float>(beside) + edge.phase - place.phase);
      if (!edge.lower_bound && std::fabs(edge.offset - bound) > kOutgrown + turned * per_sector) return true;
    }
  }
  return false;
}

void hash_clusters(base::Fnv1a64& hash, ConstClusters clusters) {
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const PackedCluster& cluster = clusters[i];
    if (cluster.views == 0) continue;
    hash.u8(static_cast<std::uint8_t>(i));
    hash.u8(cluster.offset_low);
    hash.u8(cluster.offset_high);
    hash.u8(cluster.phase);
    hash.u8(cluster.sigma);
    hash.u8(cluster.views);
  }
}

void hash_outline(base::Fnv1a64& hash, const HybridCore& core, const OutlineView& outline) {
  hash.i32(core.origin.x);
  hash.i32(core.origin.y);
  hash_vec(hash, core.last_lens);
  hash.u8(core.views);
  hash.u8(core.used);
  hash.u8(core.spread);
  hash.u8(static_cast<std::uint8_t>(core.refusal));
  hash.u8(core.new_weight);
  hash.u8(core.warm_fits);
  hash.u8(core.fitting ? 1 : 0);
  hash.u8(core.large ? 1 : 0);
  if (core.refusal != HybridRefusal::kNone) return;
  for (const std::int16_t offset : outline.offsets) hash.u16(static_cast<std::uint16_t>(offset));
  for (const std::uint8_t sigma : outline.sigmas) hash.u8(sigma);
}

}  // namespace fencepost::recon
