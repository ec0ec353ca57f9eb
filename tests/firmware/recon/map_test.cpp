#include "firmware/recon/map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "host/replay/compared.hpp"

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::MapPose;
using recon::WaitingFrame;

// 316 x 208, f = 273.6, lens 12 cm above the floor, level.
recon::CameraModel camera(bool pitch_known = true) {
  sensor::CameraIntrinsics intrinsics;
  intrinsics.width = 316;
  intrinsics.height = 208;
  intrinsics.fx = intrinsics.fy = base::Pixels2::nearest(273.6);
  intrinsics.cx = base::Pixels2::nearest(157.5);
  intrinsics.cy = base::Pixels2::nearest(103.5);
  intrinsics.mount.z = base::Metres::nearest(0.12);
  if (pitch_known) intrinsics.mount.pitch = base::Radians{0};
  return recon::make_camera_model(intrinsics);
}

struct Post {
  std::uint8_t signature;
  double x, y, radius;
};

// The box of a post of 10 cm height, seen from a pose; nothing if it is not wholly in the image.
bool see(const Post& post, double x, double y, double heading, sensor::Blob& blob) {
  const double dx = post.x - x;
  const double dy = post.y - y;
  const double forward = dx * std::cos(heading) + dy * std::sin(heading);
  const double left = dy * std::cos(heading) - dx * std::sin(heading);
  const double distance = std::hypot(forward, left);
  if (forward < 0.2) return false;
  const double half = std::asin(post.radius / distance);
  const double bearing = std::atan2(left, forward);
  const double u1 = 157.5 - 273.6 * std::tan(bearing + half);
  const double u2 = 157.5 - 273.6 * std::tan(bearing - half);
  if (u1 < 3 || u2 > 312) return false;
  const double depth = forward - post.radius;
  blob.signature = post.signature;
  blob.x1 = static_cast<std::int16_t>(std::lround(u1 + 0.5));
  blob.x2 = static_cast<std::int16_t>(std::lround(u2 - 0.5));
  blob.y1 = static_cast<std::int16_t>(std::lround(103.5 + 273.6 * 0.02 / depth + 0.5));
  blob.y2 = static_cast<std::int16_t>(std::lround(103.5 + 273.6 * 0.12 / depth - 0.5));
  return true;
}

template <class Profile>
struct Drive {
  std::unique_ptr<recon::Map<Profile>> map = std::make_unique<recon::Map<Profile>>();
  recon::CameraModel model = camera();
  recon::CorrectionOrder correction;
  std::uint32_t frame = 0;

  sensor::BlobFrame look(const std::vector<Post>& posts, double x, double y, double heading) {
    sensor::BlobFrame seen;
    seen.t = {static_cast<std::int64_t>(frame) * 1000};
    seen.frame = frame++;
    for (const Post& post : posts) {
      sensor::Blob blob;
      if (see(post, x, y, heading, blob)) {
        EXPECT_TRUE(seen.blobs.push_back(blob));
      }
    }
    return seen;
  }
  recon::FrameOutcome take(const sensor::BlobFrame& seen, double x, double y, double heading) {
    const MapPose pose{
        {static_cast<std::int32_t>(std::lround(x * 1e5)), static_cast<std::int32_t>(std::lround(y * 1e5))},
        static_cast<std::int32_t>(std::lround(heading * 1e6))};
    recon::WaitingFrame waiting = recon::make_waiting(seen, 0);
    return map->add_frame(waiting, model, pose, {}, {}, correction);
  }
  recon::FrameOutcome step(const std::vector<Post>& posts, double x, double y, double heading) {
    return take(look(posts, x, y, heading), x, y, heading);
  }
  std::vector<const recon::Object<Profile>*> objects() const {
    std::vector<const recon::Object<Profile>*> found;
    for (const auto& object : map->slots()) {
      if (object.used()) found.push_back(&object);
    }
    return found;
  }
};

double error(const recon::ObjectCore& object, const Post& post) {
  const recon::Vec2 c = object.cylinder.estimate().center;
  return std::hypot(object.origin.x * 1e-5 + static_cast<double>(c.x()) - post.x,
                    object.origin.y * 1e-5 + static_cast<double>(c.y()) - post.y);
}

TEST(Map, KeepsObjectsOfOneColourApartByPlace) {
  const std::vector<Post> posts = {{1, 1.5, 0.35, 0.04}, {1, 1.4, -0.3, 0.05}, {2, 1.8, 0.0, 0.06}};
  Drive<config::Small> drive;
  for (int i = 0; i < 60; ++i) {
    const double y = 0.3 * std::sin(0.1 * i);
    drive.step(posts, 0.008 * i, y, -0.15 * y);
  }
  EXPECT_FALSE(drive.map->knows_bearings());
  const auto objects = drive.objects();
  ASSERT_EQ(objects.size(), 3U);
  for (const auto* object : objects) {
    EXPECT_TRUE(object->confirmed);
    EXPECT_EQ(object->views, 60U);
    const auto nearest = std::min_element(posts.begin(), posts.end(), [&](const Post& a, const Post& b) {
      return error(*object, a) < error(*object, b);
    });
    EXPECT_LT(error(*object, *nearest), 0.02);
    EXPECT_EQ(object->signature, nearest->signature);
    EXPECT_NEAR(static_cast<double>(object->cylinder.estimate().radius), nearest->radius, 0.012);
  }
}

