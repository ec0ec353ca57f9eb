#include "host/emulate/models/jevois.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

constexpr base::Time kUp = base::Time{} + JeVois::kBoot;

std::string text_said(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::string tell(JeVois& camera, const std::string& commands, base::Time now = kUp) {
  std::string answers;
  for (const char c : commands) answers += text_said(camera.take(static_cast<std::uint8_t>(c), now));
  return answers;
}

sensor::BlobFrame seeing(const sensor::Blob& blob) {
  sensor::BlobFrame frame;
  (void)frame.blobs.push_back(blob);
  return frame;
}

// The document's: centre (200, 90), 64 x 48 px.
constexpr sensor::Blob kBall{1, 168, 66, 231, 113, {}, {}, 0, {}};

struct JevoisModel : ::testing::Test {
  JevoisModel() { (void)camera.power_up({}); }
  JeVois camera;
};

TEST_F(JevoisModel, TheDocumentsMessages) {
  EXPECT_EQ(text_said(camera.see(seeing(kBall), kUp)), "") << "it streams nowhere yet";
  EXPECT_EQ(tell(camera, "setpar serout Hard\nstreamon\r\n"), "OK\r\nOK\r\n");
  EXPECT_EQ(text_said(camera.see(seeing(kBall), kUp)), "T2 250 -188\r\n") << "-187.5 is rounded away from zero";
  EXPECT_EQ(text_said(camera.see(seeing({1, 144, 58, 175, 121, {}, {}, 0, {}}), kUp)), "T2 0 -188\r\n");
  EXPECT_EQ(camera.see(seeing({1, 144, 58, 175, 121, {}, {}, 0, {}}), kUp),
            test::hex("54 32 20 30 20 2D 31 38 38 0D 0A"));
  EXPECT_EQ(tell(camera, "setpar serstyle Normal\n"), "OK\r\n");
  EXPECT_EQ(text_said(camera.see(seeing(kBall), kUp)), "N2 blob1 250 -188 400 300\r\n");
  EXPECT_EQ(tell(camera, "setpar serprec 1\nsetpar serstyle Detail\n"), "OK\r\nOK\r\n");
  EXPECT_EQ(text_said(camera.see(seeing(kBall), kUp)), "D2 blob1 50.0 -337.5 450.0 -337.5 450.0 -37.5 450.0 -337.5\r\n")
      << "its sources repeat the second vertex";
}

TEST_F(JevoisModel, NamesWhatItDoesNotDo) {
  EXPECT_EQ(
      tell(camera, "setpar serstyle Normal\nsetpar serlog Hard\nsetmapping2 YUYV 320 240 30 JeVois ObjectTracker\n"),
      "OK\r\nOK\r\nOK\r\n");
  EXPECT_EQ(tell(camera, "setpar serout Hard\nstreamon\n"), "OK\r\nOK\r\n");
  EXPECT_EQ(text_said(camera.see(seeing(kBall), kUp)).substr(0, 2), "T2") << "the module is loaded anew";
  EXPECT_EQ(tell(camera, "setmapping2 YUYV 320 240 30 JeVois ObjectTracker\ninfo\n\x01\x02\n"),
            "ERR Command error\r\nERR Command error\r\nERR Command error\r\n")
      << "not while it streams";
  EXPECT_EQ(camera.not_emulated(),
            (std::vector<std::string>{"setpar serlog", "setmapping2", "info", "unreadable bytes"}));
}

TEST_F(JevoisModel, MarksStampsAndLimit) {
  (void)tell(camera,
             "setpar serout USB\nstreamon\nsetpar sermark Both\nsetpar serstamp FrameTime\nsetpar serlimit 1\n");
  sensor::BlobFrame two = seeing(kBall);
  (void)two.blobs.push_back(kBall);
  EXPECT_EQ(text_said(camera.see(two, kUp)),
            "1/00:00:00 MARK START\r\n1/00:00:00 T2 250 -188\r\n1/00:00:00 MARK STOP\r\n");
}

TEST_F(JevoisModel, Answers) {
  EXPECT_EQ(tell(camera, "ping\n", kUp - base::milliseconds(1)), "") << "it boots";
  EXPECT_EQ(tell(camera, "ping\r"), "ALIVE\r\nOK\r\n");
  for (const char* command : {"setpar serstyle Loud\n", "setpar serprec 11\n", "setpar none 1\n", "dance\n"}) {
    EXPECT_EQ(tell(camera, command).substr(0, 4), "ERR ") << command;
  }
  (void)tell(camera, "setpar serout All\nstreamon\nsetpar serstyle Normal\n");
  (void)camera.power_up(kUp);
  EXPECT_EQ(text_said(camera.see(seeing(kBall), kUp + JeVois::kBoot)), "") << "all is forgotten";
}

}  // namespace
}  // namespace fencepost::emulate
