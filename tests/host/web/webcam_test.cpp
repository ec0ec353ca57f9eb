#include "host/web/webcam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/live/robot_file.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host {
namespace {

constexpr sensor::Rgb kWall{120, 120, 120};
constexpr sensor::Rgb kOrange{230, 110, 30};
constexpr sensor::Rgb kBlue{40, 80, 200};

struct Box {
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
};

/// The box of a thing `wide` m across, straight ahead.
Box box_at(double distance, double wide = 0.2) {
  const double half = 277.13 * wide / 2 / distance;
  const auto at = [](double px) { return static_cast<int>(std::lround(px)); };
  return {at(159.5 - half), at(119.5 - half), at(159.5 + half), at(119.5 + half)};
}

class Watched {
 public:
  Webcam webcam{320, 240};

  void paint(const Box& box, sensor::Rgb rgb) {
    for (int v = std::max(0, box.y1); v <= std::min(239, box.y2); ++v) {
      for (int u = std::max(0, box.x1); u <= std::min(319, box.x2); ++u) put(u, v, rgb);
    }
  }
  void clear() { paint({0, 0, 319, 239}, kWall); }
  void show(double t) { EXPECT_TRUE(webcam.look(t)); }
  nlohmann::json train(int u, int v) { return nlohmann::json::parse(webcam.train(u, v)); }
  [[nodiscard]] nlohmann::json page() { return nlohmann::json::parse(webcam.live().page().page()); }
  [[nodiscard]] nlohmann::json boxes() { return page().at("frame").at("boxes"); }

