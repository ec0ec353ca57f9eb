// Alg. 3 without cells (paper sec. II.D, the limit of an infinitely fine grid). The exact intersection of all wedges is
// convex, so it is one convex polygon, clipped by one half plane at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/geometry.hpp"

namespace fencepost::recon {

/// Cuts shallower than this are not made (m): they would only breed slivers. The polygon stays on the safe side.
inline constexpr float kShallowestCut = 1e-6F;

/// Half the side of the square in which every model of an object lives, around its first estimated centre. m.
inline constexpr float kArenaHalfSide = 2.0F;

/// Maximum number of vertices of a polygon for clip_convex.
inline constexpr std::size_t kMaxVertices = 256;

struct Bounds {
  Vec2 low{0, 0};
  Vec2 high{0, 0};
};

/// Removes what lies outside `half_plane` from the convex counter-clockwise polygon in vertices[0..size). Returns the
/// new size (0: nothing is left). If the result does not fit into the span, it first removes the edge that moves the
/// outline least. The polygon grows by that and never loses a point that it should hold.
std::size_t clip_convex(std::span<Vec2> vertices, std::size_t size, const HalfPlane& half_plane);

/// Bounding box of vertices; zero for none.
Bounds bounds_of(std::span<const Vec2> vertices);

/// A convex polygon of at most N vertices, local frame, metres, counter-clockwise.
template <std::size_t N>
class ConvexClip {
  static_assert(N >= 8 && N <= kMaxVertices);

 public:
  /// The full square around the local origin.
  void start() {
    constexpr float h = kArenaHalfSide;
    vertices_[0] = {-h, -h};
    vertices_[1] = {h, -h};
    vertices_[2] = {h, h};
    vertices_[3] = {-h, h};
    size_ = 4;
  }
  void cut(const HalfPlane& half_plane) {
    size_ = static_cast<std::uint16_t>(clip_convex(vertices_, size_, half_plane));
  }
  /// Empty: never started, or contradictory wedges have carved everything away.
  [[nodiscard]] std::span<const Vec2> vertices() const { return {vertices_.data(), size_}; }

 private:
  std::array<Vec2, N> vertices_;
  std::uint16_t size_ = 0;
};

}  // namespace fencepost::recon