// 1.6 m without a landmark. The heading's sigma is then a quarter of a radian, less than half the image. The post is
// likelier the known one than a new one.
template <class Profile>
void expect_known_after_a_blind_stretch() {
  const std::vector<Post> posts = {{1, 4.0, 0.0, 0.06}};
  Drive<Profile> drive;
  drive.correction = {0.3F, true};
  for (int i = 0; i < 60; ++i) drive.step(posts, 0.008 * i, 0.3 * std::sin(0.1 * i), 0);
  ASSERT_EQ(drive.objects().size(), 1U);
  const std::uint32_t known = drive.objects()[0]->id;
  for (int i = 0; i < 20; ++i) drive.step({}, 0.48 - 0.04 * i, 0, 0);
  for (int i = 0; i < 20; ++i) drive.step({}, -0.32 + 0.04 * i, 0, 0);
  EXPECT_GT(drive.map->correction().sigma().heading, 0.2F);
  for (int i = 0; i < 5; ++i) drive.step(posts, 0.48, 0.01 * i, 0);
  ASSERT_EQ(drive.objects().size(), 1U);
  EXPECT_EQ(drive.objects()[0]->id, known);
}

TEST(Map, KnowsALandmarkAgainAfterABlindStretch) {
  expect_known_after_a_blind_stretch<config::Small>();
  expect_known_after_a_blind_stretch<config::Full>();
}

// The same posts, of which the camera tells the middles alone.
sensor::BlobFrame bearings_of(sensor::BlobFrame frame) {
  for (sensor::Blob& blob : frame.blobs) {
    blob.cx.raw = 5 * (blob.x1 + blob.x2);
    blob.bearing = true;
    sensor::put_at_centre(blob);
  }
  return frame;
}

TEST(Map, BearingsAlonePlacePointsAndGiveNoOutlineAndNoFoot) {
  const std::vector<Post> posts = {{1, 1.5, 0.35, 0.04}, {1, 1.4, -0.3, 0.05}, {2, 1.8, 0.0, 0.06}};
  Drive<config::Small> drive;
  for (int i = 0; i < 60; ++i) {
    const double y = 0.3 * std::sin(0.1 * i);
    drive.take(bearings_of(drive.look(posts, 0.008 * i, y, -0.15 * y)), 0.008 * i, y, -0.15 * y);
  }
  EXPECT_TRUE(drive.map->guard().fronts().empty());
  EXPECT_TRUE(drive.map->knows_bearings());
  const auto objects = drive.objects();
  ASSERT_EQ(objects.size(), posts.size());
  for (const auto* object : objects) {
    EXPECT_TRUE(object->confirmed);
    EXPECT_FALSE(object->hybrid().ok());
    const auto nearest = std::min_element(posts.begin(), posts.end(), [&](const Post& a, const Post& b) {
      return error(*object, a) < error(*object, b);
    });
    EXPECT_EQ(object->signature, nearest->signature);
    EXPECT_LT(error(*object, *nearest), 0.06);
    EXPECT_NEAR(static_cast<double>(object->cylinder.estimate().radius), 0.005, 0.002);
  }
}

TEST(Map, ABearingBesideABoxChangesNothingOfTheBox) {
  const std::vector<Post> box = {{1, 1.5, 0.1, 0.04}};
  const std::vector<Post> beacon = {{2, 1.2, 0.1, 0.04}};  // in front of it
  Drive<config::Small> alone;
  Drive<config::Small> both;
  for (int i = 0; i < 40; ++i) {
    const double y = 0.3 * std::sin(0.1 * i);
    const sensor::BlobFrame seen = alone.look(box, 0, y, 0);
    sensor::BlobFrame more = both.look(beacon, 0, y, 0);
    more = bearings_of(more);
    for (const sensor::Blob& blob : seen.blobs) ASSERT_TRUE(more.blobs.push_back(blob));
    alone.take(seen, 0, y, 0);
    both.take(more, 0, y, 0);
  }
  const auto of_box = [](const Drive<config::Small>& drive) {
    for (const auto* object : drive.objects()) {
      if (object->signature == 1) return object->cylinder.estimate();
    }
    return recon::CylinderEstimate{};
  };
  ASSERT_TRUE(of_box(alone).ok());
  ASSERT_EQ(both.objects().size(), 2U);
  EXPECT_EQ(of_box(both).radius, of_box(alone).radius);
}