 private:
  void put(int u, int v, sensor::Rgb rgb) {
    std::uint8_t* const pixel = &webcam.pixels()[static_cast<std::size_t>(4 * (320 * v + u))];
    pixel[0] = rgb.red;
    pixel[1] = rgb.green;
    pixel[2] = rgb.blue;
    pixel[3] = 255;
  }
};

/// s of the first record of a STOP.
std::optional<double> first_stop(const ResultDocument& result) {
  for (const auto& alert : result.alerts) {
    if (alert.level == record::AlertLevel::kStop) return alert.t.to_double();
  }
  return std::nullopt;
}

struct WebcamTest : testing::Test {
  Watched watched;
};

TEST_F(WebcamTest, FindsTheBoxOfWhatWasClickedOnAndNothingBefore) {
  watched.clear();
  watched.paint({100, 60, 139, 119}, kOrange);
  watched.paint({200, 80, 229, 109}, kBlue);
  watched.show(5.0);
  watched.show(5.05);
  EXPECT_TRUE(watched.boxes().empty());
  EXPECT_EQ(watched.train(120, 90).at("name"), "orange");
  watched.show(5.1);
  ASSERT_EQ(watched.boxes().size(), 1U);
  EXPECT_EQ(watched.boxes().at(0).at("box"), nlohmann::json({100, 60, 139, 119}));
  EXPECT_EQ(watched.boxes().at(0).at("signature"), 1);
  const auto blue = watched.train(215, 95);
  EXPECT_EQ(blue.at("signature"), 2);
  EXPECT_EQ(blue.at("name"), "blue");
  EXPECT_FALSE(blue.at("patchy").get<bool>());
  watched.show(5.15);
  EXPECT_EQ(watched.boxes().size(), 2U);
}

TEST_F(WebcamTest, TrainsAColourThatItHasAnewAndRefusesWhatIsNone) {
  watched.clear();
  watched.paint({100, 60, 139, 119}, kOrange);
  watched.paint({0, 0, 40, 40}, {6, 4, 2});
  watched.show(0);
  EXPECT_EQ(watched.train(120, 90).at("signature"), 1);
  EXPECT_EQ(watched.train(105, 70).at("signature"), 1);
  EXPECT_EQ(watched.train(250, 200).at("refused"), "grey");
  EXPECT_EQ(watched.train(10, 10).at("refused"), "dark");
  watched.paint({200, 60, 239, 119}, {120, 122, 134});
  watched.show(0.02);
  EXPECT_EQ(watched.train(220, 90).at("refused"), "grey") << "a wall in the shade";
  watched.paint({122, 60, 139, 119}, {6, 4, 2});
  watched.show(0.05);
  EXPECT_TRUE(watched.train(121, 90).at("patchy").get<bool>()) << "half of it is black";
}

TEST_F(WebcamTest, HasAsManyColoursAsASegmenterAndNoMore) {
  watched.clear();
  const auto shade = [](int i) {
    const double turn = 2 * 3.14159 * i / 17;
    const auto level = [&](double at) { return static_cast<std::uint8_t>(130 + 100 * std::cos(turn - at)); };
    return sensor::Rgb{level(0), level(2.094), level(4.189)};
  };
  for (int i = 0; i < 17; ++i) watched.paint({18 * i, 100, 18 * i + 14, 120}, shade(i));
  watched.show(0);
  for (int i = 0; i < 16; ++i) ASSERT_EQ(watched.train(18 * i + 7, 110).value("signature", 0), i + 1) << i;
  EXPECT_EQ(watched.train(18 * 16 + 7, 110).at("refused"), "full");
}

TEST_F(WebcamTest, WritesColoursThatRunTakes) {
  watched.clear();
  watched.paint({100, 60, 139, 119}, kOrange);
  watched.show(0);
  (void)watched.train(120, 90);
  const auto robot = parse_robot(watched.webcam.colours(), "colours.json");
  ASSERT_TRUE(robot.ok()) << robot.error();
  ASSERT_EQ(robot->colours.size(), 1U);
  ASSERT_EQ(robot->signatures.size(), 1U);
  EXPECT_EQ(robot->signatures[0].name, "orange");
  EXPECT_EQ(segmenter::signature_of(robot->colours.view(), 230, 110, 30), 1);
  EXPECT_EQ(segmenter::signature_of(robot->colours.view(), 40, 80, 200), 0);
}

// 0.2 m across, from 1.5 m on at 0.3 m/s: it would be here 5 s after it begins to come.
TEST_F(WebcamTest, SaysStopBeforeWhatComesIsHereAndItsLogReplays) {
  const auto distance = [](double t) { return t < 3 ? 1.5 : 1.5 - 0.3 * (t - 3); };
  for (int i = 0; i < 135; ++i) {
    const double t = i / 20.0;
    watched.clear();
    watched.paint(box_at(distance(t)), kOrange);
    watched.show(100 + t);
    if (i == 10) (void)watched.train(160, 120);
  }
  watched.webcam.finish();
  const ReplayOutcome desk = replay(watched.webcam.live().text(), "webcam", {});
  ASSERT_FALSE(desk.unreadable);
  EXPECT_EQ(desk.result.log.frames, 135U);
  EXPECT_EQ(desk.result.digest, watched.webcam.live().page().log().now(false).digest);
  const auto stop = first_stop(desk.result);
  ASSERT_TRUE(stop);
  EXPECT_GT(*stop, 3.1) << "it stood until then";
  EXPECT_GT(distance(*stop), 0.3) << "half of the robot, and 1 s of its way";
}

TEST_F(WebcamTest, IsSilentOfWhatStands) {
  for (int i = 0; i < 100; ++i) {
    watched.clear();
    watched.paint(box_at(0.8), kOrange);
    watched.show(i / 20.0);
    if (i == 10) (void)watched.train(160, 120);
  }
  watched.webcam.finish();
  const ReplayOutcome desk = replay(watched.webcam.live().text(), "webcam", {});
  EXPECT_FALSE(first_stop(desk.result));
}

TEST_F(WebcamTest, ColoursHaveWords) {
  EXPECT_EQ(colour_word({200, 30, 30}), "red");
  EXPECT_EQ(colour_word({200, 30, 45}), "red");
  EXPECT_EQ(colour_word(kOrange), "orange");
  EXPECT_EQ(colour_word({220, 210, 40}), "yellow");
  EXPECT_EQ(colour_word({40, 150, 60}), "green");
  EXPECT_EQ(colour_word({40, 180, 190}), "cyan");
  EXPECT_EQ(colour_word(kBlue), "blue");
  EXPECT_EQ(colour_word({120, 40, 190}), "purple");
  EXPECT_EQ(colour_word({220, 60, 150}), "pink");
}

}  // namespace
}  // namespace fencepost::host
