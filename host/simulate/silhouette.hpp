// One solid alone in an image without pitch and distortion, column by column: no pixel is touched.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/simulate/optics.hpp"
#include "host/simulate/pixel_box.hpp"
#include "host/simulate/prism.hpp"

namespace fencepost::host {

/// Pixels of one column in which the ray meets the solid: one run of rows, none when first > last. Above the wall is
/// the lid, below it the underside.
struct ColumnRun {
  int first = 0;
  int wall_begin = 0;
  int wall_end = 0;
  int last = -1;
  double nearest = 0;  ///< distance ahead of the nearest of them, m
  [[nodiscard]] bool empty() const { return first > last; }
};

/// Reused from frame to frame.
class Silhouette {
 public:
  /// Cost: about 10 ns an edge of the footprint and 20 ns a column, whatever the rows.
  void find(const Prism& prism, const PixelRays& rays);

  /// It is one connected piece, and no ray meets the solid twice: `box` and `columns` are complete.
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] const PixelBox& box() const { return box_; }
  /// Runs of the box, from its first column to its last; only if `whole`.
  [[nodiscard]] const std::vector<ColumnRun>& columns() const { return columns_; }
  [[nodiscard]] bool covers(int u, int v) const;
  /// No pixel outside of it shows the solid, whole or not. Empty: nothing does.
  [[nodiscard]] const PixelBox& bounds() const { return bounds_; }
  /// Stretches of the ray through that column of the bounds, nearest first.
  [[nodiscard]] std::span<const Stretch> stretches(int u) const {
    const std::size_t begin = stretch_begin_[static_cast<std::size_t>(u - bounds_.x1)];
    return std::span(stretches_).subspan(begin, stretch_begin_[static_cast<std::size_t>(u - bounds_.x1) + 1] - begin);
  }

 private:
  struct Crossing {
    int column = 0;
    double distance = 0;
  };
  void bound(const Prism& prism, const PixelRays& rays);
  void find_stretches(const Prism& prism, const PixelRays& rays);
  ColumnRun run_of(const Prism& prism, const PixelRays& rays, const Stretch& stretch);
  void add(int u, const ColumnRun& run);

  bool whole_ = false;
  PixelBox box_;
  PixelBox bounds_;
  std::vector<ColumnRun> columns_;
  std::vector<Crossing> crossings_;
  std::vector<Stretch> stretches_;
  std::vector<std::size_t> stretch_begin_;  ///< of each column of the bounds, and one more
  int wall_begin_ = 0;                      ///< of the last column: in the next it is not far from there
  int wall_end_ = 0;
};

}  // namespace fencepost::host
