// Each reason, state and level has its own words.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "firmware/console/answers.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/console/drive_guide.hpp"
#include "firmware/console/link_words.hpp"
#include "firmware/console/listings.hpp"
#include "firmware/console/text.hpp"

namespace fencepost::test {
namespace {

std::array<char, console::kMaxSentence> reasons_room{};

std::string blind(alert::Blindness reason) {
  return {reasons_room.data(), console::describe_blind(reason, reasons_room)};
}

std::string rejected(record::Reject reason) {
  return {reasons_room.data(), console::describe_reject("$FPODO,1", reason, {}, reasons_room)};
}

TEST(Reasons, OfBeingBlind) {
  using alert::Blindness;
  EXPECT_EQ(blind(Blindness::kNone), "BLIND   what is ahead cannot be known\r\n");
  EXPECT_EQ(blind(Blindness::kNoCamera), "BLIND   the camera has sent no frame yet\r\n");
  EXPECT_EQ(blind(Blindness::kNoOdometry), "BLIND   the odometry has sent nothing yet\r\n");
  EXPECT_EQ(blind(Blindness::kCameraLate), "BLIND   no frame comes from the camera\r\n");
  EXPECT_EQ(blind(Blindness::kOdometryLate), "BLIND   nothing comes from the odometry\r\n");
  EXPECT_EQ(blind(Blindness::kFramesUnused), "BLIND   frames come and cannot be used: see status\r\n");
  EXPECT_EQ(blind(Blindness::kFrozen), "BLIND   the camera's image stands still while the robot moves\r\n");
  EXPECT_EQ(blind(Blindness::kJump), "BLIND   the odometry has jumped\r\n");
}

TEST(Reasons, OfARejectedLine) {
  using record::Reject;
  EXPECT_EQ(rejected(Reject::kFields), "error: $FPODO rejected (fields): too few or too many fields\r\n");
  EXPECT_EQ(rejected(Reject::kNumber), "error: $FPODO rejected (number): a field cannot be read\r\n");
  EXPECT_EQ(rejected(Reject::kRange), "error: $FPODO rejected (range): a field is outside its range\r\n");
  EXPECT_EQ(rejected(Reject::kLength), "error: $FPODO rejected (length): longer than a line may be\r\n");
  EXPECT_EQ(rejected(Reject::kTruncated), "error: $FPODO rejected (truncated): the line is not complete\r\n");
  EXPECT_EQ(rejected(Reject::kTime), "error: $FPODO rejected (time): its time is not after the last one's\r\n");
  EXPECT_EQ(rejected(Reject::kFormat), "error: $FPODO rejected (format): another stream format\r\n");
}

TEST(Reasons, OfACableSayWhatToCheck) {
  using sensor::LinkState;
  const auto detail = [](LinkState state) { return console::plain_link_words("camera", state).detail; };
  EXPECT_EQ(detail(LinkState::kAbsent), "not there");
  EXPECT_EQ(detail(LinkState::kSilent), "no answer");
  EXPECT_EQ(detail(LinkState::kUnready), "not ready");
  EXPECT_EQ(detail(LinkState::kEmpty), "nothing seen");
  EXPECT_EQ(detail(LinkState::kOk), "");
  const auto said = [](LinkState state) {
    const console::LinkWords words = console::plain_link_words("camera", state);
    return std::string(reasons_room.data(), console::describe_link(state, words.name, words.remedy, reasons_room));
  };
  EXPECT_EQ(said(LinkState::kAbsent), "camera is absent; going on without it until it is back\r\n");
  EXPECT_EQ(said(LinkState::kSilent),
            "camera is silent: nothing answers; check its power, the wires (TX to RX) and the baud\r\n");
  EXPECT_EQ(said(LinkState::kUnready), "camera is unready: it starts, is not taught colours, or is another model\r\n");
  EXPECT_EQ(said(LinkState::kEmpty), "camera works and sees nothing\r\n");
  EXPECT_EQ(said(LinkState::kOk), "camera works\r\n");
}

TEST(Reasons, AStatusWithoutACalibrationSaysWhatBringsOne) {
  const console::Counters counters;
  console::StatusFacts facts{.profile = "small", .links = {}, .counters = counters};
  std::string all;
  for (std::size_t line = 0; line < console::status_lines({}, false); ++line)
    all.append(reasons_room.data(), console::write_status(line, facts, reasons_room));
  EXPECT_NE(all.find("camera link absent, no calibration ($FPCAM); odometry link absent\r\n"), std::string::npos)
      << all;
  sensor::CameraIntrinsics camera;
  camera.model = std::string_view("pixy2");
  camera.width = 316;
  camera.height = 208;
  camera.fx = {10'000};
  facts.camera = &camera;
  all.clear();
  for (std::size_t line = 0; line < console::status_lines({}, false); ++line)
    all.append(reasons_room.data(), console::write_status(line, facts, reasons_room));
  EXPECT_NE(all.find("camera link absent, pixy2 316x208; odometry link absent\r\n"), std::string::npos) << all;
}

TEST(Reasons, ADriveGuideHasNoLineBeyondItsLast) {
  console::DriveGuide guide;
  guide.begin();
  ASSERT_EQ(guide.lines(true), 1 + console::kDriveNeeds);
  EXPECT_GT(guide.write(console::kDriveNeeds, true, reasons_room), 2U);
  EXPECT_EQ(std::string(reasons_room.data(), guide.write(1 + console::kDriveNeeds, true, reasons_room)), "\r\n");
}

}  // namespace
}  // namespace fencepost::test
