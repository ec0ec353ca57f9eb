#include "firmware/recon/guard/guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/recon/observe/standing.hpp"

#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::guard::enough_frames;
using recon::guard::Front;

recon::MapPose pose_at(double x, double y = 0) {
  constexpr double kUnits = recon::kMapUnitsPerMetre;
  return {{static_cast<std::int32_t>(std::lround(x * kUnits)), static_cast<std::int32_t>(std::lround(y * kUnits))}, 0};
}

template <std::size_t kCapacity = 64>
struct Bench {
  void look(const std::vector<FlatFront>& world, double x = 0, double y = 0) {
    show(flat_view(world, x, y, t, number), x, y);
  }
  void show(const sensor::BlobFrame& frame, double x = 0, double y = 0) {
    standing.look(pose_at(x, y), base::Time::nearest(t));
    guard.look(recon::make_waiting(frame, 0), camera, recon::lens_pose(pose_at(x, y), camera), standing.since(), known);
    t += 1 / rate;
    ++number;
  }
  void look_for(double seconds, const std::vector<FlatFront>& world, double x = 0, double y = 0) {
    for (const double end = t + seconds - 1e-9; t < end;) look(world, x, y);
  }
  /// Points that enough frames have seen, within 60 mm of a front: it is known there.
  [[nodiscard]] int points_of(const FlatFront& front) const {
    int count = 0;
    for (const Front& point : guard.fronts()) {
      const double x = guard.origin().x * 1e-5 + point.x * 1e-3;
      const double y = guard.origin().y * 1e-5 + point.y * 1e-3;
      const bool there = std::fabs(x - front.x) < 0.06 && y < front.left + 0.08 && y > front.right - 0.08;
      if (there && enough_frames(point.frames)) ++count;
    }
    return count;
  }

  recon::CameraModel camera = recon::make_camera_model(level_pixy2());
  recon::guard::Guard<kCapacity> guard;
  recon::guard::KnownFeet known;
  recon::Standing standing;
  double rate = 10;
  double t = 1;
  std::uint32_t number = 0;
};

const FlatFront kPost{0.6, -0.05, 0.05};

TEST(Guard, KeepsTheFootOfAPostWhereItIs) {
  Bench bench;
  for (int i = 0; i < 3; ++i) bench.look({kPost});
  ASSERT_FALSE(bench.guard.fronts().empty());
  EXPECT_LE(bench.guard.fronts().size(), 3U);  // 0.1 m, one point each 64 mm, both ends in cells of their own
  for (const Front& front : bench.guard.fronts()) {
    EXPECT_NEAR(front.x, 600, 8);
    EXPECT_LE(std::abs(front.y), 55);
    EXPECT_TRUE(enough_frames(front.frames));
    EXPECT_EQ(front.signature, 1);
  }
}

TEST(Guard, NoStripOfTheFloorPassesBetweenThePointsOfAWall) {
  Bench bench;
  const FlatFront wall{0.7, -3, 3};
  for (int i = 0; i < 3; ++i) bench.look({wall});
  // The view is 0.81 m wide at 0.7 m; beyond it the wall goes on.
  for (double y = -0.4; y <= 0.4; y += 0.01) {
    bool near = false;
    for (const Front& front : bench.guard.fronts()) near = near || std::fabs(front.y * 1e-3 - y) <= 0.032 + 0.001;
    EXPECT_TRUE(near) << y;
  }
  int beyond = 0;
  for (const Front& front : bench.guard.fronts()) beyond += std::abs(front.y) > 410 ? 1 : 0;
  EXPECT_GT(beyond, 0);
}

// A box beside the way has its side's far end in its innermost columns: at the front's depth that is in the way.
TEST(Guard, AFootIsNoWiderThanTheThingThatTheMapKnows) {
  const auto innermost = [](const recon::guard::KnownFeet& known, double x = 0.6, std::uint8_t signature = 1) {
    Bench bench;
    bench.known = known;
    for (int i = 0; i < 3; ++i) bench.look({{x, 0.06, 0.25, signature}});
    EXPECT_FALSE(bench.guard.fronts().empty());
    int least = 1000;
    for (const Front& front : bench.guard.fronts()) least = std::min<int>(least, front.y);
    return least;
  };
  recon::guard::KnownFeet known;
  EXPECT_NEAR(innermost(known), 60, 6);
  ASSERT_TRUE(known.push_back({600, 760, 280, 120, 1}));
  EXPECT_NEAR(innermost(known), 120, 6);
  EXPECT_NEAR(innermost(known, 0.6, 2), 60, 6) << "another signature";
  EXPECT_NEAR(innermost(known, 0.4), 60, 6) << "nearer than the thing";
  EXPECT_NEAR(innermost(known, 0.9), 60, 8) << "farther than the thing";
  ASSERT_TRUE(known.push_back({600, 760, -120, -280, 1}));
  EXPECT_NEAR(innermost(known), 120, 6) << "that one is beside the box";
  ASSERT_TRUE(known.push_back({600, 760, 250, 90, 1}));
  EXPECT_NEAR(innermost(known), 90, 6) << "two in one box";
}

