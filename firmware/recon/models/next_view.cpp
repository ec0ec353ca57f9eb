#include "firmware/recon/models/next_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/recon/models/hybrid/node_directions.hpp"

namespace fencepost::recon {
namespace {

constexpr float kTwoPi = 2 * 3.14159265F;
/// Minimum gain in the arc, as a share of the greatest. By design.
constexpr float kGainOfArc = 0.7F;
/// Share of the gain that half the way round the object costs. By design.
constexpr float kPriceOfWay = 0.05F;
/// Weight of the gain by which another view lowers a side's sigma, beside the area that it cuts off. Next-view study,
/// seeds 8001 to 8060.
constexpr float kOfSigma = 0.1F;
/// Factor on the cube of a small angle between two tangents to a circle of radius 1. It gives the area of their corner
/// beyond the chord between the points of contact.
constexpr float kOfCorner = 0.125F;
/// Weight of the corner as the outline's sides make it; the rest is that of a round object. Next-view study.
constexpr float kOfSeen = 0.8F;
/// Turns between two tangents beyond which their corner counts as no larger.
constexpr float kWidestGap = 0.35F;

/// One tangent as it was measured: a sector's most seen edge.
struct Side {
  float place = 0;  ///< of its normal, in sectors
  Vec2 normal{1, 0};
  float length = 0;  ///< m, of the side, between those that its neighbours make
  float gain = 0;    ///< m, by which one more view lowers its sigma
};

// The sigma of n views is that of one by their root.
float gain_of(const Cluster& cluster) {
  return cluster.sigma * (1 / std::sqrt(cluster.views) - 1 / std::sqrt(cluster.views + 1));
}

// How far along the side at node k, from the foot of its normal, that at node j cuts it.
float cut_at(const OutlineView& outline, std::size_t k, std::size_t j, float most) {
  const Vec2 normal = node_direction(k, outline.offsets.size());
  const Vec2 other = node_direction(j, outline.offsets.size());
  const float sine = std::fabs(cross(normal, other));
  const float cosine = normal.dot(other);
  if (cosine < -0.5F) return most;  // behind it
  return sine > 0 ? std::min((outline.offset(j) - cosine * outline.offset(k)) / sine, most) : 0;
}

/// The sides around an object, each worked out when it is asked for: a small part's stack has no room for them all.
class SidesAround {
 public:
  SidesAround(const OutlineView& outline, ConstClusters clusters) : outline_(outline), clusters_(clusters) {
    for (std::size_t sector = 0; sector < clusters.size() / kClustersPerSector; ++sector) {
      std::size_t best = clusters.size();
      for (std::size_t i = 0; i < kClustersPerSector; ++i) {
        const std::size_t index = sector * kClustersPerSector + i;
        const Cluster cluster = unpack(clusters[index]);
        if (cluster.views <= 0 || cluster.lower_bound) continue;
        if (best == clusters.size() || clusters[index].views > clusters[best].views) best = index;
      }
      if (best != clusters.size()) chosen_[count_++] = static_cast<std::uint16_t>(best);
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Side at(std::size_t i) const {
    const std::size_t index = chosen_[i % count_];
    return {place_of(i), direction_of(clusters_, index), length_of(i), gain_of(unpack(clusters_[index]))};
  }

 private:
  [[nodiscard]] float place_of(std::size_t i) const {
    const std::size_t index = chosen_[i % count_];
    const std::size_t sector = index / kClustersPerSector;
    return static_cast<float>(sector) + unpack(clusters_[index]).phase;
  }
  // The outline's node nearest to a side's normal.
  [[nodiscard]] std::size_t node_of(std::size_t i) const {
    return static_cast<std::size_t>(place_of(i) + 0.5F) % outline_.offsets.size();
  }
  // By the fitted outline: measured offsets of neighbours are too noisy for it.
  [[nodiscard]] float length_of(std::size_t i) const {
    const float most = 1.7F * outline_.radius();  // of tangents that meet at 120 degrees
    const float back = cut_at(outline_, node_of(i), node_of(i + count_ - 1), most);
    const float ahead = cut_at(outline_, node_of(i), node_of(i + 1), most);
    return std::max(back + ahead, 0.0F);
  }

  const OutlineView& outline_;
  ConstClusters clusters_;
  std::array<std::uint16_t, kDirections> chosen_{};  // of the clusters
  std::size_t count_ = 0;
};

// Computes the gain of a tangent for each normal, in m^2 of a round object of radius 1.
void tell(const SidesAround& sides, std::size_t nodes, float radius, std::array<float, kDirections>& gain) {
  const auto whole = static_cast<float>(nodes);
  for (std::size_t i = 0; i < sides.count(); ++i) {
    const Side from = sides.at(i);
    const Side to = sides.at(i + 1);
    const float gap = to.place - from.place + (to.place <= from.place ? whole : 0.0F);
    const float angle = std::min(gap / whole, kWidestGap) * kTwoPi;
    const float round = angle * angle * angle;
    const float sine = 4 * gap < whole ? std::fabs(cross(from.normal, to.normal)) : 1.0F;
    const float seen = from.length * to.length * sine / (radius * radius);
    const float corner = kOfCorner * (round + kOfSeen * (seen - round));
    for (std::size_t k = static_cast<std::size_t>(from.place) + 1; static_cast<float>(k) <= from.place + gap; ++k) {
      const float share = (static_cast<float>(k) - from.place) / gap;
      const Side& nearer = share < 0.5F ? from : to;
      const float again = std::fabs(1 - 2 * share) * nearer.gain / radius * std::min(angle, 1.0F);
      gain[k % nodes] = 4 * share * (1 - share) * corner + kOfSigma * again;
    }
  }
}

bool is_free(const Vec2& place, std::span<const Disc> others, float clearance) {
  return std::none_of(others.begin(), others.end(), [&](const Disc& other) {
    const float reach = other.radius + clearance;
    return (place - other.center).squared_norm() < reach * reach;
  });
}

// 0 where the robot is, 1 opposite.
float way_round(std::size_t from, std::size_t to, std::size_t nodes) {
  const std::size_t steps = (to + nodes - from) % nodes;
  return static_cast<float>(2 * std::min(steps, nodes - steps)) / static_cast<float>(nodes);
}

}  // namespace

NextView next_view(const OutlineView& outline, ConstClusters clusters, const Vec2& robot, std::span<const Disc> others,
                   float clearance) {
  NextView next;
  const float radius = outline.radius();
  const SidesAround sides(outline, clusters);
  if (sides.count() < 2 || radius <= 0) return next;
  const std::size_t nodes = outline.offsets.size();
  std::array<float, kDirections> told{};
  tell(sides, nodes, radius, told);

  const float away = robot.norm();
  const float distance = std::clamp(away, kNearestView, kFarthestView);
  const std::size_t now = nearest_node(away > 0 ? Vec2(robot / away) : Vec2(1, 0), nodes);
  // A tangent's normal is a quarter turn from the view, less the angle that the radius takes up.
  const float edge_on = (0.25F - std::min(radius / distance, 1.0F) / kTwoPi) * static_cast<float>(nodes);
  const auto aside = static_cast<std::size_t>(edge_on + 0.5F);
  // 0 where the robot cannot be
  const auto gain = [&](std::size_t k) {
    if (!is_free(distance * node_direction(k, nodes), others, clearance)) return 0.0F;
    return told[(k + aside) % nodes] + told[(k + nodes - aside) % nodes];
  };
  std::size_t best = nodes;
  float best_worth = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    const float worth = gain(k) * (1 - kPriceOfWay * way_round(now, k, nodes));
    if (worth <= best_worth) continue;
    best = k;
    best_worth = worth;
  }
  next.refusal = NextViewRefusal::kBlocked;
  if (best == nodes) return next;
  const float most = gain(best);
  const auto belongs = [&](std::size_t k) { return gain(k % nodes) >= kGainOfArc * most; };
  std::size_t left = 0;
  while (left < nodes / 2 && belongs(best + left + 1)) ++left;
  std::size_t right = 0;
  while (right < nodes / 2 && belongs(best + nodes - right - 1)) ++right;
  next.refusal = NextViewRefusal::kNone;
  next.toward = node_direction(best, nodes);
  next.place = distance * next.toward;
  next.width = kTwoPi * static_cast<float>(std::min(left + right + 1, nodes)) / static_cast<float>(nodes);
  next.gain = std::min(most / (0.5F * kTwoPi), 1.0F);
  return next;
}

}  // namespace fencepost::recon
