#include "host/live/link_wording.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

using sensor::LinkState;

LinkWording pixy(LinkState state, const std::string& problem = {}) {
  return word_link(DeviceRole::kCamera, *parse_device("pixy2:/dev/ttyUSB0", DeviceRole::kCamera), state, problem);
}

TEST(LinkWording, NamesTheDeviceAndWhereItIs) {
  const LinkWording words = pixy(LinkState::kOk);
  EXPECT_EQ(words.name, "camera pixy2 at /dev/ttyUSB0");
  EXPECT_EQ(words.device, "pixy2");
  EXPECT_EQ(words.detail, "/dev/ttyUSB0");
  EXPECT_EQ(words.remedy, "");
}

TEST(LinkWording, SaysWhatTheSystemSaidOfItsAbsence) {
  EXPECT_EQ(pixy(LinkState::kAbsent, "cannot open it").remedy, "cannot open it");
}

TEST(LinkWording, SaysWhatToTry) {
  EXPECT_NE(pixy(LinkState::kSilent).remedy.find("TX to RX"), std::string::npos);
  EXPECT_NE(pixy(LinkState::kUnready).remedy.find("its button is held"), std::string::npos);
  const auto wheels = parse_device("create2:tcp:robot:4000", DeviceRole::kOdometry);
  EXPECT_EQ(word_link(DeviceRole::kOdometry, *wheels, LinkState::kSilent, "").name, "odometry " + wheels->where());
}

}  // namespace
}  // namespace fencepost::host
