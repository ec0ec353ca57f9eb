#include "firmware/recon/models/clip.hpp"

#include <algorithm>
#include <cstring>

#include "hal/base/vectors.hpp"

namespace fencepost::recon {
namespace {

float outside_by(const HalfPlane& half_plane, const Vec2& point) {
  return half_plane.normal.dot(point) - half_plane.bound;
}

std::size_t next(std::size_t i, std::size_t size) { return i + 1 == size ? 0 : i + 1; }
std::size_t previous(std::size_t i, std::size_t size) { return i == 0 ? size - 1 : i - 1; }

Vec2 crossing(const Vec2& inside, float d_inside, const Vec2& outside, float d_outside) {
  // d_inside <= 0 < d_outside: the share of the way from inside to outside is in [0, 1).
  const float share = d_inside / (d_inside - d_outside);
  return inside + share * (outside - inside);
}

// Computes the apex that replaces edge i when it is removed: the meeting point of its neighbours. `moved`: the square
// of the distance by which the outline moves there. False if the neighbours do not meet outside.
bool apex_over_edge(std::span<const Vec2> v, std::size_t size, std::size_t i, Vec2& apex, float& moved) {
  const Vec2& a = v[i];
  const Vec2& b = v[next(i, size)];
  const float length_squared = (b - a).squared_norm();
  if (length_squared < kShallowestCut * kShallowestCut) {  // both ends are one point
    apex = a;
    moved = 0;
    return true;
  }
  const Vec2 along_previous = a - v[previous(i, size)];
  const Vec2 along_next = v[next(next(i, size), size)] - b;
  const float turn = cross(along_previous, along_next);
  if (!(turn > 0)) return false;  // together the neighbours turn by half a circle or more: they never meet
  const float share = cross(b - a, along_next) / turn;
  apex = a + share * along_previous;
  const float height_times_base = cross(b - a, apex - a);
  moved = height_times_base * height_times_base / length_squared;
  return share >= 0;
}

// Gives up the edge that moves the outline least: least area would leave needles between nearly parallel sides. Returns
// the new size; unchanged if no edge can go.
std::size_t simplify(std::span<Vec2> v, std::size_t size) {
  std::size_t best = size;
  Vec2 best_apex{0, 0};
  float best_moved = 0;
  for (std::size_t i = 0; i < size; ++i) {
    Vec2 apex{0, 0};
    float moved = 0;
    if (!apex_over_edge(v, size, i, apex, moved)) continue;
    if (best == size || moved < best_moved) {
      best = i;
      best_apex = apex;
      best_moved = moved;
    }
  }
  if (best == size) return size;
  v[best] = best_apex;
  for (std::size_t i = next(best, size); i + 1 < size && i != 0; ++i) v[i] = v[i + 1];
  if (best + 1 == size) {  // the edge from the last vertex to the first: the first one goes
    for (std::size_t i = 0; i + 1 < size; ++i) v[i] = v[i + 1];
  }
  return size - 1;
}

// Drops vertex i if it is the same point as vertex j to within a shallowest cut.
std::size_t merge(std::span<Vec2> v, std::size_t size, std::size_t i, std::size_t j) {
  if (size <= 3 || (v[i] - v[j]).max_norm() > kShallowestCut) return size;
  for (std::size_t k = i; k + 1 < size; ++k) v[k] = v[k + 1];
  return size - 1;
}

// The two vertices that a cut made are at `at` and `at + 1`: a cut through a corner would double it.
std::size_t merge_new(std::span<Vec2> v, std::size_t size, std::size_t at) {
  const std::size_t smaller = merge(v, size, at + 1, next(at + 1, size));
  return merge(v, smaller, at, previous(at, smaller));
}

// The vertices that remain inside a half plane: the run from first_in to last_in around the innermost one. Rounding may
// put a vertex of an almost straight chain on the wrong side, so only the run around the innermost vertex is trusted.
struct Cut {
  bool any_outside = false;
  bool any_inside = false;
  std::size_t first_in = 0;
  std::size_t last_in = 0;
  std::size_t kept = 0;
};

/// A bit a vertex, for more of them than any profile has.
class Flags {
 public:
  void set(std::size_t i) { words_[i / 32] |= 1U << (i % 32); }
  [[nodiscard]] bool operator[](std::size_t i) const { return (words_[i / 32] >> (i % 32) & 1U) != 0; }

