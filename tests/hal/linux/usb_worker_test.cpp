// Nothing blocks indefinitely, even if libusb does.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "hal/linux/usb_device.hpp"
#include "hal/linux/usb_link.hpp"
#include "tests/hal/linux/fake_libusb.hpp"

namespace fencepost::linux {
namespace {

using test::fake_libusb;

UsbSettings impatient() {
  UsbSettings settings = kNxtUsb;
  settings.timeout = base::milliseconds(100);
  return settings;
}

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 10'000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return condition();
}

class StubbornUsb : public testing::Test {
 protected:
  void SetUp() override {
    if (udev_runs()) GTEST_SKIP() << "where udev runs no context is closed; this is for where it does not";
  }
  // The hung call returns, and the abandoned thread cleans up.
  void TearDown() override {
    fake_libusb().hang_in_open = fake_libusb().hang_in_exit = false;
    fake_libusb().keep_transfers = fake_libusb().unplugged = false;
  }
};

TEST_F(StubbornUsb, ClosesInOrderWhereNothingHangs) {
  {
    Opened<UsbPacketLink> link = UsbPacketLink::open(impatient());
    ASSERT_TRUE(link) << link.problem();
    EXPECT_TRUE(soon([] { return fake_libusb().in_flight == 4; }));
  }
  EXPECT_EQ(fake_libusb().in_flight, 0);
  EXPECT_EQ(fake_libusb().transfers, 0);
  EXPECT_EQ(fake_libusb().handles, 0);
  EXPECT_EQ(fake_libusb().contexts, 0);
}

TEST_F(StubbornUsb, AnOpenThatHangsIsAProblem) {
  fake_libusb().hang_in_open = true;
  Opened<UsbPacketLink> link = UsbPacketLink::open(impatient());
  ASSERT_FALSE(link);
  EXPECT_NE(link.problem().find("0694:0002"), std::string::npos) << link.problem();
  EXPECT_NE(link.problem().find("did not come back"), std::string::npos) << link.problem();
  fake_libusb().hang_in_open = false;
  EXPECT_TRUE(soon([] { return fake_libusb().contexts == 0 && fake_libusb().transfers == 0; }))
      << "the thread cleans up once it is free";
}

TEST_F(StubbornUsb, AContextThatDoesNotCloseKeepsNobody) {
  fake_libusb().hang_in_exit = true;
  {
    Opened<UsbPacketLink> link = UsbPacketLink::open(impatient());
    ASSERT_TRUE(link) << link.problem();
  }
  EXPECT_EQ(fake_libusb().contexts, 1) << "left to its thread";
  fake_libusb().hang_in_exit = false;
  EXPECT_TRUE(soon([] { return fake_libusb().contexts == 0 && fake_libusb().transfers == 0; }));
}

// The kernel keeps the transfers of an unplugged device: the link is gone all the same, and reopens.
TEST_F(StubbornUsb, TransfersThatDoNotComeBackAreAbandoned) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(impatient());
  ASSERT_TRUE(link) << link.problem();
  ASSERT_TRUE(soon([] { return fake_libusb().in_flight == 4; }));
  const int handles = fake_libusb().handles;
  // One comes back and reports the unplug, then the kernel keeps what is submitted.
  fake_libusb().unplugged = true;
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  fake_libusb().unplugged = false;
  ASSERT_TRUE(soon([&] {
    link->tend(base::Time{std::chrono::steady_clock::now().time_since_epoch().count() / 100'000});
    return link->connected();
  }));
  ASSERT_TRUE(soon([] { return fake_libusb().in_flight == 4; }));
  fake_libusb().keep_transfers = true;
  { const Opened<UsbPacketLink> gone(std::move(*link)); }  // ends
  EXPECT_EQ(fake_libusb().in_flight, 4);
  EXPECT_EQ(fake_libusb().handles, handles) << "what the kernel still uses is not closed";
  fake_libusb().keep_transfers = false;
  Opened<UsbPacketLink> next = UsbPacketLink::open(impatient());
  EXPECT_TRUE(next) << next.problem();
}

}  // namespace
}  // namespace fencepost::linux
