// Equality of the seams' values, and their words.
#include <gtest/gtest.h>

#include "hal/bus/screen.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::sensor {
namespace {

TEST(Lens, HasTheNamesOfTheStream) {
  EXPECT_EQ(name(Lens::kPinhole), "pinhole");
  EXPECT_EQ(name(Lens::kEquidistant), "equidistant");
}

TEST(LinkState, OneThatThereIsNotIsAbsent) {
  EXPECT_EQ(name(static_cast<LinkState>(5)), "absent");
  EXPECT_TRUE(works(LinkState::kOk));
  EXPECT_TRUE(works(LinkState::kEmpty));
  EXPECT_FALSE(works(LinkState::kUnready));
  EXPECT_FALSE(works(LinkState::kSilent));
}

TEST(CarSample, IsEqualWhereAllThatItTellsIs) {
  const CarSample first{base::Time{1}, 2, base::Radians{3}, base::RadiansPerSecond{4}};
  CarSample other = first;
  EXPECT_TRUE(first == other);
  other.count = -2;
  EXPECT_FALSE(first == other);
  other = first;
  other.steering.reset();
  EXPECT_FALSE(first == other) << "unknown is not straight ahead";
  other = first;
  other.yaw_rate = base::RadiansPerSecond{5};
  EXPECT_FALSE(first == other);
}

TEST(Colour, IsEqualWhereAllThreeAre) {
  const bus::Colour grey{7, 7, 7};
  EXPECT_TRUE(grey == (bus::Colour{7, 7, 7}));
  EXPECT_FALSE(grey == (bus::Colour{7, 7, 8}));
  EXPECT_FALSE(grey == (bus::Colour{7, 8, 7}));
  EXPECT_FALSE(grey == (bus::Colour{8, 7, 7}));
  EXPECT_TRUE(bus::Colour{} == (bus::Colour{0, 0, 0})) << "black";
}

}  // namespace
}  // namespace fencepost::sensor
