// Ids of a camera that tracks: right ones keep equal things apart where place swaps them, wrong ones do little harm.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/recon/map.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/post_world.hpp"

namespace fencepost::test {
namespace {

/// The id of a post in a frame; 0: none.
using IdOf = std::function<std::uint16_t(std::size_t post)>;

const IdOf kNoIds = [](std::size_t /*post*/) { return std::uint16_t{0}; };
const IdOf kRightIds = [](std::size_t post) { return static_cast<std::uint16_t>(7 + post); };

/// A map, and which post each of its objects took in the latest frame that showed it.
class Watch {
 public:
  struct Pose {
    double x = 0;
    double y = 0;
    double heading = 0;
  };

  /// One frame of the posts, seen from `at`; odometry says `told`. Frames are 50 ms apart.
  void step(const std::vector<RoundPost>& posts, const IdOf& id_of, Pose at, Pose told) {
    sensor::BlobFrame frame{{500 * number_}, static_cast<std::uint32_t>(number_), {}};
    ++number_;
    std::vector<std::size_t> owners;
    for (std::size_t i = 0; i < posts.size(); ++i) {
      for (sensor::Blob blob : view_of_posts({posts[i]}, {}, at.x, at.y, at.heading, 0, 0).blobs) {
        blob.track = id_of(i);
        ASSERT_TRUE(frame.blobs.push_back(blob));
        owners.push_back(i);
      }
    }
    for (; merges_ && frame.blobs.size() > 1; frame.blobs.pop_back()) {
      sensor::Blob& first = frame.blobs[0];
      const sensor::Blob& other = frame.blobs[frame.blobs.size() - 1];
      first.x1 = std::min(first.x1, other.x1);
      first.x2 = std::max(first.x2, other.x2);
      first.y1 = std::min(first.y1, other.y1);
      first.y2 = std::max(first.y2, other.y2);
    }
    recon::WaitingFrame waiting = recon::make_waiting(frame, 0);
    const auto raw = [](double value, double per_unit) {
      return static_cast<std::int32_t>(std::lround(value * per_unit));
    };
    map_->add_frame(waiting, camera_, {{raw(told.x, 1e5), raw(told.y, 1e5)}, raw(told.heading, 1e6)}, {}, {});
    for (std::size_t slot = 0; slot < config::Small::kObjects; ++slot) {
      if (!map_->seen_now(slot)) continue;
      const recon::Box& box = waiting.blobs[map_->blob_of(slot)].box;
      for (std::size_t b = 0; b < frame.blobs.size(); ++b) {
        const sensor::Blob& blob = frame.blobs[b];
        if (blob.x1 == box.x1 && blob.x2 == box.x2 && blob.y2 == box.y2) took(map_->slots()[slot].id, owners[b]);
      }
    }
  }
  void step(const std::vector<RoundPost>& posts, const IdOf& id_of, Pose at) { step(posts, id_of, at, at); }
  /// The camera has one box around all posts from now on, with the id of the first.
  void merge_boxes() { merges_ = true; }

  [[nodiscard]] int swaps() const { return swaps_; }
  [[nodiscard]] const recon::Map<config::Small>& map() const { return *map_; }

 private:
  void took(std::uint32_t object, std::size_t post) {
    const auto [at, is_new] = posts_of_.try_emplace(object, post);
    if (!is_new && at->second != post) ++swaps_;
    at->second = post;
  }

