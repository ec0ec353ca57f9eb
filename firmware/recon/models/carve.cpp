#include "firmware/recon/models/carve.hpp"

#include <array>
#include <cstdint>

namespace fencepost::recon {
namespace {

// Clears columns [begin, end) of one row.
void clear_columns(std::uint32_t* row, std::size_t begin, std::size_t end) {
  for (std::size_t word = begin / 32; begin < end; ++word) {
    const std::size_t stop = std::min(end, (word + 1) * 32);
    const std::uint32_t from = 0xFFFFFFFFU << (begin % 32);
    const std::uint32_t to = stop % 32 == 0 ? 0xFFFFFFFFU : (1U << (stop % 32)) - 1U;
    row[word] &= ~(from & to);
    begin = stop;
  }
}

// |normal.x| below this: the boundary is parallel to the rows to float precision, a row goes whole or not at all.
constexpr float kParallelToRows = 1e-6F;

// A half plane over the grid, distances in cells, from the corner `low`: cell (i, j) is wholly outside if its innermost
// corner is, that is if nx (i + [nx < 0]) + ny (j + [ny < 0]) > bound.
class Boundary {
 public:
  Boundary(const HalfPlane& half_plane, const GridPlacement& placement, std::size_t columns)
      : nx_(half_plane.normal.x()),
        ny_(half_plane.normal.y()),
        bound_((half_plane.bound + kCarveGuard - half_plane.normal.dot(placement.low)) / placement.cell),
        size_(static_cast<float>(columns)),
        columns_(columns),
        outside_(nx_ > kParallelToRows    ? Side::kRight
                 : nx_ < -kParallelToRows ? Side::kLeft
                                          : Side::kRow),
        from_(ny_ < 0 ? 1 : 0) {}

  // Where what is outside begins in row j, if it is at the right, else where it ends. Rises or falls with j, never
  // both: each operation in here does, rounding included.
  [[nodiscard]] std::size_t column(std::size_t j) const {
    const float rest = bound_ - ny_ * static_cast<float>(j + from_);
    switch (outside_) {
      case Side::kRight: return rest < 0 ? 0 : first_beyond(rest / nx_);
      case Side::kLeft: return rest < 0 ? whole_before(rest / nx_) : 0;
      case Side::kRow: break;
    }
    return rest + kParallelToRows * size_ < 0 ? columns_ : 0;
  }
  void clear(std::uint32_t* row, std::size_t column) const {
    const bool at_right = outside_ == Side::kRight;
    clear_columns(row, at_right ? column : 0, at_right ? columns_ : column);
  }

 private:
  enum class Side : std::uint8_t { kLeft, kRight, kRow };

  // The first column i with i > x, in [0, columns]; x is not negative.
  [[nodiscard]] std::size_t first_beyond(float x) const {
    return x < size_ ? std::min(static_cast<std::size_t>(x) + 1, columns_) : columns_;
  }
  // How many columns i have i + 1 < x, in [0, columns].
  [[nodiscard]] std::size_t whole_before(float x) const {
    if (!(x > 1)) return 0;
    if (x > size_) return columns_;
    const auto whole = static_cast<std::size_t>(x);
    return static_cast<float>(whole) == x ? whole - 1 : whole;
  }

  float nx_;
  float ny_;
  float bound_;
  float size_;
  std::size_t columns_;
  Side outside_;
  std::size_t from_;
};

struct RowEnd {
  std::size_t row;
  std::size_t column;
};

}  // namespace

// Where two rows end in the same column, so do all between them: a division costs more than all the rest of a row, and
// few rows need one.
void carve_half_plane(std::span<std::uint32_t> words, std::size_t columns, std::size_t row_begin, std::size_t row_end,
                      const GridPlacement& placement, const HalfPlane& half_plane) {
  if (row_begin >= row_end) return;
  const Boundary boundary(half_plane, placement, columns);
  // Halves of halves: no grid has 2^16 rows. Written before they are read.
  std::array<RowEnd, 16> ahead;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::size_t waiting = 1;
  RowEnd from{row_begin, boundary.column(row_begin)};
  ahead[0] = {row_end - 1, boundary.column(row_end - 1)};
  for (;;) {
    const RowEnd to = ahead[waiting - 1];
    if (from.column != to.column && to.row - from.row > 1) {
      const std::size_t middle = from.row + (to.row - from.row) / 2;
      ahead[waiting++] = {middle, boundary.column(middle)};
      continue;
    }
    for (; from.row < to.row; ++from.row) boundary.clear(words.data() + from.row * (columns / 32), from.column);
    from = to;
    if (--waiting == 0) break;
  }
  boundary.clear(words.data() + from.row * (columns / 32), from.column);
}

}  // namespace fencepost::recon
