// The words for a device when its link's state changes.
#include <gtest/gtest.h>

#include "host/devices/catalogue.hpp"
#include "host/devices/open_devices.hpp"

namespace fencepost::devices {
namespace {

using host::LinkWording;
using sensor::LinkState;

LinkWording pixy(LinkState state, const std::string& problem = {}) {
  return host::word_link(label_of(*parse_device("pixy2:/dev/ttyUSB0", Use::kCamera)), state, problem);
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
  const auto wheels = parse_device("create2:tcp:robot:4000", Use::kOdometry);
  EXPECT_EQ(host::word_link(label_of(*wheels), LinkState::kSilent, "").name, "odometry " + wheels->where());
}

TEST(LinkWording, KnowsOfEveryDeviceWhyItMayNotWork) {
  for (const Use use : {Use::kCamera, Use::kOdometry}) {
    for (const Row* row : rows_for(use)) EXPECT_NE(*(*row->live)->unready, "") << *row->name;
  }
}

}  // namespace
}  // namespace fencepost::devices