// A box that goes on below and beside the image has no foot of its own there.
TEST(Guard, WhatGoesOnBelowTheImageIsWhereTheMapKnowsIt) {
  const auto points = [&](bool told) {
    Bench bench;
    if (told) static_cast<void>(bench.known.push_back({170, 330, 320, 160, 1}));
    for (int i = 0; i < 3; ++i) bench.look({{0.2, 0.09, 0.4}});
    return bench.guard.fronts().size();
  };
  EXPECT_GT(points(false), 0U);
  EXPECT_EQ(points(true), 0U);
}

TEST(Guard, SeenAgainIsNoNewPoint) {
  Bench bench;
  bench.look({kPost});
  const std::size_t points = bench.guard.fronts().size();
  for (int i = 0; i < 100; ++i) bench.look({kPost}, 0.0015 * i);
  EXPECT_LE(bench.guard.fronts().size(), points + 2);
  EXPECT_GT(bench.points_of(kPost), 0);
}

TEST(Guard, AFrameMoreIsNotAFrameTwice) {
  Bench bench;
  sensor::BlobFrame twice = flat_view({kPost, kPost}, 0, 0, 1, 0);
  bench.show(twice);
  for (const Front& front : bench.guard.fronts()) EXPECT_EQ(__builtin_popcount(front.frames), 1);
}

// A point that frames look past is gone after kRefutedAfter: at any frame rate, and not by fewer than three frames.
TEST(Guard, LookingPastAPointRefutesItInTimeNotInFrames) {
  for (const double rate : {5.0, 10.0, 12.5, 50.0, 100.0}) {
    for (const bool wall_behind : {false, true}) {
      Bench bench;
      bench.rate = rate;
      bench.look_for(1, {kPost});
      ASSERT_GT(bench.points_of(kPost), 0);
      std::vector<FlatFront> background;
      if (wall_behind) background.push_back({0.9, -2, 2, 2});
      bench.look(background);
      bench.look(background);
      EXPECT_GT(bench.points_of(kPost), 0) << "two frames say nothing, rate " << rate;
      bench.look_for(rate < 10 ? 0.4 : 0.1, background);
      if (rate >= 50) {
        EXPECT_GT(bench.points_of(kPost), 0) << "nor do 0.14 s, rate " << rate;
      }
      bench.look_for(0.3, background);
      EXPECT_EQ(bench.points_of(kPost), 0) << "rate " << rate << " wall " << wall_behind;
    }
  }
}

// A camera that misses every third frame, or each second one now and then, does not take the post away.
TEST(Guard, SupportCountsAgainstDoubt) {
  Bench bench;
  bench.look_for(1, {kPost});
  for (int i = 0; i < 200; ++i) {
    bench.look(i % 3 == 2 ? std::vector<FlatFront>{} : std::vector<FlatFront>{kPost});
    ASSERT_GT(bench.points_of(kPost), 0) << i;
  }
}

// 0.29 m ahead the foot is below the image: the empty image says nothing of it.
TEST(Guard, NothingBelowTheImageIsClearedByNotBeingSeen) {
  Bench bench;
  const double close = kPost.x - 0.29;
  for (double x = 0; x < 0.25; x += 0.01) bench.look({kPost}, x);
  for (double x = 0.26; x < close; x += 0.01) bench.look({}, x);  // it is lower than the lens
  bench.look_for(600, {}, close);
  EXPECT_GT(bench.points_of(kPost), 0);
  bench.look_for(0.5, {}, 0.1);  // it backs off, and sees that it is gone
  EXPECT_EQ(bench.points_of(kPost), 0);
}

