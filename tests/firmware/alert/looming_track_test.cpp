// The state of every looming track, to its last bit: integers on every machine. Whoever changes a rule or a constant
// on purpose finds the new numbers in the failure.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "firmware/alert/looming.hpp"
#include "tests/firmware/level_pixy2.hpp"

namespace fencepost::test {
namespace {

/// FNV-1a.
class Hash {
 public:
  void add(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
      hash_ = (hash_ ^ (value >> shift & 0xFFU)) * 0x100'0000'01B3ULL;
    }
  }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  template <class Integer>
  void integer(Integer value) {
    add(static_cast<std::uint32_t>(value));
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF2'9CE4'8422'2325ULL;
};

/// Millimetres from the lens: ahead, to the left; a box of that width and height.
struct LoomingThing {
  int ahead = 1000;
  int left = 0;
  int width = 100;
  int height = 100;
  std::uint8_t signature = 1;
};

class Tracks {
 public:
  explicit Tracks(std::int64_t height_mm = 120) {
    sensor::CameraIntrinsics intrinsics = level_pixy2(0);
    intrinsics.mount.z = {static_cast<std::int32_t>(10 * height_mm)};
    camera_ = recon::make_camera_model(intrinsics);
  }

  /// A frame, `dt` of 10^-4 s after the one before.
  void look(const std::vector<LoomingThing>& things, std::int64_t dt = 400) {
    recon::WaitingFrame frame;
    frame.t = t_ = t_ + base::Duration{dt};
    for (const LoomingThing& thing : things) {
      const std::optional<recon::Box> box = seen(thing);
      if (box) static_cast<void>(frame.blobs.push_back({*box, thing.signature, false}));
    }
    looming_.look(frame, camera_, odometry_ ? &pose_ : nullptr);
    for (const alert::LoomingTrack& track : looming_.tracks()) keep(track);
    for (const recon::WaitingBlob& blob : frame.blobs) {
      hash_.integer(blob.moves);
      moved_ = moved_ || blob.moves;
    }
    const alert::FrontAhead front = looming_.ahead(camera_, path_, rules_, t_ + base::Duration{100});
    highest_ = std::max(highest_, front.due);
    hash_.integer(front.due);
    hash_.integer(front.held);
    if (!front.nearest.known) return;
    for (const float number : {front.nearest.distance, front.nearest.ttc, front.nearest.closing_speed,
                               front.nearest.toward.x(), front.nearest.toward.y(), front.confidence}) {
      hash_.add(number);
    }
    hash_.integer(front.signature);
  }
  /// mm and urad, and how fast it says that it goes.
  void move(int x, int y, int urad, float forward = 0, float turn = 0) {
    pose_.position.x += 100 * x;
    pose_.position.y += 100 * y;
    pose_.heading += urad;
    path_.motion = {forward, turn};
  }
  void odometry(bool there) { odometry_ = there; }
  [[nodiscard]] std::uint64_t digest() const { return hash_.value(); }
  [[nodiscard]] record::AlertLevel highest() const { return highest_; }
  [[nodiscard]] bool moved() const { return moved_; }

 private:
  static constexpr int kFocal = 27'360;  // hundredths of a pixel, as the centre's

