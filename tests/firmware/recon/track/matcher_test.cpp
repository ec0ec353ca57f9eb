// The matcher by itself: objects that are where the test says, and blobs that are almost there.
#include "firmware/recon/track/matcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

struct Thing : recon::ObjectCore {
  static constexpr bool kPredictsByOutline = false;
};
constexpr std::size_t kThings = 4;
constexpr base::Time kNow{10'000};
using Things = std::array<Thing, kThings>;
using Matcher = recon::Matcher<Thing, kThings>;

/// Each object is a circle here, whatever its models say.
struct Places {
  std::array<std::optional<recon::CylinderEstimate>, kThings> circles;

  template <class IsAlone>
  const std::optional<recon::CylinderEstimate>& operator()(const Thing& /*object*/, std::size_t slot,
                                                           const IsAlone& /*is_alone*/) const {
    return circles[slot];
  }
};

recon::CylinderEstimate circle_at(float x, float y) {
  recon::CylinderEstimate estimate;
  estimate.center = {x, y};
  estimate.radius = 0.0625F;
  estimate.covariance = {1e-5F, 0, 1e-5F, 0, 0, 1e-5F};
  estimate.refusal = recon::CylinderRefusal::kNone;
  return estimate;
}

void tell_matches(Sweep& sweep, const Matcher& matcher, const Things& things) {
  for (std::size_t o = 0; o < kThings; ++o) {
    sweep.tell("blob", matcher.seen(o) ? matcher.blob_of(o) + 1 : 0);
    sweep.tell("in pieces", matcher.in_pieces(o));
    sweep.tell("may be hidden", things[o].used() && matcher.may_be_hidden(o));
    sweep.tell("divided", matcher.prediction(o).divided);
    if (!matcher.seen(o)) continue;
    const recon::Observation seen = matcher.observation_of(o);
    sweep.tell("left end", static_cast<int>(seen.left));
    sweep.tell("right end", static_cast<int>(seen.right));
    sweep.tell("top", static_cast<int>(seen.top));
    sweep.tell("bottom", static_cast<int>(seen.bottom));
    sweep.tell("foot", matcher.foot_of(o));
  }
  for (std::size_t b = 0; b < matcher.observations().size(); ++b) {
    sweep.tell("taken", matcher.taken(b));
    sweep.tell("piece of", static_cast<int>(matcher.piece_of(things, b)));
    const recon::Prediction* divided = matcher.divided_at(matcher.observations()[b]);
    sweep.tell("part of", divided != nullptr ? 1 + divided->signature : 0);
  }
}

TEST(Matcher, OfObjectsThatAlmostTouchAndBlobsThatAreAlmostTheirs) {
  Draw draw(61);
  Sweep sweep;
  const recon::CameraModel camera = recon::make_camera_model(level_pixy2(0));
  for (int run = 0; run < 6'000; ++run) {
    const auto matcher = std::make_unique<Matcher>();
    Things things;
    Places places;
    recon::WaitingFrame frame{kNow, 0, 0, {}};
    for (std::size_t o = 0; o < kThings; ++o) {
      if (draw.one_in(5)) continue;
      Thing& thing = things[o];
      thing.id = static_cast<std::uint32_t>(o + 1);
      thing.signature = draw.one_in(4) ? 2 : 1;
      thing.confirmed = draw.coin();
      thing.moving = draw.one_in(6);
      thing.last_seen = {draw.of<std::int64_t>({899, 900, 901})};
      thing.foot_row = draw.of<std::int16_t>({0, 130, 140});
      thing.missed_for = draw.of<std::uint16_t>({0, 4'999, 5'000});
      thing.in_pieces = draw.between<std::uint8_t>(0, 2);
      thing.left = thing.right = recon::End::kSeen;
      const float x = draw.of({1.0F, 1.0F, 1.0625F, 0.75F});
      const float y = draw.steps(-6, 6, 0.03125F);
      if (!draw.one_in(6)) places.circles[o] = circle_at(x, y);
      thing.last_bearing = recon::Vec2(x, y) / std::sqrt(x * x + y * y);
      if (draw.one_in(5)) continue;
      // Its blob, a few pixels off; or its two ends.
      const double middle = 157.5 - 273.6 * static_cast<double>(y) / static_cast<double>(x);
      const auto half = static_cast<int>(17 / static_cast<double>(x));
      const int left = static_cast<int>(middle) - half + draw.of({0, 0, 2, -4, 9});
      const int right = static_cast<int>(middle) + half + draw.of({0, 0, 2, -4, 17, 34});
      const int foot = 103 + static_cast<int>(35 / static_cast<double>(x)) + draw.of({0, 0, 1, 3, -7, 12});
      const auto blob = [&](int from, int to, int low) {
        const auto px = [](int value) { return static_cast<std::int16_t>(value); };
        if (to >= from) {
          static_cast<void>(frame.blobs.push_back({{px(from), 90, px(to), px(low)}, thing.signature, draw.one_in(10)}));
        }
      };
      if (draw.one_in(3)) {
        blob(left, left + half - draw.of({2, 8}), foot);
        const int gap = draw.of({2, 4});
        blob(left + half + gap, right, foot + draw.of({0, 0, 5, 6, -5, -6}));
      } else {
        blob(left, right, foot);
      }
    }
    matcher->predict(things, kNow, {900}, camera, recon::lens_pose({}, camera), {}, places);
    matcher->observe(frame, camera, things);
    matcher->tell_widths([](std::uint8_t signature) { return static_cast<std::uint16_t>(10 * signature); });
    sweep.tell("matched", matcher->match(0));
    tell_matches(sweep, *matcher, things);
    if (matcher->observations().empty()) continue;
    matcher->count_as_pieces(0, static_cast<std::size_t>(draw.between(0, 5)));
    if (!matcher->taken(0)) matcher->begin(static_cast<std::size_t>(draw.between(0, 3)), 0);
    matcher->end(static_cast<std::size_t>(draw.between(0, 3)));
    tell_matches(sweep, *matcher, things);
  }
  expect_said(sweep, {"matched 5783 597f81f4", "blob 25788 30faa70e", "in pieces 4375 98f90b1e",
                      "may be hidden 32382 ce6a682e", "divided 1320 04c819b1", "left end 8638 d84976fd",
                      "right end 8608 4eabbed9", "top 718 d8d5a798", "bottom 6142 820a7640", "foot 25788 1a5bd3af",
                      "taken 25915 90c373d9", "piece of 30145 7f2c6d43", "part of 1622 fd2feffb"});
}

Thing known_thing(std::uint32_t id, std::uint8_t signature) {
  Thing thing;
  thing.id = id;
  thing.signature = signature;
  thing.confirmed = true;
  thing.left = thing.right = recon::End::kSeen;
  return thing;
}

// After one frame with one box of signature 1.
std::unique_ptr<Matcher> after_box(const Things& things, const Places& places, std::int16_t left, std::int16_t right) {
  const recon::CameraModel camera = recon::make_camera_model(level_pixy2(0));
  auto matcher = std::make_unique<Matcher>();
  recon::WaitingFrame frame{kNow, 0, 0, {}};
  static_cast<void>(frame.blobs.push_back({{left, 90, right, 138}, 1, false}));
  matcher->predict(things, kNow, {900}, camera, recon::lens_pose({}, camera), {}, places);
  matcher->observe(frame, camera, things);
  matcher->match(0);
  return matcher;
}

TEST(Matcher, OneOfItsColourIsTheOneAfterATimeOutOfView) {
  for (const bool namesake : {false, true}) {
    for (const std::int64_t unseen : {recon::kMoment.raw - 1, recon::kMoment.raw}) {
      Things things;
      Places places;
      things[0] = known_thing(1, 1);
      things[0].last_seen = {kNow.raw - unseen};
      places.circles[0] = circle_at(1, 0.875F);  // left of the image
      places.circles[0]->covariance.yy = 1;      // or anywhere in it
      things[1] = known_thing(2, namesake ? 1 : 2);
      places.circles[1] = circle_at(-1, 0);
      EXPECT_EQ(after_box(things, places, 220, 254)->seen(0), !namesake && unseen == recon::kMoment.raw);
    }
  }
}

TEST(Matcher, WhatTheFrameRefutesHidesNothing) {
  for (const bool refuted : {false, true}) {
    Things things;
    Places places;
    things[0] = known_thing(1, 1);
    places.circles[0] = circle_at(1, 0);
    things[1] = known_thing(2, 2);  // nearer, before the left end, and without a box of its own
    places.circles[1] = circle_at(0.5F, 0.0625F);
    if (refuted) things[1].missed_for = static_cast<std::uint16_t>(recon::kMoment.raw);
    const auto matcher = after_box(things, places, 140, 174);
    ASSERT_TRUE(matcher->seen(0));
    EXPECT_EQ(matcher->observation_of(0).left, refuted ? recon::End::kSeen : recon::End::kLowerBound);
    EXPECT_EQ(matcher->observation_of(0).right, recon::End::kSeen);
  }
}

// With a wrong pose the map has things before the lens that are elsewhere.
TEST(Matcher, WhatCannotBeInTheImageHidesNothing) {
  Things things;
  Places places;
  things[0] = known_thing(1, 1);
  places.circles[0] = circle_at(1, 0);
  things[1] = known_thing(2, 2);
  places.circles[1] = circle_at(0.5F, 0.4375F);
  places.circles[1]->covariance.yy = 1;
  things[2] = known_thing(3, 2);
  places.circles[2] = circle_at(-1, 0);
  const auto matcher = after_box(things, places, 140, 174);
  ASSERT_TRUE(matcher->seen(0));
  EXPECT_EQ(matcher->observation_of(0).left, recon::End::kSeen);
  EXPECT_EQ(matcher->observation_of(0).right, recon::End::kSeen);
}

// A slot that is free now predicts and sees nothing, whatever was in it and wherever the last object is.
TEST(Matcher, ForgetsWhatWasInSlotsThatAreFree) {
  Things things;
  Places places;
  for (std::size_t o = 0; o < kThings; ++o) {
    things[o] = known_thing(static_cast<std::uint32_t>(o + 1), static_cast<std::uint8_t>(o + 1));
    places.circles[o] = circle_at(1, 0);
  }
  const auto matcher = after_box(things, places, 140, 174);
  EXPECT_EQ(matcher->slots(), kThings);
  EXPECT_TRUE(matcher->prediction(3).possible);
  const recon::CameraModel camera = recon::make_camera_model(level_pixy2(0));
  for (const std::size_t last : {2U, 0U}) {
    for (std::size_t o = last + 1; o < kThings; ++o) things[o].id = 0;
    matcher->predict(things, kNow, {900}, camera, recon::lens_pose({}, camera), {}, places);
    EXPECT_EQ(matcher->slots(), last + 1);
    for (std::size_t o = 0; o < kThings; ++o) {
      EXPECT_EQ(matcher->prediction(o).possible, o <= last) << o;
      EXPECT_FALSE(matcher->seen(o)) << o;
    }
  }
  things[0].id = 0;
  matcher->predict(things, kNow, {900}, camera, recon::lens_pose({}, camera), {}, places);
  EXPECT_EQ(matcher->slots(), 0U);
}

}  // namespace
}  // namespace fencepost::test