// A stationary robot saw this point above the image's lower border, so it has to go on seeing it.
TEST(Guard, WhatARobotThatStandsHasSeenItMustSee) {
  for (const double rate : {10.0, 50.0}) {
    Bench bench;
    bench.rate = rate;
    const double close = kPost.x - 0.29;
    for (double x = 0; x < close; x += 0.1 / rate) bench.look({kPost}, x);
    bench.look_for(1.5, {kPost}, close);
    ASSERT_GT(bench.points_of(kPost), 0);
    bench.look_for(0.5, {}, close);
    EXPECT_EQ(bench.points_of(kPost), 0) << rate;
  }
}

TEST(Guard, NothingBesideTheImageIsClearedByNotBeingSeen) {
  Bench bench;
  const FlatFront aside{0.6, 0.2, 0.25};
  bench.look_for(1, {aside});
  ASSERT_GT(bench.points_of(aside), 0);
  bench.look_for(60, {}, 0, -0.3);  // the robot stands so that it is to the left of the image
  EXPECT_GT(bench.points_of(aside), 0);
  bench.look_for(0.5, {}, 0, 0);
  EXPECT_EQ(bench.points_of(aside), 0);
}

TEST(Guard, WhatIsBehindSomethingNearerIsNotCleared) {
  Bench bench;
  const FlatFront far{0.9, -0.05, 0.05, 2};
  bench.look_for(1, {far});
  bench.look_for(60, {kPost});  // stands before it now
  EXPECT_GT(bench.points_of(far), 0);
  bench.look_for(0.5, {});
  EXPECT_EQ(bench.points_of(far), 0);
}

// A blob that is a little farther neither supports a point nor looks past it. For long that means that it is not there.
TEST(Guard, WhatNobodySupportsForLongGoes) {
  Bench bench;
  bench.look_for(1, {kPost});
  const FlatFront almost{kPost.x + 0.045, -0.05, 0.05};
  bench.look_for(0.5, {almost});
  EXPECT_GT(bench.points_of(kPost), 0);
  bench.look_for(4, {almost});
  for (const Front& front : bench.guard.fronts()) EXPECT_NEAR(front.x, 645, 25);
}

// The foot of a blob that fills the image was never seen: it is nearer than where feet leave the image, 322 mm.
TEST(Guard, AnUnseenFootIsNearerThanTheBorder) {
  Bench bench;
  bench.look({{0.2, -0.05, 0.05}});
  ASSERT_FALSE(bench.guard.fronts().empty());
  for (const Front& front : bench.guard.fronts()) {
    EXPECT_GT(front.x, 200);
    EXPECT_LT(front.x, 260);
  }
}

TEST(Guard, AFootSeenShortlyBeforeIsWhereItWasSeen) {
  Bench bench;
  for (double x = 0; x < 0.3; x += 0.005) bench.look({kPost}, x);
  for (double x = 0.3; x < 0.4; x += 0.005) bench.look({kPost}, x);  // 0.3 to 0.2 m: cut by the border
  for (const Front& front : bench.guard.fronts()) EXPECT_NEAR(front.x, 600, 20);
  // And the blob that is still there supports it.
  bench.look_for(60, {kPost}, 0.4);
  for (const Front& front : bench.guard.fronts()) EXPECT_NEAR(front.x, 600, 20);
}

TEST(Guard, AFewFalseBlobsAreForgottenWhereverTheyAre) {
  Bench bench;
  bench.look({{0.25, -0.02, 0.02}});  // its foot would be below the image: nothing could refute it
  bench.look({});
  ASSERT_FALSE(bench.guard.fronts().empty());
  bench.look_for(2.5, {});
  EXPECT_TRUE(bench.guard.fronts().empty());
}

TEST(Guard, WhenFullItKeepsWhatIsNear) {
  Bench<8> bench;
  bench.look_for(1, {{1.2, -2, 2}});  // fills it
  ASSERT_EQ(bench.guard.fronts().size(), 8U);
  const FlatFront near{0.5, -0.1, 0.1, 2};
  bench.look_for(1, {{1.2, -2, 2}, near});
  EXPECT_GE(bench.points_of(near), 3);
  EXPECT_EQ(bench.guard.fronts().size(), 8U);
  const int kept = bench.points_of(near);
  bench.look_for(1, {{1.2, -2, 2}, near});
  EXPECT_GE(bench.points_of(near), kept) << "the far wall does not push it out again";
}

TEST(Guard, FollowsTheRobotFarFromTheStart) {
  Bench bench;
  FlatFront post = kPost;
  double x = 0;
  for (; x < 950; x += 0.04) {
    if (x > post.x - 0.3) post = {x + 1, -0.05, 0.05};
    bench.look({post}, x);
  }
  bench.look_for(0.5, {post}, x);
  EXPECT_GT(bench.points_of(post), 0);
  for (const Front& front : bench.guard.fronts()) {
    EXPECT_LT(std::fabs(bench.guard.origin().x * 1e-5 + front.x * 1e-3 - x), 2.1) << "what is far behind is forgotten";
  }
}