TEST(Map, ConfirmsWithTheSightingThatCompletesKOfN) {
  const std::vector<Post> posts = {{1, 1.0, 0.0, 0.05}};
  Drive<config::Micro> drive;
  drive.step(posts, 0, 0, 0);
  drive.step({}, 0, 0.01, 0);
  drive.step(posts, 0, 0.02, 0);
  ASSERT_EQ(drive.objects().size(), 1U);
  EXPECT_FALSE(drive.objects()[0]->confirmed);
  drive.step(posts, 0, 0.03, 0);  // the third in four frames
  EXPECT_TRUE(drive.objects()[0]->confirmed);
}

TEST(Map, TooFewSightingsNeverConfirm) {
  const std::vector<Post> posts = {{1, 1.0, 0.0, 0.05}};
  Drive<config::Micro> drive;
  for (int i = 0; i < 30; ++i) drive.step(i % 3 == 0 ? posts : std::vector<Post>{}, 0, 0.002 * i, 0);
  ASSERT_FALSE(drive.objects().empty());
  for (const auto* object : drive.objects()) EXPECT_FALSE(object->confirmed);
}

TEST(Map, TheOrderOfBlobsInAFrameNeverMatters) {
  const std::vector<Post> posts = {
      {1, 1.5, 0.35, 0.04}, {1, 1.4, -0.3, 0.05}, {2, 1.8, 0.0, 0.06}, {2, 2.0, 0.5, 0.06}};
  std::mt19937 random(7);
  Drive<config::Full> one;
  Drive<config::Full> other;
  for (int i = 0; i < 40; ++i) {
    const sensor::BlobFrame seen = one.look(posts, 0.01 * i, 0, 0);
    std::vector<sensor::Blob> shuffled(seen.blobs.begin(), seen.blobs.end());
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    sensor::BlobFrame mixed{seen.t, seen.frame, {}};
    for (const sensor::Blob& blob : shuffled) ASSERT_TRUE(mixed.blobs.push_back(blob));
    one.take(seen, 0.01 * i, 0, 0);
    other.take(mixed, 0.01 * i, 0, 0);
    ASSERT_EQ(one.map->digest(), other.map->digest()) << i;
  }
}

TEST(Map, AFullTableGivesUpTheLeastUsefulTentativeObject) {
  const std::vector<Post> kept = {{1, 1.0, 0.25, 0.04}, {2, 1.0, 0.0, 0.04}, {3, 1.0, -0.25, 0.04}};
  Drive<config::Micro> drive;  // four slots
  for (int i = 0; i < 10; ++i) drive.step(kept, 0, 0.01 * i, 0);
  std::vector<Post> more = kept;
  more.push_back({4, 1.6, 0.6, 0.04});
  drive.step(more, 0, 0.1, 0);
  ASSERT_EQ(drive.map->size(), 4U);
  EXPECT_EQ(drive.map->evicted(), 0U);
  more.back() = {5, 1.6, -0.6, 0.04};
  drive.step(more, 0, 0.1, 0);  // the tentative 4 goes, 5 takes its place
  EXPECT_EQ(drive.map->evicted(), 1U);
  for (const auto* object : drive.objects()) EXPECT_NE(object->signature, 4);
  for (int i = 0; i < 12; ++i) drive.step(more, 0, 0.1 + 0.01 * i, 0);  // a turn of the models for each of the four
  more.push_back({6, 1.6, 0.6, 0.04});
  const recon::FrameOutcome outcome = drive.step(more, 0, 0.15, 0);  // all four confirmed: no room
  EXPECT_EQ(outcome.refused, 1);
  EXPECT_EQ(drive.map->size(), 4U);
}

// The camera lost three columns in the middle.
sensor::BlobFrame in_two(sensor::BlobFrame seen) {
  sensor::Blob& whole = seen.blobs[0];
  sensor::Blob piece = whole;
  const int middle = (whole.x1 + whole.x2) / 2;
  whole.x2 = static_cast<std::int16_t>(middle - 2);
  piece.x1 = static_cast<std::int16_t>(middle + 2);
  EXPECT_TRUE(seen.blobs.push_back(piece));
  return seen;
}

// One box around both, as a camera has it where two things of one colour touch in the image.
sensor::BlobFrame as_one(sensor::BlobFrame seen) {
  const sensor::Blob other = seen.blobs[1];
  sensor::Blob& one = seen.blobs[0];
  one.x1 = std::min(one.x1, other.x1);
  one.x2 = std::max(one.x2, other.x2);
  one.y1 = std::min(one.y1, other.y1);
  one.y2 = std::max(one.y2, other.y2);
  seen.blobs.erase_at(1);
  return seen;
}

TEST(Map, APieceIsNotANewObject) {
  Drive<config::Small> drive;
  const std::vector<Post> posts = {{1, 1.0, 0.0, 0.06}};
  for (int i = 0; i < 10; ++i) drive.step(posts, 0, 0.02 * i, 0);
  const recon::FrameOutcome outcome = drive.take(in_two(drive.look(posts, 0, 0.2, 0)), 0, 0.2, 0);
  EXPECT_EQ(outcome.matched, 1);
  EXPECT_EQ(outcome.born, 0);
  EXPECT_NEAR(drive.objects()[0]->cylinder.estimate().radius, 0.06, 0.01);
}

