// The devices of an image: each can be opened after each other, and the one that is open is the one that is asked.
#include "firmware/image/devices/all.hpp"

#include <gtest/gtest.h>

#include "firmware/config/devices.hpp"

namespace fencepost::image {
namespace {

using config::CameraId;
using config::OdometryId;

TEST(OneOf, HoldsOneAndAsksThatOne) {
  struct Small {
    char answer;
  };
  struct Large {
    std::array<char, 100> text;
    char answer;
  };
  OneOf<Small, Large> one;
  one.hold<Small>('s');
  EXPECT_EQ(one.visit([](auto& it) { return it.answer; }), 's');
  one.hold<Large>(std::array<char, 100>{}, 'l');
  EXPECT_EQ(one.visit([](auto& it) { return it.answer; }), 'l');
  one.visit([](auto& it) { it.answer = 'x'; });
  EXPECT_EQ(std::as_const(one).visit([](const auto& it) { return it.answer; }), 'x');
}

struct DevicesTest : ::testing::Test {
  console::Counters counters;
  config::Devices devices;
  Opening opening{devices, counters, {}};
  Camera camera{opening};
  Odometry odometry{opening};
};

TEST_F(DevicesTest, AllAreContained) {
  EXPECT_EQ(Camera::kContained, (1U << config::kCameraIds) - 1);
  EXPECT_EQ(Odometry::kContained, (1U << config::kOdometryIds) - 1);
}

// Nothing answers on the template board: those with a cable wait, those of the console say what is missing.
TEST_F(DevicesTest, EachIsOpenedAfterEachOther) {
  for (std::size_t first = 0; first < config::kCameraIds; ++first) {
    for (std::size_t second = 0; second < config::kCameraIds; ++second) {
      for (const std::size_t id : {first, second}) {
        devices.put(config::DeviceKey::kCamera, static_cast<std::int32_t>(id));
        camera.open(opening);
        const bool console = static_cast<CameraId>(id) == CameraId::kConsole;
        EXPECT_EQ(camera.stamped_here(), !console) << id;
        EXPECT_FALSE(camera.poll(base::Time{100}));
        EXPECT_EQ(camera.link_words(sensor::LinkState::kSilent).detail, console ? "no records" : "no answer") << id;
      }
    }
  }
  for (std::size_t id = 0; id < config::kOdometryIds; ++id) {
    devices.put(config::DeviceKey::kOdometry, static_cast<std::int32_t>(id));
    odometry.open(opening, base::Time{100});
    EXPECT_EQ(odometry.stamped_here(), static_cast<OdometryId>(id) != OdometryId::kConsole) << id;
    odometry.allow_motion(100);
    EXPECT_EQ(odometry.poll(base::Time{200}).ok(), static_cast<OdometryId>(id) == OdometryId::kEncoders) << id;
  }
}

}  // namespace
}  // namespace fencepost::image
