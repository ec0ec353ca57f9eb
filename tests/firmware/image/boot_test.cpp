// The lines that a board says first, and the links of sensors behind the console.
#include "firmware/image/boot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "firmware/image/fed_by_console.hpp"

namespace fencepost::image {
namespace {

std::string said(const BootFacts& facts) {
  std::string text;
  for (std::size_t n = 0; n < kBootLines; ++n) {
    std::array<char, 128> room{};
    text.append(room.data(), write_boot_line(n, facts, room));
  }
  return text;
}

TEST(Boot, SaysVersionReasonAndReady) {
  EXPECT_EQ(said({"0.1.0", "pyboard", "small", mcu::ResetReason::kWatchdog, std::nullopt}),
            "fencepost 0.1.0 for pyboard, profile small\r\nreset: watchdog\r\npanic: none\r\nREADY\r\n");
}

TEST(Boot, SaysWhereTheLastRunDied) {
  EXPECT_EQ(said({"0.1.0", "pyboard", "small", mcu::ResetReason::kSoftware, mcu::Panic{3, 0x0800C1A2, 0x0801FFFF}}),
            "fencepost 0.1.0 for pyboard, profile small\r\nreset: panic\r\n"
            "panic: exception 3 at 0800c1a2, called from 0801ffff\r\nREADY\r\n");
}

TEST(FedByConsole, IsSilentBeforeTheFirstAndASecondAfterTheLast) {
  console::Counters counters;
  CameraOnConsole camera(counters);
  const auto at = [&](double t) {
    EXPECT_EQ(camera.poll(base::Time::nearest(t)).error(), base::Error::kNotReady);
    return camera.link();
  };
  EXPECT_EQ(at(0.5), sensor::LinkState::kSilent);
  counters.frames = 1;
  EXPECT_EQ(at(0.6), sensor::LinkState::kOk);
  EXPECT_EQ(at(1.59), sensor::LinkState::kOk);
  EXPECT_EQ(at(1.6), sensor::LinkState::kSilent);
  counters.refused[0] = 1;  // it came, though it was of no use
  EXPECT_EQ(at(1.7), sensor::LinkState::kOk);
}

TEST(FedByConsole, SaysThatItsRecordsAreMissing) {
  EXPECT_EQ(CameraOnConsole::link_words(sensor::LinkState::kSilent).remedy,
            "no $FPFRM records come over the console; send them");
  EXPECT_EQ(OdometryOnConsole::link_words(sensor::LinkState::kSilent).detail, "no records");
  EXPECT_EQ(OdometryOnConsole::link_words(sensor::LinkState::kOk).remedy, "");
}

}  // namespace
}  // namespace fencepost::image
