// Where an object should appear, by its circle, its outline or its last bearing: from a lattice of places.
#include "firmware/recon/track/prediction.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::Prediction;
using recon::Vec2;

/// 320 x 200 px, a focal length of 256: a border of 16 px, and places a power of two apart are whole columns apart.
recon::CameraModel lattice_camera(Draw& draw) {
  recon::CameraModel camera;
  camera.width = 320;
  camera.rows = 200;
  camera.fx = camera.fy = 256;
  camera.cx = 160;
  camera.cy = 100;
  camera.pitch_known = !draw.one_in(6);
  camera.height = draw.one_in(8) ? 0.0F : 0.125F;
  if (draw.one_in(4)) camera.pitch = {0.96F, 0.28F};
  if (draw.one_in(6)) {
    camera.bent = camera.equidistant = true;
    camera.k1 = draw.of({0.0F, -0.125F});
  }
  return camera;
}

void tell_line(Sweep& sweep, const char* at, const char* sigma, const recon::PredictedLine& line) {
  sweep.tell(at, line.at);
  sweep.tell(sigma, line.sigma);
}

void tell_prediction(Sweep& sweep, const Prediction& told) {
  tell_line(sweep, "left", "left sigma", told.left);
  tell_line(sweep, "right", "right sigma", told.right);
  tell_line(sweep, "top", "top sigma", told.top);
  tell_line(sweep, "bottom", "bottom sigma", told.bottom);
  sweep.tell("left tolerance", told.left_tolerance);
  sweep.tell("right tolerance", told.right_tolerance);
  sweep.tell("depth", told.depth);
  sweep.tell("possible", told.possible);
  sweep.tell("anywhere", told.anywhere);
  sweep.tell("expected", told.expected);
}

/// Rows of an object 0.0625 m high, seen `views` times from the origin along `axis`; with or without its top or foot.
void add_rows(Draw& draw, recon::ObjectCore& object, const Vec2& axis) {
  for (int i = draw.between(0, 4); i > 0; --i) {
    recon::Sighting sighting;
    sighting.axis = sighting.center = axis;
    sighting.left = {recon::rotated(axis, {0.96F, 0.28F}), recon::End::kSeen};
    sighting.right = {recon::rotated(axis, {0.96F, -0.28F}), recon::End::kSeen};
    sighting.lens_height = 0.125F;
    sighting.focal = 256;
    sighting.rows_known = true;
    sighting.top = {0.0625F, draw.one_in(4) ? recon::End::kLowerBound : recon::End::kSeen};
    sighting.bottom = {0.125F, draw.one_in(4) ? recon::End::kLowerBound : recon::End::kSeen};
    object.band.add(sighting, object.origin);
    object.cylinder.add(sighting, object.origin, 1, {});
  }
}

TEST(Prediction, OfPlacesOnALattice) {
  Draw draw(131);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    const recon::CameraModel camera = lattice_camera(draw);
    recon::ObjectCore object;
    object.origin = {draw.between(-2, 2) * 6'250, 0};
    object.moving = draw.one_in(6);
    object.left = draw.of({recon::End::kSeen, recon::End::kLowerBound});
    object.right = draw.of({recon::End::kAmbiguous, recon::End::kOccluded});
    object.last_lens = {draw.steps(-2, 2, 0.25F), 0};
    object.last_bearing = draw.of<Vec2>({{1, 0}, {0.6F, 0.8F}, {0.8F, -0.6F}, {0, 1}, {0.05F, 1}, {-1, 0}});
    add_rows(draw, object, object.last_bearing);
    recon::CylinderEstimate circle;
    circle.center = {draw.of({0.125F, 0.5F, 1.0F, 2.0F, 2.5F, 3.0F}), draw.steps(-20, 20, 0.0625F)};
    circle.radius = draw.of({0.0625F, 0.03125F, 0.015625F});
    circle.covariance = {1e-4F, 2e-5F, 2e-4F, 0, 0, 1e-4F};
    if (draw.coin()) circle.covariance = {};
    if (!draw.one_in(4)) circle.refusal = recon::CylinderRefusal::kNone;
    recon::LensPose pose;
    pose.lens = {draw.steps(-2, 2, 0.125F), 0};
    pose.axis = draw.of<Vec2>({{1, 0}, {1, 0}, {0.8F, 0.6F}, {0, 1}});
    recon::MeasurementNoise noise;
    if (draw.coin()) noise = {1, 0, 0, 1, 0, 0};
    tell_prediction(sweep, recon::predict(camera, pose, object, circle, noise));
  }
  expect_said(sweep,
              {"left 15049 6f796b68", "left sigma 12066 6b5aea26", "right 15040 5d4120fc", "right sigma 12066 f1f82fd1",
               "top 5703 48c1ded8", "top sigma 5711 79f495ea", "bottom 11046 03bcb32d", "bottom sigma 11046 35191cd4",
               "left tolerance 15054 09c2635e", "right tolerance 15054 e998a831", "depth 12066 60fe6536",
               "possible 11264 b19f307a", "anywhere 343 fc64cc05", "expected 3502 1b217450"});
}

/// One that was seen from three places by its middle, which is at (2, 0). The last place is the origin.
recon::ObjectCore seen_by_bearings() {
  recon::ObjectCore object;
  for (const float aside : {-0.25F, 0.25F, 0.0F}) {
    recon::Sighting sighting;
    sighting.lens = {0, aside};
    sighting.center = Vec2(2, -aside).normalized();
    sighting.bearing = true;
    sighting.focal = 256;
    object.cylinder.add(sighting, object.origin, 1, {});
  }
  object.last_bearing = {1, 0};
  object.left = object.right = recon::End::kOccluded;
  return object;
}