// A mover leaves no points. Those from before it was known to move are deleted, also where they are below the image
// now. Points of another colour stay.
TEST(Guard, WhatMovesLeavesNothingBehind) {
  Bench bench;
  const FlatFront other{0.34, -0.05, 0.05, 2};
  for (int i = 0; i < 3; ++i) bench.look({{0.34, -0.05, 0.05}, other});
  ASSERT_GT(bench.points_of(other), 1);
  for (int i = 0; i < 6; ++i) {
    recon::WaitingFrame frame =
        recon::make_waiting(flat_view({{0.5 + 0.02 * i, -0.05, 0.05}}, 0.1, 0, bench.t, bench.number++), 0);
    frame.blobs[0].moves = true;
    bench.guard.look(frame, bench.camera, recon::lens_pose(pose_at(0.1), bench.camera), base::Time::nearest(bench.t));
    bench.t += 0.1;
  }
  ASSERT_FALSE(bench.guard.fronts().empty());
  for (const Front& front : bench.guard.fronts()) EXPECT_EQ(front.signature, 2);
}

TEST(Guard, WithoutPitchItKnowsNothing) {
  Bench bench;
  sensor::CameraIntrinsics unmeasured = level_pixy2();
  unmeasured.mount.pitch.reset();
  bench.camera = recon::make_camera_model(unmeasured);
  for (int i = 0; i < 5; ++i) bench.look({kPost});
  EXPECT_TRUE(bench.guard.fronts().empty());
}

// A frame of sixteen blobs may have had more: what is missing is no evidence at once.
TEST(Guard, AFullFrameHidesWhatItDoesNotTell) {
  Bench bench;
  bench.look_for(1, {kPost});
  std::vector<FlatFront> crowd;
  for (int i = 0; i < 16; ++i) crowd.push_back({1.4, 0.4 + 0.01 * i, 0.41 + 0.01 * i, 3});
  bench.look_for(1, crowd);
  EXPECT_GT(bench.points_of(kPost), 0);
}

TEST(Guard, AStreamThatPausedForAMinuteGoesOn) {
  Bench bench;
  bench.look_for(1, {kPost});
  for (const double pause : {26.0, 52.4, 52.5, 60.0, 3600.0}) {
    bench.t += pause;
    bench.look({kPost});
    EXPECT_GT(bench.points_of(kPost), 0) << pause;
  }
}

// All points are hashed in turn: one that differs shows within as many frames as there are parts.
TEST(Guard, TheDigestCoversEveryPointInTurn) {
  const auto digests = [](double foot) {
    Bench bench;
    bench.look_for(1, {{0.7, -2, 2}});
    bench.look_for(1, {{0.7, -2, 2}, {foot, 0.15, 0.18, 2}});
    std::vector<std::uint64_t> hashes;
    for (std::uint32_t turn = 0; turn < 16; ++turn) {
      base::Fnv1a64 hash;
      bench.guard.hash(hash, turn);
      hashes.push_back(hash.value());
    }
    return hashes;
  };
  EXPECT_EQ(digests(0.5), digests(0.5));
  EXPECT_NE(digests(0.5), digests(0.51));
}

TEST(Guard, IsSmall) { EXPECT_LE(sizeof(recon::guard::Guard<64>), 540U); }

/// A blob of the level camera between these columns, whose foot is in one of the rows below the horizon, or cut.
recon::WaitingBlob any_foot(Draw& draw, int left, int right) {
  const int x1 = std::clamp(draw.between(left - 4, left + 4), 0, 315);
  const int x2 = std::clamp(draw.between(right - 4, right + 4), x1, 315);
  const auto y2 = draw.of<std::int16_t>({207, 206, 205, 204, 180, 174, 168, 160, 150, 140, 130, 125});
  const auto height = draw.of<std::int16_t>({11, 10, 60});
  return {{static_cast<std::int16_t>(x1), static_cast<std::int16_t>(y2 - height), static_cast<std::int16_t>(x2), y2},
          draw.between<std::uint8_t>(1, 2),
          draw.one_in(10)};
}