TEST(Map, PiecesThatStayAreTwoObjects) {
  Drive<config::Small> drive;
  const std::vector<Post> posts = {{1, 1.0, -0.07, 0.06}, {1, 1.0, 0.07, 0.06}};
  int i = 0;
  for (; i < 8; ++i) drive.take(as_one(drive.look(posts, 0, 0.01 * i, 0)), 0, 0.01 * i, 0);
  ASSERT_EQ(drive.objects().size(), 1U);
  const std::uint32_t both = drive.objects()[0]->id;
  EXPECT_TRUE(drive.objects()[0]->confirmed);
  for (; i < 14; ++i) drive.step(posts, 0, 0.01 * i, 0);
  const auto objects = drive.objects();
  ASSERT_EQ(objects.size(), 2U);
  for (const auto* object : objects) {
    EXPECT_NE(object->id, both);
    EXPECT_TRUE(object->confirmed);
    EXPECT_LT(object->cylinder.estimate().radius, 0.09F);
  }
}

TEST(Map, OneBlobOfTwoObjectsIsSeenByBoth) {
  Drive<config::Small> drive;
  const std::vector<Post> posts = {{1, 1.0, -0.08, 0.06}, {1, 1.0, 0.08, 0.06}};
  int i = 0;
  for (; i < 25; ++i) drive.step(posts, 0, -0.25 + 0.02 * i, 0);
  ASSERT_EQ(drive.objects().size(), 2U);
  const auto before = drive.objects();
  const std::array<std::uint32_t, 2> views{before[0]->views, before[1]->views};
  for (int k = 0; k < 5; ++k, ++i) {
    drive.take(as_one(drive.look(posts, 0, -0.25 + 0.02 * i, 0)), 0, -0.25 + 0.02 * i, 0);
  }
  const auto objects = drive.objects();
  ASSERT_EQ(objects.size(), 2U);
  for (std::size_t o = 0; o < 2; ++o) {
    EXPECT_EQ(objects[o]->views, views[o] + 5);
    EXPECT_NEAR(objects[o]->cylinder.estimate().radius, 0.06, 0.012);
  }
}

TEST(Map, ModelsOfSomethingElseStartAgain) {
  Drive<config::Small> drive;
  for (int i = 0; i < 10; ++i) drive.step({{1, 1.0, 0.0, 0.15}}, 0, 0.02 * i, 0);
  const std::uint32_t id = drive.objects()[0]->id;
  EXPECT_GT(drive.objects()[0]->cylinder.estimate().radius, 0.12F);
  // Its right end stays, its left one comes in, and does not go back.
  for (int i = 10; i < 30; ++i) drive.step({{1, 1.0, -0.11, 0.04}}, 0, 0.02 * i, 0);
  const auto objects = drive.objects();
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0]->id, id);
  EXPECT_TRUE(objects[0]->confirmed);
  EXPECT_NEAR(objects[0]->cylinder.estimate().radius, 0.04, 0.01);
}

TEST(Map, AFewSightingsThatNothingBearsOutAreForgotten) {
  Drive<config::Small> drive;
  for (int i = 0; i < 4; ++i) drive.step({{1, 1.0, 0.0, 0.06}}, 0, 0.02 * i, 0);
  ASSERT_TRUE(drive.objects()[0]->confirmed);
  for (int i = 0; i < 8; ++i) drive.step({}, 0, 0.08, 0);
  EXPECT_EQ(drive.objects().size(), 1U) << "not within a second";
  for (int i = 0; i < 8; ++i) drive.step({}, 0, 0.08, 0);
  EXPECT_TRUE(drive.objects().empty());
}

// A small table, and a robot that drives on: the objects that it saw first make room, but not within five seconds.
// Two posts leave the image at its sides. To the edges, the one that comes by itself is half as far as it is.
TEST(Map, WhatMayMoveIsForgottenBesideTheImage) {
  constexpr double kStep = 0.02;  // m/frame, of the robot and of the post that comes
  Drive<config::Full> drive;
  bool sure = false;
  for (int i = 0; i < 110; ++i) {
    const std::vector<Post> posts = {{1, 3.2 - kStep * i, -0.3, 0.06}, {2, 1.6, 0.3, 0.06}};
    drive.step(posts, kStep * i, 0, 0);
    for (const auto* object : drive.objects()) {
      EXPECT_TRUE(object->signature == 1 || !object->may_move()) << i;
      sure = sure || object->may_move();
    }
    // It has just left the image at one side, the other post at the other side is still there.
    if (i == 72) {
      EXPECT_EQ(drive.objects().size(), 2U);
    }
  }
  EXPECT_TRUE(sure);
  ASSERT_EQ(drive.objects().size(), 1U);
  EXPECT_EQ(drive.objects()[0]->signature, 2);
  EXPECT_TRUE(drive.objects()[0]->confirmed);
}

