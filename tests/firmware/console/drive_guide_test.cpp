#include "firmware/console/drive_guide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::DriveGuide;
using console::DriveNeed;

constexpr double kDegree = 3.14159265358979 / 180;

/// A robot on its way: frames with the boxes that the test gives it.
class Way {
 public:
  Way() { guide_.begin(); }

  DriveGuide& guide() { return guide_; }
  void see(std::initializer_list<recon::Box> boxes) {
    frame_.blobs.clear();
    for (const recon::Box& box : boxes) static_cast<void>(frame_.blobs.push_back({box, 1, false}));
  }
  void know(unsigned objects) { known_ = objects; }
  bool look() {
    const recon::MapPose pose{recon::moved({}, {static_cast<float>(x_), static_cast<float>(y_)}),
                              static_cast<std::int32_t>(1e6 * std::remainder(heading_, 360 * kDegree))};
    return guide_.look(frame_, camera_, pose, known_);
  }
  /// In steps of 1 cm.
  void drive(double metres) {
    const double step = metres < 0 ? -0.01 : 0.01;
    for (int i = 0; i < static_cast<int>(100 * std::abs(metres) + 0.5); ++i) {
      x_ += step * std::cos(heading_);
      y_ += step * std::sin(heading_);
      look();
    }
  }
  /// In steps of a degree.
  void turn(double degrees) {
    for (int i = 0; i < static_cast<int>(std::abs(degrees) + 0.5); ++i) {
      heading_ += (degrees > 0 ? 1 : -1) * kDegree;
      look();
    }
  }
  [[nodiscard]] bool lacks(DriveNeed need) const { return guide_.lacks(need); }
  [[nodiscard]] std::string said(bool logs = true) const {
    std::string text;
    std::array<char, 200> room{};
    for (std::size_t line = 0; line < guide_.lines(logs); ++line) {
      const std::size_t size = guide_.write(line, logs, room);
      EXPECT_GT(size, 0U);
      text.append(room.data(), size);
    }
    return text;
  }

 private:
  DriveGuide guide_;
  recon::CameraModel camera_ = recon::make_camera_model(level_pixy2());
  recon::WaitingFrame frame_;
  unsigned known_ = 0;
  double x_ = 0;
  double y_ = 0;
  double heading_ = 0;
};

constexpr recon::Box kNear{150, 90, 180, 160};
constexpr recon::Box kFar{120, 95, 130, 130};
constexpr recon::Box kAtLeft{20, 90, 40, 130};
constexpr recon::Box kAtRight{280, 90, 300, 130};

TEST(DriveGuide, SaysAllThatIsMissing) {
  EXPECT_EQ(Way{}.said(),
            "the calibration drive still needs\r\n"
            "  blocks on the map: 0 of 3\r\n"
            "  straight on for 1.1 m, a near and a far block in view, now 0.00 m: 0 of 4 times\r\n"
            "  all the way around: 0 of 360 deg\r\n"
            "  turns to the left: 0 of 40 deg\r\n"
            "  turns to the right: 0 of 40 deg\r\n"
            "  whole blocks in the image's left quarter: 0 of 20 frames\r\n"
            "  whole blocks in the image's right quarter: 0 of 20 frames\r\n"
            "  whole blocks with their feet in the image: 0 of 200 frames\r\n");
  EXPECT_NE(Way{}.said(false).find("\r\n  a log: nothing is counted but in `mode log`\r\n  blocks"), std::string::npos);
}

TEST(DriveGuide, AStraightNeedsANearAndAFarBlockInOneImage) {
  Way way;
  way.see({kNear});
  way.drive(1.2);
  way.see({kFar});
  way.drive(1.2);
  EXPECT_NE(way.said().find("0 of 4 times"), std::string::npos) << way.said();
  way.see({kNear, kFar});
  way.drive(0.03);
  EXPECT_NE(way.said().find("1 of 4 times"), std::string::npos) << way.said();
}

TEST(DriveGuide, SaysHowFarItWentInHundredthsOfAMetre) {
  Way way;
  way.see({kNear});
  way.drive(1.24);
  EXPECT_NE(way.said().find(" now 1.21 m: 0 of 4 times"), std::string::npos) << way.said();
}

