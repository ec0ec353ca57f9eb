#include "hal/mcu/mirrored_link.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace fencepost::mcu {
namespace {

/// A port with so much room; what is in it stays there until it is emptied.
struct Port {
  std::string typed;
  std::string said;
  std::size_t capacity = 2048;
  std::size_t filled = 0;
  bool gone = false;

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (gone) return base::Error::kGone;
    if (typed.empty()) return base::Error::kNotReady;
    const std::size_t count = std::min(in.size(), typed.size());
    std::copy_n(typed.begin(), count, in.begin());
    typed.erase(0, count);
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (gone) return base::Error::kGone;
    const std::size_t count = std::min(out.size(), capacity - filled);
    if (count == 0) return base::Error::kFull;
    said.append(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count));
    filled += count;
    return count;
  }
  [[nodiscard]] std::size_t room() const { return gone ? 0 : capacity - filled; }
};

struct MirroredLinkTest : ::testing::Test {
  Port uart;
  Port usb;
  MirroredLink<Port, Port> link{uart, usb};

  /// Number of bytes that the link took; -1 if none.
  int say(std::string_view text) {
    const auto taken = link.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    return taken ? static_cast<int>(*taken) : -1;
  }
  std::string hear() {
    std::array<std::uint8_t, 64> bytes{};
    const auto got = link.read(bytes);
    return got ? std::string(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(*got)) : "";
  }
};

TEST_F(MirroredLinkTest, WritesEverythingToBoth) {
  EXPECT_EQ(say("one\r\ntw"), 7);
  EXPECT_EQ(say("o\r\n"), 3);
  EXPECT_EQ(uart.said, "one\r\ntwo\r\n");
  EXPECT_EQ(usb.said, uart.said);
}

TEST_F(MirroredLinkTest, ReadsEither) {
  usb.typed = "status\r";
  EXPECT_EQ(hear(), "status\r");
  uart.typed = "version\r";
  EXPECT_EQ(hear(), "version\r");
  EXPECT_EQ(hear(), "");
}

TEST_F(MirroredLinkTest, AFullOrAbsentSecondaryBlocksNothing) {
  usb.gone = true;
  EXPECT_EQ(say("one\r\n"), 5);
  usb.gone = false;
  usb.filled = usb.capacity;
  EXPECT_EQ(say("two\r\n"), 5);
  EXPECT_EQ(uart.said, "one\r\ntwo\r\n");
  EXPECT_EQ(usb.said, "");
}

TEST_F(MirroredLinkTest, TheSecondaryGetsWholeLinesOnly) {
  usb.filled = usb.capacity - 100;  // not the longest line
  say("lost, and its ");
  usb.filled = 0;
  say("end\r\nkept\r\n");
  EXPECT_EQ(usb.said, "kept\r\n");
  EXPECT_EQ(uart.said, "lost, and its end\r\nkept\r\n");
}

TEST_F(MirroredLinkTest, ThePrimarysBackPressureIsTheConsoles) {
  uart.filled = uart.capacity - 2;
  EXPECT_EQ(say("four"), 2);
  EXPECT_EQ(say("ur"), -1);
  EXPECT_EQ(usb.said, "fo");
}

TEST_F(MirroredLinkTest, TypingMakesAPrimary) {
  usb.typed = "mode log\r";
  hear();
  uart.filled = uart.capacity;
  EXPECT_EQ(say("line\r\n"), 6);
  EXPECT_EQ(usb.said, "line\r\n");
  EXPECT_EQ(uart.said, "");
  uart.typed = "\r";
  hear();
  EXPECT_EQ(say("line\r\n"), -1);
}

TEST_F(MirroredLinkTest, APrimaryThatGoesOrNeverReadsIsReplaced) {
  usb.typed = "mode log\r";
  hear();
  usb.filled = usb.capacity;
  int refused = 0;
  while (say("x\r\n") < 0) ASSERT_LT(++refused, 1000);
  EXPECT_EQ(refused, 499);
  EXPECT_EQ(uart.said, "x\r\n");
  usb.filled = 0;
  usb.typed = "\r";
  hear();
  usb.gone = true;
  EXPECT_EQ(say("y\r\n"), 3);
  EXPECT_EQ(uart.said, "x\r\ny\r\n");
}

TEST_F(MirroredLinkTest, TwoWritersDoNotMixInALine) {
  uart.typed = "set alert";
  EXPECT_EQ(hear(), "set alert");
  usb.typed = "$FPODO,1\r\n";
  EXPECT_EQ(hear(), "");
  uart.typed = ".stop 1\r";
  EXPECT_EQ(hear(), ".stop 1\r");
  EXPECT_EQ(hear(), "$FPODO,1\r\n");
}

TEST_F(MirroredLinkTest, AHalfTypedLineDoesNotShutOutTheOther) {
  uart.typed = "half";
  hear();
  usb.typed = "whole\r";
  std::string heard;
  int reads = 0;
  while (heard.empty()) {
    ASSERT_LT(++reads, 10'000);
    heard = hear();
  }
  EXPECT_EQ(heard, "whole\r");
  EXPECT_EQ(reads, 2001);
}

}  // namespace
}  // namespace fencepost::mcu