// A robot that stops where it saw a thing last does not forget it, whatever it may be.
TEST(Map, WhatMayMoveStaysBeforeAStationaryRobot) {
  Drive<config::Full> drive;
  for (int i = 0; i < 66; ++i) drive.step({{1, 3.2 - 0.02 * i, -0.3, 0.06}}, 0.02 * i, 0, 0);
  ASSERT_EQ(drive.objects().size(), 1U);
  ASSERT_TRUE(drive.objects()[0]->may_move());
  const double stopped = 0.02 * 66;
  for (int i = 0; i < 8; ++i) drive.step({{1, 3.2 - 0.02 * 66, -0.3, 0.06}}, stopped, 0, 0);
  for (int i = 0; i < 100; ++i) drive.step({}, stopped, 0, 0);
  EXPECT_EQ(drive.objects().size(), 1U);
}

TEST(Map, AFullTableForgetsWhatIsLongOutOfSight) {
  Drive<config::Micro> drive;
  const auto pass = [&](std::uint8_t signature, double along) {
    for (int i = 0; i < 6; ++i) drive.step({{signature, along, 1.0, 0.06}}, along, 0.02 * i, 1.57);
  };
  for (std::uint8_t k = 0; k < 4; ++k) pass(static_cast<std::uint8_t>(k + 1), 3.0 * k);
  ASSERT_EQ(drive.objects().size(), 4U);
  pass(5, 12.0);
  EXPECT_EQ(drive.map->evicted(), 0U);
  drive.frame += 60;
  pass(5, 12.0);
  EXPECT_EQ(drive.map->evicted(), 1U);
  for (const auto* object : drive.objects()) EXPECT_NE(object->signature, 1) << "the one longest out of sight";
}

