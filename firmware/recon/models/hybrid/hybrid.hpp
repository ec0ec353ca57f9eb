// The stored outline of an object: tangents by direction, and the outline fitted last with its uncertainty.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/recon/models/clip.hpp"
#include "firmware/recon/models/hybrid/sector_store.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

/// Why there is no outline.
enum class HybridRefusal : std::uint8_t {
  kNone,
  kNoTangents,      ///< nothing but censored ends so far, or the first fit is still under way
  kIllConditioned,  ///< the tangents leave the equations without a solution in floats
  kEmpty,           ///< the half planes of the outline have nothing in common
};

constexpr std::string_view name(HybridRefusal refusal) {
  switch (refusal) {
    case HybridRefusal::kNone: return "";
    case HybridRefusal::kNoTangents: return "no tangent has been fitted yet";
    case HybridRefusal::kIllConditioned: return "the tangents are ill-conditioned";
    case HybridRefusal::kEmpty: return "contradictory tangents leave nothing";
  }
  return "";
}

/// The part of the state that does not depend on the number of sectors.
struct HybridCore {
  MapPoint origin;          ///< of the local frame: within kRecentre of the outline's middle when it was fitted last
  Vec2 last_lens{0, 0};     ///< local: where the tangents were last taken from
  std::uint8_t views = 0;   ///< with new information, counted to 255
  std::uint8_t used = 0;    ///< ViewTangents::Which that were taken from there; lower bounds are higher by kBits
  std::uint8_t spread = 0;  ///< encode_sigma() of how much larger residuals are than sigmas say, m/m
  HybridRefusal refusal = HybridRefusal::kNoTangents;
  std::uint8_t new_weight = 0;  ///< weight of the views that no fit has begun with, in 1 / kWholeView; 0: none
  std::uint8_t warm_fits = 0;   ///< begun from the outline, since the last one that began from nothing
  bool fitting = false;         ///< a solver works on it
  bool known_well : 1 = false;  ///< OutlineView::known_well() of the outline fitted last: alerts ask in every frame
  bool large : 1 = false;       ///< likewise: it may be longer than the image, and sides of it a guess
};

/// The interval of a line inside an outline, low to high; empty if the line passes by.
struct Chord {
  float low = 0;
  float high = 0;
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

/// The fitted outline: support values and their sigmas at directions all around. Local frame of HybridCore::origin.
struct OutlineView {
  std::span<const std::int16_t> offsets;  ///< kOffsetStep
  std::span<const std::uint8_t> sigmas;   ///< encode_sigma()

  [[nodiscard]] float offset(std::size_t k) const { return static_cast<float>(offsets[k]) * kOffsetStep; }
  [[nodiscard]] float sigma(std::size_t k) const { return decode_sigma(sigmas[k]); }
  /// The next node around the circle.
  [[nodiscard]] std::size_t after(std::size_t k) const { return k + 1 < offsets.size() ? k + 1 : 0; }
  /// Mean support value, m.
  [[nodiscard]] float radius() const;
  [[nodiscard]] float mean_sigma() const;
  /// h'(direction), m/rad.
  [[nodiscard]] float slope(const SectorPlace& place) const;
  /// In [0, 1]: the expected R + P above that of the hull is about 1.05 (1 - confidence).
  [[nodiscard]] float confidence() const;
  /// True if the outline is known well enough to draw and measure by; otherwise inflation() moves it out.
  [[nodiscard]] bool known_well() const { return mean_sigma() < kWellKnownShare * radius(); }
  /// Where side k and the next one meet.
  [[nodiscard]] Vec2 corner(std::size_t k) const;
  /// The y of its points with this x, m; uncertainty left out.
  [[nodiscard]] Chord chord_at(float x) const;
  /// Distance (m) from a point to the outline, uncertainty left out; negative inside. Low by at most 0.2 % of the
  /// distance to the nearest corner.
  [[nodiscard]] float distance_from(const Vec2& point, std::size_t& nearest) const;
};

/// An outline and where it is.
struct PlacedOutline {
  OutlineView view;
  MapPoint origin;     ///< of its local frame
  bool known = false;  ///< well
};

/// How far the outline is moved out (negative: in), in sigmas, where a sigma is `share` of the radius: near the least
/// expected R + P. A circle whose place is normal to sigma along a line is best drawn sigma^2 / r larger there.
float inflation(float share);

/// The outline as a polygon: all its half planes, moved out by inflation() and `more` sigmas. Local frame, metres,
/// counter-clockwise; returns the number of vertices, 0 if nothing is left. `vertices` has room for kOutlineVertices.
std::size_t outline_polygon(const OutlineView& outline, float more, std::span<Vec2> vertices);
inline constexpr std::size_t kOutlineVertices = 72;

void hash_clusters(base::Fnv1a64& hash, ConstClusters clusters);
void hash_outline(base::Fnv1a64& hash, const HybridCore& core, const OutlineView& outline);

/// True if edges seen before contradict an end that is seen from `lens` (local frame), with a tangent of this normal.
/// False also where there were none.
bool edges_contradict(ConstClusters clusters, const OutlineView& outline, const Vec2& lens, const Vec2& normal);

/// kSectors: 64, or 32 on the smallest parts.
template <std::size_t kSectors>
struct Hybrid : HybridCore {
  std::array<PackedCluster, kClustersPerSector * kSectors> clusters{};
  std::array<std::int16_t, kSectors> offsets{};
  std::array<std::uint8_t, kSectors> sigmas{};

  static constexpr std::string_view kName = "hybrid";
  static constexpr std::size_t kHashParts = 2;

  /// Empty; the first guess of the middle is where `first` sees it.
  void begin(const Sighting& first);
  void start(const Sighting& first, MapPoint /*origin*/) { begin(first); }
  /// Adds the tangents of one view. A stationary robot that sees the same again changes nothing.
  void add(const Sighting& sighting, const MeasurementNoise& noise);
  void add(const ModelView& view) { add(view.sighting, view.noise); }
  /// It has an origin of its own, which follows the outline.
  void move_origin(const Vec2& /*shift*/) {}
  void shift(const Vec2& step) { origin = moved(origin, step); }
  void hash(base::Fnv1a64& hash, std::size_t part) const {
    if (part == 0) return hash_clusters(hash, clusters);
    hash_outline(hash, *this, outline());
  }

  [[nodiscard]] bool ok() const { return refusal == HybridRefusal::kNone; }
  [[nodiscard]] bool edges_contradict(const Vec2& lens, const Vec2& normal) const {
    return recon::edges_contradict(clusters, outline(), lens, normal);
  }
  [[nodiscard]] OutlineView outline() const { return {offsets, sigmas}; }
};

static_assert(sizeof(Hybrid<64>) <= 1200);
static_assert(sizeof(Hybrid<32>) <= 512);

/// First guess of the middle: by the foot, else by the width of a typical object. Local frame at the sighting's anchor.
Vec2 guessed_middle(const Sighting& first);

/// The three steps of Hybrid::add(), whatever the number of sectors.
void add_view(HybridCore& core, Clusters clusters, const OutlineView& outline, const Sighting& sighting,
              const MeasurementNoise& noise);

template <std::size_t kSectors>
void Hybrid<kSectors>::begin(const Sighting& first) {
  static_cast<HybridCore&>(*this) = {};
  origin = moved(first.anchor, guessed_middle(first));
  clusters.fill({});
}

template <std::size_t kSectors>
void Hybrid<kSectors>::add(const Sighting& sighting, const MeasurementNoise& noise) {
  add_view(*this, clusters, outline(), sighting, noise);
}

}  // namespace fencepost::recon
