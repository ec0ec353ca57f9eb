// Why a model gives no estimate has words.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/recon/models/clip.hpp"
#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "host/models/cylinder_paper.hpp"
#include "host/models/sheaf.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

// A result document may be of a newer program: an enumerator that is not known here has no words.
TEST(ModelRefusals, HaveTheirWords) {
  using recon::CylinderRefusal;
  EXPECT_EQ(name(CylinderRefusal::kNone), "");
  EXPECT_EQ(name(CylinderRefusal::kNoEdges), "only censored ends seen");
  EXPECT_EQ(name(CylinderRefusal::kParallax), "parallax too small");
  EXPECT_EQ(name(CylinderRefusal::kImplausible), "tangents contradict each other");
  EXPECT_EQ(name(static_cast<CylinderRefusal>(4)), "");
  using recon::HybridRefusal;
  EXPECT_EQ(name(HybridRefusal::kNone), "");
  EXPECT_EQ(name(HybridRefusal::kNoTangents), "no tangent has been fitted yet");
  EXPECT_EQ(name(HybridRefusal::kIllConditioned), "the tangents are ill-conditioned");
  EXPECT_EQ(name(HybridRefusal::kEmpty), "contradictory tangents leave nothing");
  EXPECT_EQ(name(static_cast<HybridRefusal>(4)), "");
  using recon::SheafRefusal;
  EXPECT_EQ(name(SheafRefusal::kNone), "");
  EXPECT_EQ(name(SheafRefusal::kNoEdges), "only censored ends seen");
  EXPECT_EQ(name(SheafRefusal::kNoCrossing), "no edges of two views cross");
  EXPECT_EQ(name(SheafRefusal::kFewPosts), "fewer than three posts");
  EXPECT_EQ(name(SheafRefusal::kOneLine), "all posts on one line");
  EXPECT_EQ(name(static_cast<SheafRefusal>(5)), "");
}

// Two vertices closer than the shallowest cut are given up before any edge that has a length.
TEST(ClipRoom, VerticesThatAreOnePointGoFirst) {
  std::array<recon::Vec2, 8> v = {recon::Vec2{0, 0}, {2, 0}, {3, 1},    {3, 2}, {2, 3},
                                  {1.9999999F, 3},   {0, 3}, {-1, 1.5F}};
  ASSERT_LT((v[5] - v[4]).norm(), recon::kShallowestCut);
  const std::array<recon::Vec2, 8> before = v;
  // Cuts the corner (0, 3) off, along y - x = 2.75: two vertices for one.
  const recon::Vec2 normal = recon::Vec2(-1, 1).normalized();
  ASSERT_EQ(recon::clip_convex(v, v.size(), {normal, 2.75F / std::sqrt(2.0F)}), 8U);
  const auto near = [&](const recon::Vec2& wanted) {
    return std::any_of(v.begin(), v.end(), [&](const recon::Vec2& one) { return (one - wanted).norm() < 1e-5F; });
  };
  for (const std::size_t kept : {0U, 1U, 2U, 3U, 4U, 7U}) EXPECT_TRUE(near(before[kept])) << kept;
  EXPECT_TRUE(near({0.25F, 3})) << "where the cut meets y = 3";
  EXPECT_FALSE(near(before[6]));
}

}  // namespace
}  // namespace fencepost::test
