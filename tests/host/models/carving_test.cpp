// Alg. 3 as one model: what it does with tangents before and after its object has a place.
#include "host/models/carving.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "firmware/recon/models/model_list.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

using Carving = recon::Carving<64, 96, 4>;
static_assert(recon::Model<Carving>);

constexpr recon::MapPoint kOrigin{0, 0};
const recon::MeasurementNoise kNoise;

void add(Carving& carving, const recon::Sighting& seen, recon::MapPoint origin = kOrigin) {
  carving.add({seen, origin, 1, kNoise});
}

/// From (-1, 0) along x, edges 0.1 rad to both sides: at x = 0 they are at y = +-tan(0.1) = +-0.1003.
recon::Sighting ahead() { return view_between({-1, 0}, -0.1, 0.1).sighting; }

/// The polygon's reach in direction `normal`, m.
float reach(const Carving& carving, const recon::Vec2& normal) {
  float most = -9;
  for (const recon::Vec2& v : carving.clip().vertices()) most = std::max(most, normal.dot(v));
  return most;
}
std::size_t solid_cells(const Carving& carving) {
  std::size_t count = 0;
  for (const std::uint32_t word : carving.grid().words()) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

TEST(Carving, BothEdgesCutThePolygonAndTheGrid) {
  Carving carving;
  carving.start(ahead(), kOrigin);
  const std::size_t whole = solid_cells(carving);
  EXPECT_EQ(reach(carving, {0, 1}), recon::kArenaHalfSide);
  add(carving, ahead());
  // The wedge meets the far side, x = 2, at y = +-3 tan(0.1).
  EXPECT_NEAR(reach(carving, {0, 1}), 3 * std::tan(0.1), 1e-5);
  EXPECT_NEAR(reach(carving, {0, -1}), 3 * std::tan(0.1), 1e-5);
  EXPECT_LT(solid_cells(carving), whole / 4);
}

TEST(Carving, ALowerBoundAndANeighboursEdgeCutNothing) {
  for (const recon::End end : {recon::End::kLowerBound, recon::End::kOccluded}) {
    recon::Sighting seen = ahead();
    seen.left.end = end;
    Carving carving;
    carving.start(seen, kOrigin);
    add(carving, seen);
    EXPECT_EQ(reach(carving, {0, 1}), recon::kArenaHalfSide);
    EXPECT_NEAR(reach(carving, {0, -1}), 3 * std::tan(0.1), 1e-5);
  }
}

TEST(Carving, TangentsThatCameBeforeThePlaceCutAroundIt) {
  const recon::Vec2 shift{0.3F, -0.2F};
  const recon::Sighting across = view_between({0, -1}, 1.5, 1.7).sighting;
  Carving early;
  early.start(ahead(), kOrigin);
  add(early, ahead());
  add(early, across);
  early.move_origin(shift);
  Carving late;
  late.start(ahead(), kOrigin);
  late.move_origin(shift);
  add(late, ahead(), recon::moved(kOrigin, shift));
  add(late, across, recon::moved(kOrigin, shift));
  ASSERT_GT(late.clip().vertices().size(), 3U);
  for (const recon::Vec2& normal : {unit(0), unit(1), unit(2), unit(3), unit(4), unit(5)}) {
    EXPECT_NEAR(reach(early, normal), reach(late, normal), 1e-5F);
  }
}

// Cuts that were made around the first place are not kept: around a second one the world is solid.
TEST(Carving, AnotherPlaceIsSolidAgain) {
  Carving carving;
  carving.start(ahead(), kOrigin);
  carving.move_origin({0, 0});
  add(carving, ahead());
  carving.move_origin({1, 0});
  EXPECT_EQ(reach(carving, {0, 1}), recon::kArenaHalfSide);
}

// If there are more tangents than it has room for, it forgets the oldest, which never cuts too much.
TEST(Carving, ForgetsTheOldestWaitingTangents) {
  Carving carving;  // room for four
  carving.start(ahead(), kOrigin);
  add(carving, ahead());
  add(carving, view_between({0, -1}, 1.5, 1.7).sighting);
  add(carving, view_between({0, 1}, -1.7, -1.5).sighting);
  carving.move_origin({0, 0});
  // The first view's would end it at y = 3 tan(0.1) = 0.3; the third lens stands at y = 1.
  EXPECT_NEAR(reach(carving, {0, 1}), 1, 1e-5F) << "the first view's are gone";
  EXPECT_LT(reach(carving, {1, 0}), 0.4F) << "the others are not";
}

}  // namespace
}  // namespace fencepost::test
