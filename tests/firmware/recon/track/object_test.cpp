// The parts of an object that do not depend on its models: saturating counts, bounds in frames, and its confidence.
#include "firmware/recon/track/object.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::End;
using recon::ObjectCore;

TEST(SightingHistory, CountsTheLastSixteenAtMost) {
  recon::SightingHistory history;
  for (int i = 0; i < 20; ++i) {
    history.push(i % 3 != 0);
    EXPECT_EQ(history.length, std::min(i + 1, 16));
  }
  // Frames 0, 3, ..., 18 did not show it; the newest is number 19.
  for (int n = 0; n <= 18; ++n) {
    int seen = 0;
    for (int back = 0; back < std::min(n, 16); ++back) seen += (19 - back) % 3 != 0 ? 1 : 0;
    EXPECT_EQ(history.seen_of_last(n), seen) << n;
  }
}

TEST(ObjectCore, WaitsForNoMoreThanItCanCount) {
  ObjectCore object;
  for (int i = 1; i <= 300; ++i) {
    object.track(End::kSeen, End::kLowerBound, base::Time{i});
    ASSERT_EQ(object.waiting, std::min(i, 0xFF));
  }
  EXPECT_EQ(object.views, 300U);
  EXPECT_EQ(object.last_seen.raw, 300);
  EXPECT_TRUE(object.cut_off());
  object.track(End::kAmbiguous, End::kSeen, base::Time{301});
  EXPECT_FALSE(object.cut_off());
  object.track(End::kOccluded, End::kSeen, base::Time{302});
  EXPECT_TRUE(object.cut_off());
}

TEST(ObjectCore, IsContradictedByTenFramesOfOneEndAndRefutedByHalfASecond) {
  ObjectCore object;
  EXPECT_FALSE(object.placed());
  object.relocations = 1;
  EXPECT_TRUE(object.placed());
  for (const int off : {9, 10, -9, -10}) {
    for (const int other : {0, 1, -1, 30, -30}) {
      object.left_off = static_cast<std::int8_t>(off);
      object.right_off = static_cast<std::int8_t>(other);
      const bool expected = off * other <= 0 && (off == 10 || off == -10 || other == 30 || other == -30);
      EXPECT_EQ(object.contradicted(), expected) << off << " " << other;
      std::swap(object.left_off, object.right_off);
      EXPECT_EQ(object.contradicted(), expected) << other << " " << off;
    }
  }
  object.left_off = object.right_off = 0;
}

// Frames 0.08 s apart. The seventh that lacks it refutes it; one sighting does not bring it back.
TEST(ObjectCore, IsRefutedByWhatIsMissing) {
  constexpr base::Duration kFrame = base::milliseconds(80);
  ObjectCore object;
  const auto frames = [&](bool seen, int count) {
    for (int i = 0; i < count; ++i) object.weigh(seen, kFrame);
    return object.refuted();
  };
  EXPECT_FALSE(frames(false, 6));
  EXPECT_TRUE(frames(false, 1));
  EXPECT_FALSE(frames(true, 1)) << "missed hardly longer than that";
  EXPECT_TRUE(frames(false, 1000));
  EXPECT_TRUE(frames(true, 3)) << "missed for long";
  EXPECT_FALSE(frames(true, 1));
  EXPECT_FALSE(frames(true, 1000));
  EXPECT_FALSE(frames(false, 6)) << "sightings are no credit";
  EXPECT_TRUE(frames(false, 1));
}

TEST(ObjectCore, OfACameraThatMissesEverySecondFrameIsThere) {
  ObjectCore object;
  for (int i = 0; i < 1000; ++i) {
    object.weigh(i % 2 == 0, base::milliseconds(100));
    ASSERT_FALSE(object.refuted()) << i;
  }
}

// Circles of 0.28 m on a lattice, known by up to four views. Compared are whether two are in one place, how sure they
// are, and what a view from elsewhere is worth.
TEST(ObjectCore, OfCirclesOnALattice) {
  Draw draw(181);
  Sweep sweep;
  const auto any = [&] {
    ObjectCore object;
    object.origin = {draw.between(-4, 4) * 7'000, draw.between(-1, 1) * 7'000};
    object.presence = draw.of({1.0F, 0.5F, 0.25F});
    if (draw.one_in(4)) object.outline_confidence = draw.of<std::uint8_t>({0, 74, 200, 254});
    for (int i = draw.between(0, 4); i > 0; --i) {
      const recon::Vec2 side = draw.of<recon::Vec2>({{1, 0}, {0.6F, 0.8F}, {0.6F, -0.8F}, {0, 1}});
      recon::Sighting sighting;
      sighting.axis = sighting.center = side;
      sighting.lens = -side;
      sighting.left = {recon::rotated(side, {0.96F, 0.28F}), End::kSeen};
      sighting.right = {recon::rotated(side, {0.96F, -0.28F}), End::kSeen};
      sighting.focal = 256;
      object.cylinder.add(sighting, {}, 1, {});
      object.cylinder.solve(sighting.lens, side, {});
      object.last_lens = sighting.lens;
    }
    return object;
  };
  for (int i = 0; i < 4'000; ++i) {
    const ObjectCore one = any();
    const ObjectCore other = any();
    sweep.tell("one place", recon::stand_in_one_place(one, other));
    sweep.tell("confidence", one.confidence());
    sweep.tell("novelty", one.novelty(one.last_lens + recon::Vec2(draw.steps(-4, 4, 0.0078125F), 0)));
    base::Fnv1a64 hash;
    one.hash(hash);
    sweep.tell("digest", static_cast<std::uint32_t>(hash.value()));
  }
  expect_said(sweep,
              {"one place 792 0fa76b2b", "confidence 2303 b0189fb9", "novelty 4000 5f3c558f", "digest 4000 5afb9416"});
}

}  // namespace
}  // namespace fencepost::test
