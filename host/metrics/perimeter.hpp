// Parts of a footprint's perimeter, and the part that a set of images shows (paper sec. III, "Not all images are
// equal").
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// From `begin` to `end` along an edge; 0 is its first vertex, 1 its second.
struct Stretch01 {
  double begin = 0;
  double end = 0;
};

/// Part of the outer ring of one footprint. Holes are left out: they are invisible from outside.
class PerimeterPart {
 public:
  PerimeterPart() = default;
  /// Nothing of this outline.
  explicit PerimeterPart(const LinearRing& outline);

  /// Adds a stretch of edge number `edge` (from vertex `edge` to the next one).
  void add(std::size_t edge, Stretch01 stretch);
  /// Both must be of one outline.
  void add(const PerimeterPart& other);

  [[nodiscard]] double length() const;  ///< m
  [[nodiscard]] double whole() const;   ///< m, of the whole perimeter
  /// length / whole; 0 for an outline without length.
  [[nodiscard]] double share() const;
  /// Metres that this part and the other one, of the same outline, have in common.
  [[nodiscard]] double common_length(const PerimeterPart& other) const;
  /// Disjoint and ascending, one list an edge.
  [[nodiscard]] const std::vector<std::vector<Stretch01>>& stretches() const { return stretches_; }

 private:
  std::vector<double> edge_lengths_;
  std::vector<std::vector<Stretch01>> stretches_;
};

/// The images used so far, for one object.
class ViewSet {
 public:
  explicit ViewSet(const LinearRing& outline) : seen_(outline) {}

  /// Novelty: of the part of the perimeter that this image shows, the share that no image of the set shows; empty if it
  /// shows none.
  [[nodiscard]] std::optional<double> novelty(const PerimeterPart& image) const;
  void add(const PerimeterPart& image) { seen_.add(image); }
  /// Thoroughness: share of the perimeter that at least one image of the set shows.
  [[nodiscard]] double thoroughness() const { return seen_.share(); }
  [[nodiscard]] const PerimeterPart& seen() const { return seen_; }

 private:
  PerimeterPart seen_;
};

}  // namespace fencepost::host
