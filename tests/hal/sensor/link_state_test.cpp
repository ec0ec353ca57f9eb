#include "hal/sensor/link_state.hpp"

#include <gtest/gtest.h>

namespace fencepost::sensor {
namespace {

TEST(LinkState, HasTheNamesOfTheStream) {
  EXPECT_EQ(name(LinkState::kAbsent), "absent");
  EXPECT_EQ(name(LinkState::kSilent), "silent");
  EXPECT_EQ(name(LinkState::kUnready), "unready");
  EXPECT_EQ(name(LinkState::kEmpty), "empty");
  EXPECT_EQ(name(LinkState::kOk), "ok");
}

}  // namespace
}  // namespace fencepost::sensor