TEST(DriveGuide, AStraightThatSeesNothingOrBendsIsNone) {
  Way blind;
  blind.see({kNear, kFar});
  blind.drive(0.1);
  blind.see({});
  blind.drive(2);
  EXPECT_NE(blind.said().find("now 0.08 m: 0 of 4 times"), std::string::npos) << blind.said();
  Way bend;
  bend.see({kNear, kFar});
  for (int i = 0; i < 20; ++i) {
    bend.drive(0.1);
    bend.turn(2);
  }
  EXPECT_NE(bend.said().find(": 0 of 4 times"), std::string::npos) << bend.said();
}

TEST(DriveGuide, ForthAndBackIsAllTheWayAroundAndToBothSides) {
  Way way;
  way.turn(190);
  EXPECT_FALSE(way.lacks(DriveNeed::kLeft));
  EXPECT_TRUE(way.lacks(DriveNeed::kAround));
  way.turn(-190);
  EXPECT_TRUE(way.lacks(DriveNeed::kAround));  // seen from the same side twice
  EXPECT_FALSE(way.lacks(DriveNeed::kRight));
  way.turn(-175);
  EXPECT_FALSE(way.lacks(DriveNeed::kAround));
}

TEST(DriveGuide, OdometryThatWaversDrivesNowhere) {
  Way way;
  way.see({kNear, kFar});
  for (int i = 0; i < 3000; ++i) {
    way.drive(i % 2 == 0 ? 0.01 : -0.01);
    way.turn(i % 4 < 2 ? 1 : -1);
  }
  EXPECT_TRUE(way.lacks(DriveNeed::kLeft));
  EXPECT_TRUE(way.lacks(DriveNeed::kRight));
  EXPECT_NE(way.said().find("now 0.00 m: 0 of 4 times"), std::string::npos) << way.said();
}

TEST(DriveGuide, WhatIsCutOffIsNotWhole) {
  Way way;
  way.see({{0, 90, 40, 160}, {280, 90, 315, 160}, {150, 90, 180, 207}});
  for (int i = 0; i < 250; ++i) way.look();
  EXPECT_TRUE(way.lacks(DriveNeed::kLeftSide));
  EXPECT_TRUE(way.lacks(DriveNeed::kRightSide));
  EXPECT_TRUE(way.lacks(DriveNeed::kFeet));
  way.see({kAtLeft, kAtRight});
  for (int i = 0; i < 200; ++i) way.look();
  EXPECT_FALSE(way.lacks(DriveNeed::kLeftSide));
  EXPECT_FALSE(way.lacks(DriveNeed::kRightSide));
  EXPECT_FALSE(way.lacks(DriveNeed::kFeet));
}

TEST(DriveGuide, EachNeedThatIsMetIsNewsOnceAndTheLastOneEndsIt) {
  Way way;
  way.know(3);
  EXPECT_TRUE(way.look());
  EXPECT_TRUE(way.look());  // until it is said
  way.guide().say();
  EXPECT_FALSE(way.look());
  way.see({kNear, kFar, kAtLeft, kAtRight});
  for (int i = 0; i < 4; ++i) {
    way.drive(1.15);
    way.turn(i < 2 ? 185 : -185);
  }
  EXPECT_TRUE(way.guide().enough()) << way.said();
  EXPECT_EQ(way.said(), "enough: end the recording and run `fencepost calibrate LOG`\r\n");
  way.guide().say();
  EXPECT_FALSE(way.guide().on());
}

TEST(DriveGuideConsole, CountsInModeLogOnlyAndIsPassedOverByReaders) {
  Desk<> text(console::Mode::kText, desk_approach(60));
  const std::string first = text.type_line("calibrate");
  EXPECT_NE(first.find("the calibration drive still needs\r\n  a log: "), std::string::npos) << first;
  text.turn(1500);
  EXPECT_NE(text.type_line("calibrate").find("feet in the image: 0 of 200"), std::string::npos);

  Desk<> log(console::Mode::kLog, desk_approach(260));
  const std::string begun = log.type_line("calibrate");
  EXPECT_EQ(begun.find("a log: "), std::string::npos) << begun;
  log.turn(5500);
  const std::string said = log.link.take_said();
  // The robot prints this by itself, when the feet were seen often enough; no line is a record.
  const std::size_t news = said.find("\r\nthe calibration drive still needs\r\n");
  ASSERT_NE(news, std::string::npos);
  EXPECT_EQ(said.substr(news, 800).find("feet in the image"), std::string::npos);
  EXPECT_NE(log.type_line("calibrate").find("blocks on the map: 1 of 3\r\n"), std::string::npos);
  log.type_line("reset");
  EXPECT_NE(log.type_line("calibrate").find("feet in the image: 0 of 200"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::test