void tell_fronts(Sweep& sweep, std::span<const Front> fronts) {
  sweep.tell("points", fronts.size());
  for (const Front& front : fronts) {
    sweep.tell("x", front.x);
    sweep.tell("y", front.y);
    sweep.tell("frames", front.frames);
    sweep.tell("doubt", front.doubt);
    sweep.tell("seen", front.seen);
    sweep.tell("signature", front.signature);
  }
}

// Blobs almost where others were, from places a few millimetres apart, at times that are whole counts of the guard's
// clocks. The points after every frame are compared.
TEST(Guard, OfBlobsThatAreAlmostWhereOthersWere) {
  Draw draw(41);
  Sweep sweep;
  for (int run = 0; run < 400; ++run) {
    recon::CameraModel camera = recon::make_camera_model(level_pixy2(0));
    if (run % 5 == 4) camera.position = {0.125F, -0.0625F};
    recon::guard::Guard<12> guard;
    base::Time t{2048 * 100};
    base::Time stands_since = t;
    recon::MapPose pose{{draw.between(-3, 3) * 100'000, draw.between(-3, 3) * 100'000}, draw.of({0, 0, 1'570'796})};
    const int left = draw.between(0, 250);
    for (int frame = 0; frame < 24; ++frame) {
      recon::WaitingFrame seen{t, static_cast<std::uint32_t>(frame), 0, {}};
      for (int i = draw.of({0, 1, 1, 1, 2, 3}); i > 0; --i) {
        const int aside = draw.of({0, 0, 0, 40, -40});
        ASSERT_TRUE(seen.blobs.push_back(any_foot(draw, left + aside, left + aside + draw.of({8, 30, 64}))));
      }
      while (run % 10 == 9 && frame % 4 == 3 && !seen.blobs.full()) {
        ASSERT_TRUE(seen.blobs.push_back({{250, 100, 254, 120}, 3}));
      }
      guard.look(seen, camera, recon::lens_pose(pose, camera), stands_since);
      tell_fronts(sweep, guard.fronts());
      t = t + base::Duration{draw.of({32, 320, 992, 1'024, 2'048, 2'048, 4'096, 20'480})};
      if (draw.one_in(30)) t = t + base::Duration{2'048 * draw.of({199, 200, 201, 256})};
      if (draw.coin()) continue;
      pose.position.x += draw.of({0, 400, 1'000, -1'000, 30'000});
      pose.position.y += draw.of({0, 0, 400, 20'000});
      if (draw.one_in(25)) pose.position.x += draw.of({800'000, 800'100, -800'000, -800'100});
      if (draw.one_in(20)) pose.heading = draw.of({0, 1'570'796, 3'141'592});
      stands_since = t;
    }
  }
  expect_said(sweep, {"points 9083 095d057d", "x 70409 40f5be11", "y 70414 ee5ae76e", "frames 70418 3c7f127d",
                      "doubt 29687 7c458f21", "seen 70341 4b64c922", "signature 70418 dc12128d"});
}

// Its frame of reference stays while the robot is within 8 m of it, that included, in each direction.
TEST(Guard, ItsOriginFollowsBeyondEightMetres) {
  for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    for (const int over : {0, 1}) {
      Bench bench;
      const std::int32_t units = 100 * (8'000 + over);  // of 10 um
      const recon::MapPose pose{{x * units, y * units}, 0};
      bench.guard.look(recon::make_waiting(flat_view({}, 0, 0, 1, 0), 0), bench.camera,
                       recon::lens_pose(pose, bench.camera), base::Time::nearest(1));
      EXPECT_EQ(bench.guard.origin(), over == 0 ? recon::MapPoint{} : pose.position) << x << " " << y;
    }
  }
}

// A lens configured farther from the robot's origin than any robot is long counts as 4 m away.
TEST(Guard, ALensIsWithinFourMetresOfTheRobot) {
  for (const auto& [x, y] : {std::pair{0.0F, 5.0F}, {0.0F, -5.0F}, {5.0F, 0.0F}, {-5.0F, 0.0F}}) {
    Bench bench;
    bench.look({kPost});
    const Front here = bench.guard.fronts()[0];
    Bench far;
    far.camera.position = {x, y};
    far.look({kPost});
    ASSERT_FALSE(far.guard.fronts().empty());
    EXPECT_EQ(far.guard.fronts()[0].x - here.x, static_cast<int>(0.8F * 1'000 * x));
    EXPECT_EQ(far.guard.fronts()[0].y - here.y, static_cast<int>(0.8F * 1'000 * y));
  }
}

}  // namespace
}  // namespace fencepost::test