TEST(Map, AnObjectThatShouldBeSeenAndIsNotLosesCredit) {
  const std::vector<Post> posts = {{1, 1.0, 0.0, 0.06}};
  Drive<config::Small> drive;
  for (int i = 0; i < 20; ++i) drive.step(posts, 0, 0.02 * i, -0.01 * i);
  const float before = drive.objects()[0]->confidence();
  EXPECT_GT(before, 0.15F);                                              // seen from one side only
  for (int i = 20; i < 40; ++i) drive.step({}, 0, 0.02 * i, -0.01 * i);  // still in view, but gone
  EXPECT_EQ(drive.objects()[0]->missed_for, 10'000);
  EXPECT_LT(drive.objects()[0]->confidence(), 0.2F * before);
  for (int i = 0; i < 20; ++i) drive.step({}, 0, 0, 3.0);  // looking away is no evidence
  EXPECT_EQ(drive.objects()[0]->missed_for, 10'000);
}

// Its foot below the image, a post may be out of sight as a whole: that is no evidence.
TEST(Map, AnObjectBelowTheImageIsNotMissed) {
  const std::vector<Post> posts = {{1, 1.0, 0.0, 0.06}};
  Drive<config::Small> drive;
  for (int i = 0; i <= 20; ++i) drive.step(posts, 0.03 * i, 0.01 * (i % 3), 0);
  for (int i = 0; i < 40; ++i) drive.step({}, 0.68, 0, 0);  // its front is 0.26 m ahead; feet leave the image at 0.32 m
  EXPECT_EQ(drive.objects()[0]->missed_for, 0);
  for (int i = 0; i < 10; ++i) drive.step({}, 0.4, 0, 0);
  EXPECT_TRUE(drive.objects()[0]->refuted());
}

// Only a nearer thing hides: a post behind the place shows that the place is free.
TEST(Map, WhatStandsBehindAnObjectDoesNotHideIt) {
  Drive<config::Small> drive;
  for (int i = 0; i <= 20; ++i) drive.step({{1, 1.0, 0.0, 0.06}}, 0.02 * i, 0.02 * (i % 5), 0);
  for (int i = 0; i < 10; ++i) drive.step({{2, 1.9, 0.0, 0.06}}, 0.4, 0, 0);
  EXPECT_TRUE(drive.objects()[0]->refuted());
  Drive<config::Small> hidden;
  for (int i = 0; i <= 20; ++i) hidden.step({{1, 1.0, 0.0, 0.06}}, 0.02 * i, 0.02 * (i % 5), 0);
  for (int i = 0; i < 10; ++i) hidden.step({{2, 0.8, 0.0, 0.06}}, 0.4, 0, 0);
  EXPECT_EQ(hidden.objects()[0]->missed_for, 0);
}

// Half a second and at least five frames, at any rate.
TEST(Map, AMissingObjectIsRefutedInTimeNotInFrames) {
  for (const int ticks : {200, 1000, 2000}) {
    Drive<config::Small> drive;
    for (int i = 0; i <= 20; ++i) drive.step({{1, 1.0, 0.0, 0.06}}, 0.02 * i, 0.02 * (i % 5), 0);
    sensor::BlobFrame last = drive.look({}, 0.4, 0, 0);
    int frames = 0;
    for (; !drive.objects()[0]->refuted() && frames < 100; ++frames) {
      last.frame = drive.frame++;
      last.t.raw += ticks;
      drive.take(last, 0.4, 0, 0);
    }
    EXPECT_LE(frames, std::max(5, 5000 / ticks)) << ticks;
    EXPECT_GE(frames, std::max(5, 5000 / ticks - 4)) << ticks;  // the first of them comes later than the others
  }
}

TEST(Map, HeightBandFollowsFromTheRows) {
  const std::vector<Post> posts = {{1, 1.0, 0.0, 0.06}};
  Drive<config::Small> drive;
  for (int i = 0; i < 30; ++i) drive.step(posts, 0, 0.02 * i, 0);
  const auto& object = *drive.objects()[0];
  const auto& estimate = object.cylinder.estimate();
  const recon::HeightRange band = object.band.at(estimate.center, estimate.radius);
  ASSERT_TRUE(band.top_known);
  EXPECT_NEAR(band.z_min, 0.0F, 0.004F);
  EXPECT_NEAR(band.z_max, 0.10F, 0.004F);
}

// Something new in every frame, and something near. Each object that is seen still has its turn in bounded time, the
// near one more often than others. A new one has it in the frame that shows it first, if no object has waited long.
TEST(Map, EveryObjectThatIsSeenHasItsTurnOfTheModels) {
  constexpr int kBound = 3 * static_cast<int>(config::Micro::kObjects) + 2;
  const std::vector<Post> kept = {{1, 0.8, 0.1, 0.04}, {2, 1.6, -0.1, 0.04}, {3, 1.6, 0.4, 0.04}};
  Drive<config::Micro> drive;
  drive.step({kept[0]}, 0, 0, 0);
  EXPECT_EQ(drive.objects()[0]->waiting, 0);
  std::array<int, 4> turns{};
  int longest = 0;
  for (int i = 1; i < 200; ++i) {
    std::vector<Post> posts = kept;
    posts.push_back({static_cast<std::uint8_t>(4 + i % 100), 1.6, -0.4, 0.04});  // never the same again
    drive.step(posts, 0, 0.0005 * i, 0);
    ASSERT_EQ(drive.map->size(), 4U);
    int modelled = 0;
    for (const auto* object : drive.objects()) {
      const bool now = object->waiting == 0;
      modelled += now ? 1 : 0;
      if (object->signature > 3) continue;
      turns.at(object->signature) += now ? 1 : 0;
      longest = std::max<int>(longest, object->waiting);
    }
    EXPECT_EQ(modelled, 1) << i;
  }
  EXPECT_LE(longest, kBound);
  EXPECT_GT(longest, 4);  // those that are new did go first
  EXPECT_GT(turns[1], turns[2]);
  EXPECT_GT(turns[2], 200 / kBound);
  EXPECT_GT(turns[3], 200 / kBound);
}

// If there is a turn for each object, no sighting is left out.
TEST(Map, ModelsTakeAllSightingsWhereThereIsATurnForEach) {
  Drive<host::Compared<config::Full>> drive;
  for (int i = 0; i < 20; ++i)
    drive.step({{1, 1.5, 0.3, 0.04}, {2, 1.8, 0.0, 0.06}, {3, 1.8, -0.4, 0.06}}, 0, 0.01 * i, 0);
  ASSERT_EQ(drive.map->size(), 3U);
  for (const auto* object : drive.objects()) EXPECT_EQ(object->comparison.get<recon::CylinderPaper>().views(), 20);
}

// --- events ---

std::vector<recon::EventKind> kinds(std::span<const recon::ObjectEvent> events) {
  std::vector<recon::EventKind> found;
  for (const recon::ObjectEvent& event : events) found.push_back(event.kind);
  return found;
}

// Over a long drive among posts that come and go, what events say is what the table holds, frame by frame.
TEST(MapEvents, AccountForEveryObjectInTheTable) {
  Drive<config::Micro> drive;
  std::mt19937 random(11);
  std::map<recon::EventKind, int> seen;
  std::map<std::size_t, std::uint32_t> slots;  // by the events
  std::vector<Post> posts;
  for (int i = 0; i < 6000; ++i) {
    if (random() % 20 == 0) posts.clear();  // the scene changes
    const std::size_t shown = posts.empty() ? random() % 5 : 0;
    for (std::size_t p = 0; p < shown; ++p) {
      posts.push_back({static_cast<std::uint8_t>(1 + random() % 2), 0.8 + 0.3 * static_cast<double>(random() % 5),
                       0.15 * (static_cast<double>(random() % 7) - 3), 0.05});
    }
    std::vector<Post> delivered;  // a camera misses some
    for (const Post& post : posts) {
      if (random() % 8 != 0) delivered.push_back(post);
    }
    drive.step(delivered, 0.001 * (i % 50), 0.02 * std::sin(0.1 * i), 0);
    for (const recon::ObjectEvent& event : drive.map->events()) {
      ++seen[event.kind];
      ASSERT_NE(event.id, 0U);
      if (event.kind == recon::EventKind::kBorn) {
        ASSERT_FALSE(slots.contains(event.slot)) << "frame " << i;
        slots[event.slot] = event.id;
        continue;
      }
      ASSERT_EQ(slots[event.slot], event.id) << "frame " << i;
      if (recon::ends(event.kind)) slots.erase(event.slot);
    }
    std::size_t used = 0;
    for (std::size_t slot = 0; slot < drive.map->slots().size(); ++slot) {
      const auto& object = drive.map->slots()[slot];
      if (!object.used()) continue;
      ++used;
      ASSERT_EQ(slots[slot], object.id) << "frame " << i;
    }
    ASSERT_EQ(used, slots.size());
  }
  EXPECT_GT(seen[recon::EventKind::kBorn], 100);
  EXPECT_GT(seen[recon::EventKind::kEvicted], 10);
  EXPECT_GT(seen[recon::EventKind::kDeleted], 10);
}

TEST(MapEvents, AnObjectIsBornOnceAndThenOnlySeen) {
  Drive<config::Small> drive;
  drive.step({{1, 1.0, 0.0, 0.05}}, 0, 0, 0);
  EXPECT_EQ(kinds(drive.map->events()), std::vector{recon::EventKind::kBorn});
  drive.step({{1, 1.0, 0.0, 0.05}}, 0, 0.01, 0);
  EXPECT_TRUE(drive.map->events().empty());
}

// One blob becomes two for good: the whole ends and its parts are born. One of them takes its slot, without any of its
// counts.
TEST(MapEvents, PartsOfADividedObjectBeginWithoutItsState) {
  Drive<config::Small> drive;
  for (int i = 0; i < 30; ++i) drive.step({{1, 1.0, 0.0, 0.12}}, 0, 0.01 * i, 0);
  ASSERT_EQ(drive.objects().size(), 1U);
  const std::uint32_t whole = drive.objects()[0]->id;
  bool divided = false;
  for (int i = 30; i < 50 && !divided; ++i) {
    drive.step({{1, 1.0, 0.1, 0.03}, {1, 1.0, -0.1, 0.03}}, 0, 0.01 * i, 0);
    for (const recon::ObjectEvent& event : drive.map->events()) {
      divided = divided || (event.kind == recon::EventKind::kDivided && event.id == whole);
    }
  }
  ASSERT_TRUE(divided);
  ASSERT_EQ(drive.objects().size(), 2U);
  for (const auto* object : drive.objects()) {
    EXPECT_NE(object->id, whole);
    EXPECT_EQ(object->views, 1U);
    EXPECT_EQ(object->in_pieces, 0);
  }
}

// Any change of any input bit that reaches the state changes the digest.
TEST(Map, TheDigestTellsRunsApart) {
  const std::vector<Post> posts = {{1, 1.5, 0.3, 0.04}, {2, 1.8, 0.0, 0.06}};
  const auto digest_with = [&](int changed_frame, int dx1, std::int32_t dpose, int dframe) {
    Drive<config::Small> drive;
    for (int i = 0; i < 20; ++i) {
      sensor::BlobFrame seen = drive.look(posts, 0.01 * i, 0, 0);
      if (i == changed_frame) {
        seen.blobs[0].x1 = static_cast<std::int16_t>(seen.blobs[0].x1 + dx1);
        seen.frame += static_cast<std::uint32_t>(dframe);
      }
      drive.take(seen, 0.01 * i + (i == changed_frame ? dpose * 1e-5 : 0), 0, 0);
    }
    return drive.map->digest();
  };
  const std::uint64_t plain = digest_with(-1, 0, 0, 0);
  EXPECT_EQ(plain, digest_with(-1, 0, 0, 0));
  EXPECT_NE(plain, digest_with(5, 1, 0, 0));
  EXPECT_NE(plain, digest_with(5, 0, 1, 0));
  EXPECT_NE(plain, digest_with(5, 0, 0, 1));
  EXPECT_NE(plain, digest_with(19, 1, 0, 0));
}

// Nothing of the run before is left: neither whose turn it is, nor when models took a frame, nor where the robot stood.
template <class Profile>
void expect_clear_is_new() {
  const std::vector<Post> posts = {{1, 1.5, 0.35, 0.04}, {1, 1.4, -0.3, 0.05}, {2, 1.8, 0.0, 0.06}};
  for (const int before : {1, 7, 23}) {
    Drive<Profile> used;
    for (int i = 0; i < before; ++i) used.step(posts, 0.02 * i, 0.01 * i, 0.01 * i);
    used.map->clear();
    Drive<Profile> fresh;
    for (int i = 0; i < 25; ++i) {
      sensor::BlobFrame seen = fresh.look(posts, 0.015 * i, 0, 0.005 * i);
      seen.t = {1'000 * (before - 1) + 100 + 500 * i};  // 10 ms after the run before
      used.take(seen, 0.015 * i, 0, 0.005 * i);
      fresh.take(seen, 0.015 * i, 0, 0.005 * i);
      ASSERT_EQ(used.map->digest(), fresh.map->digest()) << before << " " << i;
    }
    EXPECT_EQ(used.map->frames(), 25U);
  }
}
TEST(Map, AClearedMapIsANewOne) {
  expect_clear_is_new<config::Micro>();
  expect_clear_is_new<config::Small>();
  expect_clear_is_new<config::Full>();
}

// --- many maps on a lattice ---

/// Posts and a robot on a lattice of places, headings and times, with libm nowhere: places in the image are quotients
/// of lattice points. Blobs are lost, doubled, split, widened and recoloured; what the whole algorithm makes of it is
/// the chain of its digests.
template <class Profile>
void tell_map(Draw& draw, Sweep& sweep, int frames) {
  const auto map = std::make_unique<recon::Map<Profile>>();
  struct Thing {
    std::uint8_t signature;
    int x, y;  // in 1/16 m
    bool moves;
  };
  std::vector<Thing> things;
  for (int i = draw.between(2, 12); i > 0; --i) {
    things.push_back({draw.between<std::uint8_t>(1, 2), draw.between(12, 36), draw.between(-14, 14), draw.one_in(8)});
  }
  const bool corrects = draw.coin();
  const recon::CorrectionOrder order{corrects ? 0.0625F : 0.0F, draw.coin()};
  base::Time t{10'000};
  int x = 0, y = 0;  // in 1/16 m
  recon::MapPose odometry;
  recon::CameraModel seen_by = camera(!draw.one_in(6));
  for (int frame = 0; frame < frames; ++frame) {
    t = t + base::Duration{draw.of({200, 500, 600, 1'000, 1'000, 2'000, 5'000, 10'000})};
    if (draw.one_in(40)) t = t + base::Duration{draw.of({15'000, 50'000, 50'001})};
    if (draw.one_in(3)) x += draw.of({0, 1, 1, -1});
    if (draw.one_in(3)) y += draw.of({0, 1, -1});
    odometry.position = {x * 6'250, y * 6'250 + (corrects ? 40 * frame : 0)};
    WaitingFrame seen{t, static_cast<std::uint32_t>(frame), 0, {}};
    for (Thing& thing : things) {
      if (thing.moves && draw.coin()) thing.y += draw.of({1, -1});
      const double ahead = (thing.x - x) / 16.0, left = (thing.y - y) / 16.0;
      if (ahead < 0.25 || draw.one_in(8)) continue;
      const auto at = [&](double aside) { return static_cast<int>(157.5 - 273.6 * aside / ahead + 0.5); };
      int x1 = at(left + 0.0625), x2 = at(left - 0.0625) - 1;
      if (draw.one_in(10)) x2 += draw.of({-6, 6, 25});
      const int y2 = static_cast<int>(103.5 + 273.6 * 0.12 / ahead) + draw.of({0, 0, 0, 1, 8});
      x1 = std::clamp(x1, 0, 315);
      x2 = std::clamp(x2, 0, 315);
      const auto add = [&](int from, int to) {
        const auto px = [](int value) { return static_cast<std::int16_t>(value); };
        const std::uint8_t signature = draw.one_in(60) ? std::uint8_t{2} : thing.signature;
        if (to > from) {
          static_cast<void>(
              seen.blobs.push_back({{px(from), 80, px(to), px(std::min(y2, 207))}, signature, thing.moves}));
        }
      };
      if (draw.one_in(10)) {
        add(x1, (x1 + x2) / 2 - 2);
        add((x1 + x2) / 2 + 2, x2);
      } else {
        add(x1, x2);
      }
    }
    const recon::FrameOutcome outcome = map->add_frame(seen, seen_by, odometry, {}, {2, 4}, order);
    sweep.tell("digest", static_cast<std::uint32_t>(map->digest()));
    sweep.tell("matched", outcome.matched);
    sweep.tell("born", outcome.born);
    sweep.tell("pieces", outcome.pieces);
    sweep.tell("refused", outcome.refused);
    for (const recon::ObjectEvent& event : map->events())
      sweep.tell("event", 16 * static_cast<int>(event.kind) + event.slot);
    if (draw.one_in(50)) {
      map->recalibrated();
      sweep.tell("guard", map->guard().fronts().size());
    }
    if (!draw.one_in(100)) continue;
    map->clear();
    sweep.tell("size", map->size());
  }
  sweep.tell("evicted", map->evicted());
}

TEST(Map, OfThingsOnALattice) {
  Draw draw(171);
  Sweep sweep;
  for (int run = 0; run < 6; ++run) {
    tell_map<config::Micro>(draw, sweep, 60);
    tell_map<config::Small>(draw, sweep, 60);
    tell_map<config::Full>(draw, sweep, 40);
  }
  expect_said(sweep, {"digest 960 d520af65", "matched 925 e322db86", "born 187 82779864", "pieces 213 6d412a13",
                      "refused 199 efc0c148", "event 1028 a7a9830e", "guard 0 654737f8", "evicted 6 b7e768a9",
                      "size 0 69488d24"});
}

}  // namespace
}  // namespace fencepost::test
