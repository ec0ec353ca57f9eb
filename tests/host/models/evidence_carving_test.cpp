// Carving with and without cuts that the hybrid contradicts.
#include "host/models/evidence_carving.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/models/model_list.hpp"
#include "host/geometry/planar.hpp"
#include "host/models/carving.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

using Hybrid = recon::Hybrid<64>;
static_assert(recon::Model<host::KeptTangents>);

constexpr recon::MapPoint kOrigin{0, 0};
const recon::MeasurementNoise kNoise;
const host::LinearRing kBox{{-0.1, -0.06}, {0.1, -0.06}, {0.1, 0.06}, {-0.1, 0.06}};

double area_of(std::span<const recon::Vec2> vertices) {
  host::Polygon polygon;
  for (const recon::Vec2& v : vertices) {
    polygon.outer.push_back({static_cast<double>(v.x()), static_cast<double>(v.y())});
  }
  return polygon.outer.size() < 3 ? 0 : host::area({polygon});
}

std::size_t solid_cells(const recon::CarveGrid<128>& grid) {
  std::size_t count = 0;
  for (const std::uint32_t word : grid.words()) count += static_cast<std::size_t>(__builtin_popcount(word));
  return count;
}

/// All that one object makes of the same views.
struct Models {
  recon::Carving<128, 192, 64> plain;
  host::KeptTangents kept;
  Hybrid hybrid;

  explicit Models(const std::vector<recon::Sighting>& views) {
    plain.start(views.front(), kOrigin);
    plain.move_origin({0, 0});
    kept.start(views.front(), kOrigin);
    hybrid.begin(views.front());
    const auto solver = std::make_unique<recon::HybridSolver<64, 3>>();
    for (const recon::Sighting& view : views) {
      const recon::ModelView given{view, kOrigin, 1, kNoise};
      plain.add(given);
      kept.add(given);
      hybrid.add(given);
      if (hybrid.new_weight) solver->solve(hybrid);
    }
  }
  [[nodiscard]] host::Carved carved() const {
    return host::carve_with(kept.tangents(), host::Evidence(hybrid, hybrid.outline(), kOrigin));
  }
};

std::vector<recon::Sighting> tour() {
  std::vector<recon::Sighting> views;
  for (const host::Point& lens : arc({0, 0}, 1.0, 36)) views.push_back(view_of(kBox, lens).sighting);
  return views;
}

/// The right half of the segment is lost.
recon::Sighting with_a_lost_piece(recon::Sighting view) {
  view.right.direction = view.center;
  return view;
}

TEST(EvidenceCarving, OneLostPieceTakesHalfOfThePlainFormAndNothingOfThis) {
  std::vector<recon::Sighting> views = tour();
  const double exact = area_of(Models(views).plain.clip().vertices());
  views[2] = with_a_lost_piece(views[2]);
  const Models models(views);
  EXPECT_LT(area_of(models.plain.clip().vertices()), 0.65 * exact);
  const host::Carved carved = models.carved();
  EXPECT_NEAR(area_of(carved.clip.vertices()), exact, 0.02 * exact);
  const auto cell = static_cast<double>(carved.grid.placement().cell);
  EXPECT_NEAR(static_cast<double>(solid_cells(carved.grid)) * cell * cell, exact, 0.06 * exact);
}

TEST(EvidenceCarving, OfGoodViewsItIsThePlainForm) {
  const Models models(tour());
  const double exact = area_of(models.plain.clip().vertices());
  EXPECT_NEAR(area_of(models.carved().clip.vertices()), exact, 0.01 * exact);
}

TEST(EvidenceCarving, WithoutAnOutlineEveryCutIsMade) {
  std::vector<recon::Sighting> views = tour();
  views[2] = with_a_lost_piece(views[2]);
  const Models models(views);
  const Hybrid none;
  const host::Carved all = host::carve_with(models.kept.tangents(), host::Evidence(none, none.outline(), kOrigin));
  EXPECT_FLOAT_EQ(static_cast<float>(area_of(all.clip.vertices())),
                  static_cast<float>(area_of(models.plain.clip().vertices())));
}

TEST(EvidenceCarving, AnotherOriginIsTheSameCut) {
  Models models(tour());
  const double before = area_of(models.carved().clip.vertices());
  const recon::Vec2 shift{0.3F, -0.2F};
  models.kept.move_origin(shift);
  const host::Evidence evidence(models.hybrid, models.hybrid.outline(), recon::moved(kOrigin, shift));
  const host::Carved carved = host::carve_with(models.kept.tangents(), evidence);
  EXPECT_NEAR(area_of(carved.clip.vertices()), before, 1e-5);
  EXPECT_NEAR(recon::bounds_of(carved.clip.vertices()).low.x(), -0.4, 0.005);
}

TEST(KeptTangents, AreBoundedAndStartEmpty) {
  const recon::Sighting view = tour().front();
  host::KeptTangents kept;
  for (std::size_t i = 0; i <= host::KeptTangents::kMax / 2; ++i) kept.add({view, kOrigin, 1, kNoise});
  EXPECT_EQ(kept.tangents().size(), host::KeptTangents::kMax / 2 + 2);
  kept.start(view, kOrigin);
  EXPECT_TRUE(kept.tangents().empty());
  recon::Sighting censored = view;
  censored.left.end = recon::End::kLowerBound;
  censored.right.end = recon::End::kOccluded;
  kept.add({censored, kOrigin, 1, kNoise});
  EXPECT_TRUE(kept.tangents().empty());
}

}  // namespace
}  // namespace fencepost::test