  std::unique_ptr<recon::Map<config::Small>> map_ = std::make_unique<recon::Map<config::Small>>();
  recon::CameraModel camera_ = recon::make_camera_model(level_pixy2(0));
  std::map<std::uint32_t, std::size_t> posts_of_;
  std::int64_t number_ = 1;
  int swaps_ = 0;
  bool merges_ = false;
};

// Equal posts in a row. Somebody turns the robot by the angle from one to the next, which odometry does not notice.
Watch knocked(const IdOf& id_of) {
  Watch watch;
  const std::vector<RoundPost> posts = {{1, 1.0, -0.12, 0.04}, {1, 1.0, 0.0, 0.04}, {1, 1.0, 0.12, 0.04}};
  for (int i = 0; i < 20; ++i) watch.step(posts, id_of, {0, 0.01 * i - 0.1, 0});
  const double knock = std::atan2(0.12, 1.0);
  for (int i = 0; i < 3; ++i) watch.step(posts, id_of, {0, 0.1, knock}, {0, 0.1, 0});
  return watch;
}

TEST(CameraIds, KeepARowOfEqualThingsWhereAKnockSwapsThem) {
  const Watch by_place = knocked(kNoIds);
  EXPECT_GE(by_place.swaps(), 2);
  const Watch by_ids = knocked(kRightIds);
  EXPECT_EQ(by_ids.swaps(), 0);
  EXPECT_EQ(by_ids.map().size(), 3U);
}

// Two equal things pass one behind the other, at 0.1 m/s each.
Watch crossed(const IdOf& id_of, double depth) {
  Watch watch;
  for (int i = 0; i < 40; ++i) {
    const double way = 0.005 * (i - 20);
    watch.step({{1, depth, 0.02 + way, 0.04}, {1, 1.2, -0.02 - way, 0.04}}, id_of, {});
  }
  return watch;
}

TEST(CameraIds, FollowEqualThingsThatCross) {
  for (const double depth : {1.0, 1.1, 1.19}) {
    EXPECT_EQ(crossed(kNoIds, depth).swaps(), 2) << depth;
    EXPECT_EQ(crossed(kRightIds, depth).swaps(), 0) << depth;
  }
}

/// m, from each post to the nearest object's centre, the largest.
double farthest_off(const Watch& watch, const std::vector<RoundPost>& posts) {
  double farthest = 0;
  for (const RoundPost& post : posts) {
    double nearest = 10;
    for (const auto& object : watch.map().slots()) {
      if (!object.used() || !object.confirmed || !object.cylinder.estimate().ok()) continue;
      const recon::Vec2 centre = object.cylinder.estimate().center;
      nearest = std::min(nearest, std::hypot(object.origin.x * 1e-5 + static_cast<double>(centre.x()) - post.x,
                                             object.origin.y * 1e-5 + static_cast<double>(centre.y()) - post.y));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

// Each box has an id at random in each frame.
TEST(CameraIds, WrongOnesDoLittleHarm) {
  const std::vector<RoundPost> posts = {
      {1, 1.5, 0.35, 0.04}, {1, 1.4, -0.3, 0.05}, {1, 1.8, 0.0, 0.06}, {1, 1.2, 0.1, 0.03}};
  const auto drive = [&](const IdOf& id_of) {
    Watch watch;
    for (int i = 0; i < 60; ++i) {
      const double y = 0.3 * std::sin(0.1 * i);
      watch.step(posts, id_of, {0.008 * i, y, -0.15 * y});
    }
    return watch;
  };
  const Watch none = drive(kNoIds);
  const double by_place = farthest_off(none, posts);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const Watch watch = drive([&](std::size_t) { return static_cast<std::uint16_t>(1 + random() % recon::kMaxTrack); });
    EXPECT_EQ(watch.map().size(), posts.size());
    EXPECT_LT(farthest_off(watch, posts), by_place + 0.01);
  }
}

TEST(CameraIds, AreForgottenAfterAMoment) {
  Watch watch;
  const std::vector<RoundPost> post = {{1, 1.0, 0.0, 0.04}};
  const auto last_track = [&] { return watch.map().slots()[0].last_track; };
  watch.step(post, kRightIds, {});
  EXPECT_EQ(last_track(), 7);
  for (int i = 0; i < 10; ++i) watch.step({}, kRightIds, {});  // 0.5 s
  EXPECT_EQ(last_track(), 7);
  watch.step({}, kRightIds, {});
  EXPECT_EQ(last_track(), 0);
  watch.step(post, kRightIds, {});
  EXPECT_EQ(last_track(), 7);
  watch.step(post, kNoIds, {});
  EXPECT_EQ(last_track(), 0) << "the camera has lost it";
}

TEST(CameraIds, StayWithTwoObjectsInOneBox) {
  Watch watch;
  const std::vector<RoundPost> posts = {{1, 1.0, 0.05, 0.04}, {1, 1.0, -0.05, 0.04}};
  for (int i = 0; i < 20; ++i) watch.step(posts, kRightIds, {0, 0.01 * i - 0.1, 0});
  watch.merge_boxes();
  for (int i = 0; i < 3; ++i) watch.step(posts, kRightIds, {0, 0.1, 0});
  ASSERT_EQ(watch.map().size(), 2U);
  std::vector<int> ids;
  for (std::size_t slot = 0; slot < 2; ++slot) {
    EXPECT_TRUE(watch.map().seen_now(slot));
    ids.push_back(watch.map().slots()[slot].last_track);
  }
  std::ranges::sort(ids);
  EXPECT_EQ(ids, (std::vector<int>{7, 8}));
}

TEST(CameraIds, AreInTheDigestWhereThereIsOne) {
  const std::vector<RoundPost> post = {{1, 1.0, 0.0, 0.04}};
  const auto digest = [&](const IdOf& id_of) {
    Watch watch;
    for (std::size_t i = 0; i < config::Small::kObjects; ++i) watch.step(post, id_of, {});
    return watch.map().digest();
  };
  EXPECT_NE(digest(kNoIds), digest(kRightIds));
  EXPECT_NE(digest([](std::size_t) { return std::uint16_t{8}; }), digest(kRightIds));
}

TEST(CameraIds, AreKeptInSixBits) {
  sensor::BlobFrame frame;
  for (const auto id : std::vector<std::uint16_t>{0, 1, 63, 64, 65'535}) {
    sensor::Blob blob;
    blob.track = id;
    blob.x1 = blob.x2 = static_cast<std::int16_t>(frame.blobs.size());
    ASSERT_TRUE(frame.blobs.push_back(blob));
  }
  std::vector<int> kept;
  for (const recon::WaitingBlob& blob : recon::make_waiting(frame, 0).blobs) kept.push_back(blob.track);
  EXPECT_EQ(kept, (std::vector<int>{0, 1, 63, 1, 15}));
}

// However a camera lists them: by signature, x1, y1, x2, y2, whether they have a width, and id.
TEST(CameraIds, AreLastInTheOrderOfBlobs) {
  std::vector<recon::WaitingBlob> ordered;
  for (unsigned i = 0; i < 14; ++i) {
    const auto bit = [i](unsigned k) { return static_cast<std::int16_t>(i < 7 ? i == k : i - 7 != k); };
    recon::WaitingBlob blob{{bit(1), bit(2), bit(3), bit(4)}, static_cast<std::uint8_t>(bit(0)), false, bit(5) != 0};
    blob.track = static_cast<std::uint8_t>(bit(6)) & 1U;
    ordered.push_back(blob);
  }
  const auto key = [](const recon::WaitingBlob& b) {
    return std::array<int, 7>{b.signature, b.box.x1, b.box.y1, b.box.x2, b.box.y2, b.bearing, b.track};
  };
  const auto before = [&](const auto& a, const auto& b) { return key(a) < key(b); };
  std::sort(ordered.begin(), ordered.end(), before);
  std::mt19937 random(3);
  for (int times = 0; times < 20; ++times) {
    std::vector<recon::WaitingBlob> listed = ordered;
    std::shuffle(listed.begin(), listed.end(), random);
    recon::WaitingFrame frame;
    for (const recon::WaitingBlob& blob : listed) ASSERT_TRUE(frame.blobs.push_back(blob));
    recon::put_in_order(frame);
    for (std::size_t i = 0; i < ordered.size(); ++i) EXPECT_EQ(key(frame.blobs[i]), key(ordered[i])) << i;
  }
}

TEST(CameraIds, SpeakForAPairOrAgainstIt) {
  EXPECT_EQ(recon::cost_with_ids(80, 7, 7, 48), 32);
  EXPECT_EQ(recon::cost_with_ids(30, 7, 7, 48), 0);
  EXPECT_EQ(recon::cost_with_ids(80, 7, 8, 48), 128);
  EXPECT_EQ(recon::cost_with_ids(240, 7, 8, 48), recon::kImpossible - 1);
  for (const std::uint8_t cost : {std::uint8_t{0}, std::uint8_t{80}, recon::kImpossible}) {
    EXPECT_EQ(recon::cost_with_ids(cost, 0, 8, 48), cost);
    EXPECT_EQ(recon::cost_with_ids(cost, 8, 0, 48), cost);
  }
  EXPECT_EQ(recon::cost_with_ids(recon::kImpossible, 7, 7, 48), recon::kImpossible);
  EXPECT_EQ(recon::cost_with_ids(recon::kImpossible, 7, 8, 48), recon::kImpossible);
}

// 64 to 1 at first are six octaves. One more change makes 64 to 2.
TEST(CameraIds, WeighByTheOddsThatTheyStay) {
  recon::IdEvidence ids;
  EXPECT_EQ(ids.cost(), 6 * recon::kCostOfOctave);
  ids.count(false);
  EXPECT_EQ(ids.cost(), 5 * recon::kCostOfOctave);
  for (int i = 0; i < 1'000; ++i) ids.count(true);
  EXPECT_EQ(ids.cost(), 6 * recon::kCostOfOctave);
  for (int i = 0; i < 1'000; ++i) ids.count(i % 2 == 0);
  EXPECT_LE(ids.cost(), recon::kCostOfOctave);
  for (int i = 0; i < 1'000; ++i) ids.count(i % 20 != 0);  // 19 to 1: four octaves
  EXPECT_EQ(ids.cost(), 4 * recon::kCostOfOctave);
}

}  // namespace
}  // namespace fencepost::test
