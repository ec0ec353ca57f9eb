// Alg. 3 as the paper has it (sec. II.D): the world is solid, cells outside the fenceposts are cut away. One grid of
// cells per object. A cell goes only if it lies wholly outside a wedge's side, and never comes back.
//
// A half plane takes cells off one end of each row, so the cells of a row that remain are one run. A row is kept as the
// run's begin and end: a quarter of a bit a cell, and a cut need not touch the cells.
//
// Placement: a square, first as large as the arena around the first estimated centre. Once the clip of the same wedges
// is smaller than kRefineShare of the square, the grid is placed anew around it, with finer cells. It is then carved by
// the clip's edges, so no wedge is forgotten. The side shrinks by at least 1/kRefineMargin*kRefineShare each time and
// never below kSmallestSide, so there are at most 9 placements.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/clip.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::recon {

inline constexpr float kRefineShare = 0.6F;    ///< of the side: the clip must be smaller to be worth a new grid
inline constexpr float kRefineMargin = 1.05F;  ///< new side, as a multiple of the clip's larger extent
inline constexpr float kSmallestSide = 0.04F;  ///< m

/// A cell is kept unless it is outside by more than this (m): room for float rounding, on the safe side.
inline constexpr float kCarveGuard = 2e-6F;

/// Many rows are carved fastest in whole blocks of this many.
inline constexpr std::size_t kCarveBlock = 16;
/// Up to this many rows blocks do not pay.
inline constexpr std::size_t kManyRows = 4 * kCarveBlock;

/// Where a square grid lies: local frame, metres. `low` is the outer corner of cell (0, 0).
struct GridPlacement {
  Vec2 low{0, 0};
  float cell = 0;
};

/// The solid columns of each row: [begin, end); none where they are not in order. Passed by address: copied to the
/// stack in halves and read as a whole, it would cost as much as a cut.
struct SolidRows {
  std::span<std::int16_t> begin;
  std::span<std::int16_t> end;
};

/// Rows [begin, end).
struct RowRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Takes all cells that lie wholly outside `half_plane` out of the rows of `range`, of `columns` cells each.
void carve_half_plane(const SolidRows& rows, std::size_t columns, RowRange range, const GridPlacement& placement,
                      const HalfPlane& half_plane);

/// The same bits where rows are many, in whole blocks of kCarveBlock. The rows outside the range have to be empty in
/// the blocks in which it ends. Returns the range without the rows that are empty at either end.
RowRange carve_blocks(const SolidRows& rows, std::size_t columns, RowRange range, const GridPlacement& placement,
                      const HalfPlane& half_plane);

/// The bits of word `word` for the cells [begin, end) of a row: cell 0 is bit 0 of word 0.
std::uint32_t solid_bits(std::int16_t begin, std::int16_t end, std::size_t word);

/// N x N cells, N a multiple of 32.
template <std::size_t N>
class CarveGrid {
  static_assert(N % 32 == 0 && N > 0 && N < 0x4000);

 public:
  static constexpr std::size_t kCells = N;
  static constexpr std::size_t kWordsPerRow = N / 32;
  /// A bit a cell, row by row.
  using Words = std::array<std::uint32_t, N * kWordsPerRow>;

  /// Solid square of side 2 * kArenaHalfSide around the local origin.
  void start() {
    placements_ = 0;
    place({{-kArenaHalfSide, -kArenaHalfSide}, 2 * kArenaHalfSide / static_cast<float>(N)});
  }

  void carve(const HalfPlane& half_plane) {
    if (base::kVectors && rows_.end - rows_.begin > kManyRows) {
      rows_ = carve_blocks({begin_, end_}, N, rows_, placement_, half_plane);
    } else {
      carve_half_plane({begin_, end_}, N, rows_, placement_, half_plane);
      shrink_rows();
    }
  }

  /// Places the grid anew if the clip has become small enough to deserve finer cells.
  void refine(std::span<const Vec2> clip) {
    if (clip.size() < 3) return;
    const Bounds box = bounds_of(clip);
    const Vec2 extent = box.high - box.low;
    const float side = placement_.cell * static_cast<float>(N);
    const float wanted = std::max(kSmallestSide, kRefineMargin * std::max(extent.x(), extent.y()));
    if (!(wanted < kRefineShare * side)) return;
    const Vec2 center = 0.5F * (box.low + box.high);
    place({center - Vec2{0.5F * wanted, 0.5F * wanted}, wanted / static_cast<float>(N)});
    ++placements_;
    for (std::size_t i = 0; i < clip.size(); ++i) {
      const Vec2 edge = clip[i + 1 == clip.size() ? 0 : i + 1] - clip[i];
      const float length = edge.norm();
      if (!(length > kShallowestCut)) continue;
      const Vec2 normal = -left_of(edge) / length;
      carve({normal, normal.dot(clip[i]) + kShallowestCut});
    }
  }

  [[nodiscard]] bool solid(std::size_t column, std::size_t row) const {
    const auto at = static_cast<std::int16_t>(column);
    return begin_[row] <= at && at < end_[row];
  }
  [[nodiscard]] const GridPlacement& placement() const { return placement_; }
  [[nodiscard]] std::uint8_t placements() const { return placements_; }
  [[nodiscard]] Words words() const {
    Words words;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::size_t row = i / kWordsPerRow;
      words[i] = solid_bits(begin_[row], end_[row], i % kWordsPerRow);
    }
    return words;
  }

 private:
  void place(const GridPlacement& placement) {
    placement_ = placement;
    // A zero that compilers cannot see: a known one makes them use the processor's string instruction, whose start
    // takes longer than all rows.
    std::int32_t zero = 0;
    __asm__("" : "+r"(zero));
    begin_.fill(static_cast<std::int16_t>(zero));
    end_.fill(N);
    rows_ = {0, N};
  }

  // Carving is monotone: rows that are empty at either end need no more work.
  void shrink_rows() {
    while (rows_.begin < rows_.end && row_empty(rows_.begin)) ++rows_.begin;
    while (rows_.begin < rows_.end && row_empty(rows_.end - 1U)) --rows_.end;
  }
  [[nodiscard]] bool row_empty(std::size_t row) const { return begin_[row] >= end_[row]; }

  std::array<std::int16_t, N> begin_{};
  std::array<std::int16_t, N> end_{};
  GridPlacement placement_;
  RowRange rows_;  ///< that are not known to be empty
  std::uint8_t placements_ = 0;
};

}  // namespace fencepost::recon