 private:
  std::array<std::uint32_t, kMaxVertices / 32> words_{};
};

Cut careful_cut(std::span<const Vec2> v, std::size_t size, const HalfPlane& half_plane) {
  Flags is_outside;
  Cut cut;
  std::size_t innermost = 0;
  float lowest = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const float d = outside_by(half_plane, v[i]);
    if (d > kShallowestCut) {
      is_outside.set(i);
      cut.any_outside = true;
    }
    if (i == 0 || d < lowest) {
      innermost = i;
      lowest = d;
    }
  }
  cut.any_inside = !is_outside[innermost];
  if (!cut.any_outside || !cut.any_inside) return cut;
  cut.first_in = cut.last_in = innermost;
  cut.kept = 1;
  for (; !is_outside[next(cut.last_in, size)]; ++cut.kept) cut.last_in = next(cut.last_in, size);
  for (; !is_outside[previous(cut.first_in, size)]; ++cut.kept) cut.first_in = previous(cut.first_in, size);
  return cut;
}

// The same for the usual case, on processors with vectors and room for all distances. There the vertices outside are
// one run, and the others are the run around the innermost one.
[[maybe_unused]] Cut quick_cut(std::span<const Vec2> v, std::size_t size, const HalfPlane& half_plane) {
  std::array<float, kMaxVertices> d;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  unsigned outside = 0;
  for (std::size_t i = 0; i < size; ++i) {
    d[i] = outside_by(half_plane, v[i]);
    outside += d[i] > kShallowestCut ? 1U : 0U;
  }
  Cut cut;
  cut.any_outside = outside != 0;
  cut.any_inside = outside != size;
  if (!cut.any_outside || !cut.any_inside) return cut;
  const auto is_outside = [&](std::size_t i) { return d[i] > kShallowestCut; };
  std::size_t first_out = 0;
  while (!is_outside(first_out)) ++first_out;
  std::size_t past_out = first_out + 1;
  while (past_out < size && is_outside(past_out)) ++past_out;
  std::size_t found = past_out - first_out;
  if (first_out == 0) {  // it may begin before the first vertex
    for (; is_outside(previous(first_out, size)); ++found) first_out = previous(first_out, size);
  }
  if (found != outside) return careful_cut(v, size, half_plane);
  cut.first_in = past_out == size ? 0 : past_out;
  cut.last_in = previous(first_out, size);
  cut.kept = size - found;
  return cut;
}

Cut find_cut(std::span<const Vec2> v, std::size_t size, const HalfPlane& half_plane) {
  if constexpr (base::kVectors) return quick_cut(v, size, half_plane);
  return careful_cut(v, size, half_plane);
}

// Moves `count` vertices, which may overlap.
void move_vertices(std::span<Vec2> v, std::size_t to, std::size_t from, std::size_t count) {
  if constexpr (base::kVectors) {
    // NOLINTNEXTLINE(bugprone-undefined-memory-manipulation): two floats, whatever their class says
    std::memmove(static_cast<void*>(&v[to]), &v[from], count * sizeof(Vec2));
  } else if (to <= from) {
    for (std::size_t i = 0; i < count; ++i) v[to + i] = v[from + i];
  } else {
    for (std::size_t i = count; i-- > 0;) v[to + i] = v[from + i];
  }
}

}  // namespace

std::size_t clip_convex(std::span<Vec2> v, std::size_t size, const HalfPlane& half_plane) {
  if (size < 3) return 0;
  Cut cut = find_cut(v, size, half_plane);
  if (!cut.any_outside) return size;
  if (!cut.any_inside) return 0;
  if (cut.kept + 2 > v.size()) {
    const std::size_t smaller = simplify(v, size);
    if (smaller == size) return size;  // nothing can go: the cut is not made
    size = smaller;
    cut = find_cut(v, size, half_plane);
    if (!cut.any_outside || cut.kept + 2 > v.size()) return size;
  }
  const std::size_t first_in = cut.first_in;
  const std::size_t last_in = cut.last_in;
  const std::size_t first_out = next(last_in, size);
  const std::size_t last_out = previous(first_in, size);
  const auto side = [&](std::size_t i) { return outside_by(half_plane, v[i]); };
  const auto at_most_zero = [](float d) { return d < 0 ? d : 0.0F; };
  const Vec2 leaving = crossing(v[last_in], at_most_zero(side(last_in)), v[first_out], side(first_out));
  const Vec2 entering = crossing(v[first_in], at_most_zero(side(first_in)), v[last_out], side(last_out));
  if (last_in < first_in) {
    // the kept run goes over the end: inside 0..last_in, outside first_out..last_out, inside first_in..
    const std::size_t tail = size - first_in;
    const std::size_t to = first_out + 2;
    move_vertices(v, to, first_in, tail);
    v[first_out] = leaving;
    v[first_out + 1] = entering;
    return merge_new(v, to + tail, first_out);
  }
  move_vertices(v, 0, first_in, cut.kept);
  v[cut.kept] = leaving;
  v[cut.kept + 1] = entering;
  return merge_new(v, cut.kept + 2, cut.kept);
}

Bounds bounds_of(std::span<const Vec2> vertices) {
  if (vertices.empty()) return {};
  Bounds bounds{vertices[0], vertices[0]};
  const auto take = [&](const Vec2& v) {
    bounds.low = {std::min(bounds.low.x(), v.x()), std::min(bounds.low.y(), v.y())};
    bounds.high = {std::max(bounds.high.x(), v.x()), std::max(bounds.high.y(), v.y())};
  };
  if constexpr (base::kVectors) {
    // Two vertices at a time, and twice that; the order is nothing to minima.
    using Two = float __attribute__((vector_size(2 * sizeof(Vec2))));
    constexpr std::size_t kMany = 4;
    const std::size_t whole = vertices.size() / kMany * kMany;
    if (whole > 0) {
      const Vec2* at = vertices.data();
      Two low;
      std::memcpy(&low, at, sizeof low);
      Two high = low;
      Two other_low = low;
      Two other_high = low;
      for (std::size_t i = 0; i < whole; i += kMany) {
        Two one;
        Two other;
        std::memcpy(&one, at + i, sizeof one);
        std::memcpy(&other, at + i + 2, sizeof other);
        low = one < low ? one : low;
        high = one > high ? one : high;
        other_low = other < other_low ? other : other_low;
        other_high = other > other_high ? other : other_high;
      }
      low = other_low < low ? other_low : low;
      high = other_high > high ? other_high : high;
      take({low[0], low[1]});
      take({low[2], low[3]});
      take({high[0], high[1]});
      take({high[2], high[3]});
      vertices = vertices.subspan(whole);
    }
  }
  for (const Vec2& v : vertices) take(v);
  return bounds;
}

}  // namespace fencepost::recon
