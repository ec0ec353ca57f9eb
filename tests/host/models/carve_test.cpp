// The grid against the plain rule, row by row and cell by cell, in the same floats.
#include "host/models/carve.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace fencepost::test {
namespace {

using namespace recon;

float uniform(std::mt19937& random, float low, float high) {
  return low + (high - low) * static_cast<float>(random() >> 8U) * 0x1p-24F;
}

/// A cell goes if its innermost corner is outside.
class PlainGrid {
 public:
  explicit PlainGrid(std::size_t columns) : columns_(columns), solid_(columns * columns, 1) {}

  void carve(const GridPlacement& placement, const HalfPlane& half_plane) {
    const float nx = half_plane.normal.x();
    const float ny = half_plane.normal.y();
    const float bound = (half_plane.bound + kCarveGuard - half_plane.normal.dot(placement.low)) / placement.cell;
    for (std::size_t row = 0; row < columns_; ++row) {
      const float rest = bound - ny * (static_cast<float>(row) + (ny < 0 ? 1.0F : 0.0F));
      for (std::size_t column = 0; column < columns_; ++column) {
        if (outside(nx, rest, static_cast<float>(column))) solid_[row * columns_ + column] = 0;
      }
    }
  }
  [[nodiscard]] bool solid(std::size_t column, std::size_t row) const { return solid_[row * columns_ + column] != 0; }

 private:
  [[nodiscard]] bool outside(float nx, float rest, float column) const {
    constexpr float kParallelToRows = 1e-6F;
    if (nx > kParallelToRows) return column > rest / nx;
    if (nx < -kParallelToRows) return column + 1 < rest / nx;
    return rest + kParallelToRows * static_cast<float>(columns_) < 0;
  }

  std::size_t columns_;
  std::vector<char> solid_;
};

HalfPlane any_half_plane(std::mt19937& random, float reach) {
  float angle = uniform(random, -3.15F, 3.15F);
  const auto kind = random() % 8;
  // Nearly parallel to the axes is where rounding decides.
  if (kind < 3)
    angle = 1.57079633F * static_cast<float>(random() % 4) + uniform(random, -2, 2) * (kind == 0 ? 1e-6F : 1e-2F);
  const Vec2 normal{std::cos(angle), std::sin(angle)};
  return {normal, uniform(random, -0.1F, 1.5F) * reach * (random() % 50 == 0 ? 1e4F : 1.0F)};
}

template <std::size_t N>
void expect_plain(std::mt19937& random) {
  const auto grid = std::make_unique<CarveGrid<N>>();
  grid->start();
  PlainGrid plain(N);
  for (int cut = 0; cut < 24; ++cut) {
    const HalfPlane half_plane = any_half_plane(random, kArenaHalfSide);
    grid->carve(half_plane);
    plain.carve(grid->placement(), half_plane);
    for (std::size_t row = 0; row < N; ++row) {
      for (std::size_t column = 0; column < N; ++column) {
        ASSERT_EQ(grid->solid(column, row), plain.solid(column, row))
            << cut << ": " << half_plane.normal.x() << " " << half_plane.normal.y() << " " << half_plane.bound << " at "
            << column << " " << row;
      }
    }
  }
}

TEST(CarveGrid, IsWhatThePlainRuleLeaves) {
  std::mt19937 random(51);
  for (int i = 0; i < 150; ++i) {
    expect_plain<64>(random);
    expect_plain<128>(random);
  }
}

// Only the rows that were asked for, in whole blocks; and it says which of them are left.
TEST(CarveBlocks, LeavesOtherRowsAlone) {
  std::mt19937 random(52);
  constexpr std::size_t kColumns = 128;
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::int16_t> begin(kColumns, 0);
    std::vector<std::int16_t> end(kColumns, kColumns);
    const std::size_t first = random() % (kColumns / kCarveBlock) * kCarveBlock;
    const std::size_t last = first + random() % ((kColumns - first) / kCarveBlock + 1) * kCarveBlock;
    const GridPlacement placement{{-2, -2}, 4.0F / static_cast<float>(kColumns)};
    const HalfPlane half_plane = any_half_plane(random, kArenaHalfSide);
    const RowRange left = carve_blocks({begin, end}, kColumns, {first, last}, placement, half_plane);
    ASSERT_LE(left.begin, left.end) << "rows from the end of the range on were not asked for";
    PlainGrid plain(kColumns);
    plain.carve(placement, half_plane);
    for (std::size_t row = 0; row < kColumns; ++row) {
      const bool asked = row >= first && row < last;
      for (std::size_t column = 0; column < kColumns; ++column) {
        const auto at = static_cast<std::int16_t>(column);
        const bool solid = begin[row] <= at && at < end[row];
        ASSERT_EQ(solid, !asked || plain.solid(column, row)) << i << " " << row;
        ASSERT_FALSE(asked && solid && (row < left.begin || row >= left.end)) << i << " " << row;
      }
    }
  }
}

// Through cells' corners, exactly or almost: whole numbers cannot tell, and leave it to the plain form.
TEST(CarveBlocks, CutAsTheLineDoesWhereItPassesCorners) {
  std::mt19937 random(53);
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t columns = std::array<std::size_t, 3>{80, 128, 512}[random() % 3];
    const GridPlacement placement{{-2, -2}, uniform(random, 0.04F, 4) / static_cast<float>(columns)};
    const Vec2 along{static_cast<float>(random() % 41) - 20, static_cast<float>(random() % 41) - 20.5F};
    const Vec2 normal = along.normalized();
    const float off = random() % 2 == 0 ? 0 : uniform(random, -1, 1) * 1e-4F;
    const Vec2 corner{static_cast<float>(random() % columns) + off, static_cast<float>(random() % columns)};
    const HalfPlane half_plane{normal, normal.dot(placement.low + placement.cell * corner) - kCarveGuard};
    std::vector<std::int16_t> begin(columns, 0), end(columns, static_cast<std::int16_t>(columns));
    std::vector<std::int16_t> plain_begin = begin, plain_end = end;
    carve_blocks({begin, end}, columns, {0, columns}, placement, half_plane);
    carve_half_plane({plain_begin, plain_end}, columns, {0, columns}, placement, half_plane);
    for (std::size_t row = 0; row < columns; ++row) {
      for (std::size_t word = 0; word < columns / 32; ++word) {
        ASSERT_EQ(solid_bits(begin[row], end[row], word), solid_bits(plain_begin[row], plain_end[row], word))
            << i << " " << row;
      }
    }
  }
}

}  // namespace
}  // namespace fencepost::test