// Bearings bound the distance before they know it. Nothing hides the middle of a bearing.
TEST(Prediction, OfABearingIsBetweenTheDistancesThatItsViewsLeave) {
  Draw none(1);
  recon::CameraModel camera = lattice_camera(none);
  camera.equidistant = camera.bent = camera.pitch_known = false;
  recon::LensPose pose;
  pose.lens = {0, 0.5F};  // 256 columns a metre of offset at 1 m: at 2 m it is 64 to the right, far away 0
  const auto predicted = [&](const recon::ObjectCore& object) {
    return recon::predict(camera, pose, object, recon::CylinderEstimate{}, {});
  };
  const Prediction told = predicted(seen_by_bearings());
  EXPECT_GT(told.left.at, camera.cx + 40);
  EXPECT_LT(told.left.at, camera.cx + 64);
  EXPECT_GT(told.right.at, camera.cx + 64);
  EXPECT_LT(told.right.at, camera.cx + 90);
  EXPECT_EQ(told.left_tolerance, 16);  // 256 times 0.05 rad, and 3 times 1.2 px
  EXPECT_EQ(told.right_tolerance, 16);
  recon::ObjectCore once;
  once.last_bearing = {1, 0};
  EXPECT_EQ(predicted(once).left.at, camera.cx) << "one view leaves any distance";
  EXPECT_EQ(predicted(once).right.at, camera.cx + 1'280);
}

// Nothing is uncertain: a column is where it is. The sides that have to be inside the image are, from the border on.
TEST(Prediction, IsExpectedInsideTheBorderOnly) {
  Draw none(1);
  recon::CameraModel camera = lattice_camera(none);
  camera.equidistant = camera.bent = camera.pitch_known = false;
  const recon::MeasurementNoise exact{1, 0, 0, 1, 0, 0};
  recon::CylinderEstimate point;  // its two sides are one column
  point.refusal = recon::CylinderRefusal::kNone;
  const auto expected = [&](float ahead, float aside) {
    point.center = {ahead, aside};
    return recon::predict(camera, {}, {}, point, exact).expected;
  };
  // 155 columns beside the middle are 0.60547 m a metre.
  EXPECT_FALSE(expected(1, 0.6055F));
  EXPECT_FALSE(expected(1, -0.6055F));
  EXPECT_TRUE(expected(1, 0.6054F));
  EXPECT_TRUE(expected(1, -0.6054F));
  EXPECT_FALSE(expected(0.1F, 0));
  EXPECT_TRUE(expected(0.10001F, 0));
  EXPECT_FALSE(expected(2.5F, 0));
  EXPECT_TRUE(expected(2.4999F, 0));
}

// 119 and 149 px. A normal of 128 px is nowhere denser than one pixel in 320. What should be well inside the image is
// seen again even so.
TEST(Prediction, SaysWhereAnEndMayBeAnywhere) {
  Draw none(1);
  recon::CameraModel camera = lattice_camera(none);
  camera.equidistant = camera.bent = camera.pitch_known = false;
  recon::CylinderEstimate circle;
  circle.refusal = recon::CylinderRefusal::kNone;
  const auto anywhere = [&](float aside, float sigma) {
    circle.center = {1, aside};
    circle.covariance.yy = sigma * sigma;
    return recon::predict(camera, {}, {}, circle, {1, 0, 0, 1, 0, 0}).anywhere;
  };
  ASSERT_EQ(camera.width, 320);
  EXPECT_FALSE(anywhere(0.62F, 0.4F));
  EXPECT_TRUE(anywhere(0.62F, 0.5F));
  EXPECT_FALSE(anywhere(0, 0.8F));
}

// By the outline where it is known, by the circle where it is not; by neither from inside.
TEST(Prediction, OfAnOutline) {
  Draw draw(132);
  Sweep sweep;
  const std::vector<std::int16_t> offsets(32, 1'000);
  const std::vector<std::uint8_t> sigmas(32, recon::encode_sigma(0.004F));
  const recon::OutlineView view{offsets, sigmas};
  for (int i = 0; i < 4'000; ++i) {
    const recon::CameraModel camera = lattice_camera(draw);
    recon::ObjectCore object;
    add_rows(draw, object, {1, 0});
    for (int look = draw.between(0, 3); look > 0; --look) {
      recon::Sighting sighting;
      const Vec2 side = draw.of<Vec2>({{1, 0}, {0.6F, 0.8F}, {0.6F, -0.8F}});
      sighting.axis = sighting.center = side;
      sighting.lens = Vec2{1, 0} - side;
      sighting.left = {recon::rotated(side, {0.96F, 0.28F}), recon::End::kSeen};
      sighting.right = {recon::rotated(side, {0.96F, -0.28F}), recon::End::kSeen};
      sighting.focal = 256;
      object.cylinder.add(sighting, {}, 1, {});
      object.cylinder.solve(sighting.lens, side, {});
    }
    recon::LensPose pose;
    pose.lens = {draw.of({0.0F, 0.5F, 1.0F}), draw.steps(-2, 2, 0.25F)};
    tell_prediction(sweep, recon::predict(camera, pose, object, {view, {100'000, 0}, !draw.one_in(4)}, {}));
  }
  expect_said(sweep,
              {"left 3286 b706fe2d", "left sigma 1964 464899d8", "right 3286 2f39c02b", "right sigma 1964 2be2ed3f",
               "top 1855 88091c19", "top sigma 1855 b2837a59", "bottom 2195 80b28948", "bottom sigma 2195 d37ec67e",
               "left tolerance 3286 5eb5dfd0", "right tolerance 3286 3abd077e", "depth 1964 3cb34507",
               "possible 3286 557fa2e0", "anywhere 73 2b8d999f", "expected 707 5bcbd899"});
}

}  // namespace
}  // namespace fencepost::test