  void keep(const alert::LoomingTrack& track) {
    hash_.integer(track.sightings);
    if (!track.used()) return;
    for (const std::int32_t number : {track.depth_variance, track.covariance, track.speed_variance})
      hash_.integer(number);
    for (const int number :
         {int{track.depth}, int{track.speed}, int{track.slope}, int{track.across}, int{track.width}, int{track.unseen},
          int{track.signature}, int{track.sure}, int{track.moved}, int{track.unmeasured}, int{track.low},
          int{track.guessed}, int{track.whole}, int{track.strays}}) {
      hash_.integer(number);
    }
  }
  [[nodiscard]] static std::optional<recon::Box> seen(const LoomingThing& thing) {
    if (thing.ahead < 30) return std::nullopt;
    const auto column = [&](int left) { return (15'750 - kFocal * left / thing.ahead + 50) / 100; };
    const auto row = [&](int up) { return (10'350 - kFocal * up / thing.ahead + 50) / 100; };
    const int x1 = column(thing.left + thing.width / 2);
    const int x2 = column(thing.left - thing.width / 2) - 1;
    const int y1 = row(thing.height - 120);
    const int y2 = row(-120) - 1;
    if (x2 < 0 || x1 > 315 || y1 > 207 || x2 < x1 || y2 < y1) return std::nullopt;
    const auto inside = [](int at, int last) { return static_cast<std::int16_t>(std::clamp(at, 0, last)); };
    return recon::Box{inside(x1, 315), inside(y1, 207), inside(x2, 315), inside(y2, 207)};
  }

  recon::CameraModel camera_;
  alert::Looming<4> looming_;
  alert::RobotPath path_;
  alert::AlertRules rules_{config::Settings{}};
  recon::MapPose pose_;
  bool odometry_ = true;
  base::Time t_{1'000'000};
  record::AlertLevel highest_ = record::AlertLevel::kClear;
  bool moved_ = false;
  Hash hash_;
};

// It comes straight on at 1.5 m/s, and past the robot, below the image at the end.
void comes(Tracks& tracks) {
  for (int ahead = 2'900; ahead > 20; ahead -= 60) tracks.look({{ahead, 40}});
  for (int i = 0; i < 30; ++i) tracks.look({});
}
// 0.5 m/s across, one each way at another distance, of two colours.
void crosses(Tracks& tracks) {
  for (int i = 0; i < 60; ++i) tracks.look({{900, 600 - 20 * i}, {1'500, 30 * i - 900, 120, 80, 2}});
}
// All of it at random: up to six things, each for a while, beside a robot that now stands, drives or turns.
void wanders(Tracks& tracks) {
  std::mt19937 random(28);
  const auto any = [&](int low, int high) { return low + static_cast<int>(random() % unsigned(high - low + 1)); };
  std::vector<LoomingThing> things;
  std::vector<std::pair<int, int>> steps;
  int forward = 0, turn = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (i % 40 == 0) {
      things.clear();
      steps.clear();
      const int count = any(0, 6);
      for (int k = 0; k < count; ++k) {
        things.push_back(
            {any(100, 3'000), any(-600, 600), any(20, 300), any(20, 300), static_cast<std::uint8_t>(any(1, 3))});
      }
      for (int k = 0; k < count; ++k) {
        const int ahead = any(-60, 20);
        steps.emplace_back(ahead, any(0, 2) == 0 ? any(-20, 20) : 0);
      }
      forward = any(0, 1) == 0 ? 0 : any(-4, 16);
      turn = any(0, 2) == 0 ? any(-12'000, 12'000) : 0;
      tracks.odometry(any(0, 4) != 0);
    }
    tracks.move(forward, 0, turn, 0.025F * static_cast<float>(forward), 25e-6F * static_cast<float>(turn));
    for (std::size_t k = 0; k < things.size(); ++k) {
      things[k].ahead += steps[k].first - forward + any(-3, 3);
      things[k].left += steps[k].second - turn * things[k].ahead / 1'000'000;
    }
    tracks.look(things, any(0, 30) == 0 ? 1'500 : 400);
  }
}

struct Told {
  const char* name;
  void (*story)(Tracks&);
  std::uint64_t with_floor;
  std::uint64_t without;
};

class LoomingTracks : public testing::TestWithParam<Told> {};

TEST_P(LoomingTracks, AreWhatTheyWere) {
  Tracks tracks;
  GetParam().story(tracks);
  EXPECT_EQ(tracks.digest(), GetParam().with_floor) << GetParam().name;
  Tracks no_floor(0);  // the lens on the floor: no row tells how far a foot is
  GetParam().story(no_floor);
  EXPECT_EQ(no_floor.digest(), GetParam().without) << GetParam().name << " without floor";
}

constexpr Told kTold[] = {{"comes", comes, 0x437C263388FC2A02ULL, 0x70ECF240F42E971CULL},
                          {"crosses", crosses, 0xADD5682455887B75ULL, 0xE7F6C52A22F2ADC3ULL},
                          {"wanders", wanders, 0x1282BDF8C9ECFAD7ULL, 0x3A6C5E026BF665E4ULL}};

TEST(LoomingTrackStories, TellOfStopsAndOfThingsThatMove) {
  Tracks coming;
  comes(coming);
  EXPECT_EQ(coming.highest(), record::AlertLevel::kStop);
  Tracks crossing;
  crosses(crossing);
  EXPECT_TRUE(crossing.moved());
  EXPECT_EQ(crossing.highest(), record::AlertLevel::kClear);
}

INSTANTIATE_TEST_SUITE_P(Stories, LoomingTracks, testing::ValuesIn(kTold),
                         [](const auto& told) { return std::string(told.param.name); });

}  // namespace
}  // namespace fencepost::test
