// A USB link's handling of a device's answers and refusals; libusb is the test's own.
#include "hal/linux/usb_link.hpp"

#include <gtest/gtest.h>
#include <libusb-1.0/libusb.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "hal/linux/retry.hpp"
#include "hal/linux/usb_device.hpp"
#include "tests/hal/linux/fake_libusb.hpp"
#include "tests/text.hpp"

namespace fencepost::linux {
namespace {

using base::Error;
using base::Time;
using test::fake_libusb;
using test::holds;
using Octets = std::vector<std::uint8_t>;

constexpr int kReads = 4;  // in flight while nothing is wrong

UsbSettings quick() {
  UsbSettings settings = kNxtUsb;
  settings.timeout = base::milliseconds(100);
  return settings;
}

/// Whether it holds within ten seconds; it is not asked again once it does.
template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 10'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

void device_says(std::initializer_list<Octets> telegrams) {
  const std::lock_guard lock(fake_libusb().mutex);
  for (const Octets& telegram : telegrams) fake_libusb().reads.push_back({LIBUSB_TRANSFER_COMPLETED, telegram});
}

void reads_end(int status, int times = 1) {
  const std::lock_guard lock(fake_libusb().mutex);
  for (int i = 0; i < times; ++i) fake_libusb().reads.push_back({status, {}});
}

void writes_end(std::initializer_list<int> statuses) {
  const std::lock_guard lock(fake_libusb().mutex);
  for (const int status : statuses) fake_libusb().write_statuses.push_back(status);
}

std::vector<Octets> heard() {
  const std::lock_guard lock(fake_libusb().mutex);
  return fake_libusb().heard;
}

std::size_t left_to_say() {
  const std::lock_guard lock(fake_libusb().mutex);
  return fake_libusb().reads.size();
}

std::string problem_of(const UsbSettings& settings = quick()) {
  const Opened<UsbPacketLink> link = UsbPacketLink::open(settings);
  return link ? "none" : link.problem();
}

class UsbLink : public testing::Test {
 protected:
  void SetUp() override {
    if (udev_runs()) GTEST_SKIP() << "where udev runs a context serves several links; this is for one each";
    fake_libusb().restore();
  }
  void TearDown() override { fake_libusb().restore(); }
  /// The next of the loop's turns in which a missing device is looked for.
  Time later() { return now_ = now_ + kRetryInterval; }
  /// Of a link that it had before.
  testing::AssertionResult comes_back(UsbPacketLink& link) {
    const bool back = soon([&] {
      link.tend(later());
      return link.connected();
    });
    return back ? testing::AssertionSuccess() : testing::AssertionFailure() << link.problem();
  }

  Time now_;
};

TEST_F(UsbLink, CarriesTelegramsBothWays) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  EXPECT_GE(link->descriptor(), 0);
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(link->receive(in).error(), Error::kNotReady);
  device_says({{1, 2, 3}});
  base::Result<std::size_t> count = Error::kNotReady;
  ASSERT_TRUE(soon([&] { return (count = link->receive(in)).ok(); }));
  EXPECT_EQ(*count, 3U);
  EXPECT_EQ(in, (std::array<std::uint8_t, 8>{1, 2, 3}));

  EXPECT_EQ(link->send(Octets{7, 8}).value(), 2U);
  EXPECT_EQ(link->send({}).value(), 0U) << "nothing is no telegram";
  EXPECT_EQ(link->send(Octets(65)).error(), Error::kRefused) << "longer than a packet";
  EXPECT_EQ(link->send(Octets(64, 9)).value(), 64U);
  writes_end({LIBUSB_TRANSFER_COMPLETED, LIBUSB_TRANSFER_COMPLETED});
  ASSERT_TRUE(soon([] { return heard().size() == 2; }));
  EXPECT_EQ(heard(), (std::vector<Octets>{{7, 8}, Octets(64, 9)}));
  EXPECT_EQ(link->counters().errors, 0U);
}

TEST_F(UsbLink, ATelegramThatDoesNotFitIsDropped) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  device_says({{1, 2, 3}, {4}});
  std::array<std::uint8_t, 2> in{};
  base::Result<std::size_t> count = Error::kNotReady;
  ASSERT_TRUE(soon([&] {
    count = link->receive(in);
    return count.ok() || count.error() != Error::kNotReady;
  }));
  ASSERT_FALSE(count.ok());
  EXPECT_EQ(count.error(), Error::kBadInput);
  EXPECT_EQ(in[0], 0) << "nothing of it";
  ASSERT_TRUE(soon([&] { return (count = link->receive(in)).ok(); }));
  EXPECT_EQ(*count, 1U);
  EXPECT_EQ(in[0], 4);
}

TEST_F(UsbLink, AsBytesTelegramsRunIntoEachOther) {
  Opened<UsbByteLink> link = UsbByteLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  device_says({{1, 2}, {3, 4, 5}});
  Octets all;
  std::array<std::uint8_t, 4> in{};
  ASSERT_TRUE(soon([&] {
    const auto count = link->read({in.data(), all.empty() ? 1U : 4U});  // the first byte alone
    if (count) all.insert(all.end(), in.begin(), in.begin() + static_cast<long>(*count));
    return all.size() >= 5;
  }));
  EXPECT_EQ(all, (Octets{1, 2, 3, 4, 5}));
  EXPECT_EQ(link->read(in).error(), Error::kNotReady);

  EXPECT_EQ(link->write(Octets(100, 6)).value(), 64U) << "the rest is for the next";
  writes_end({LIBUSB_TRANSFER_COMPLETED});
  ASSERT_TRUE(soon([] { return heard().size() == 1; }));
  EXPECT_EQ(heard().front(), Octets(64, 6));
}

TEST_F(UsbLink, ADeviceThatTakesNothingFillsTheQueue) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  int taken = 0;
  EXPECT_TRUE(soon([&] {
    while (link->send(Octets{static_cast<std::uint8_t>(taken)})) ++taken;
    return taken >= 9;
  })) << taken;
  EXPECT_EQ(link->send(Octets{9}).error(), Error::kFull);
  EXPECT_EQ(taken, 9) << "one in flight, and eight that wait";
}

TEST_F(UsbLink, WhileNobodyReadsTheDeviceIsNotAsked) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  for (std::uint8_t i = 0; i < 100; ++i) device_says({{i}});
  ASSERT_TRUE(soon([] { return left_to_say() == 36 && fake_libusb().in_flight == 0; })) << left_to_say();
  std::array<std::uint8_t, 1> in{};
  ASSERT_EQ(link->receive(in).value(), 1U);
  EXPECT_EQ(in[0], 0);
  ASSERT_TRUE(soon([] { return left_to_say() == 35; })) << "room for one";
  for (std::uint8_t i = 1; i < 100; ++i) {
    ASSERT_TRUE(soon([&] { return link->receive(in).ok(); })) << int{i};
    ASSERT_EQ(in[0], i);
  }
}

TEST_F(UsbLink, AHaltedInputIsStartedAgain) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  reads_end(LIBUSB_TRANSFER_STALL);
  ASSERT_TRUE(soon([] { return fake_libusb().halts_cleared == 1 && fake_libusb().in_flight == kReads; }));
  EXPECT_EQ(link->counters().stalls, 1U);
  EXPECT_TRUE(link->connected());
  device_says({{5}});
  std::array<std::uint8_t, 1> in{};
  EXPECT_TRUE(soon([&] { return link->receive(in).ok(); }));
  EXPECT_EQ(in[0], 5);
}

TEST_F(UsbLink, AHaltedOutputIsStartedAgain) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  writes_end({LIBUSB_TRANSFER_STALL, LIBUSB_TRANSFER_COMPLETED});
  ASSERT_TRUE(link->send(Octets{1}).ok());
  ASSERT_TRUE(link->send(Octets{2}).ok());
  ASSERT_TRUE(soon([] { return heard().size() == 1; }));
  EXPECT_EQ(heard().front(), Octets{2}) << "the first is lost, and counted";
  EXPECT_EQ(link->counters().stalls, 1U);
  EXPECT_EQ(fake_libusb().halts_cleared, 1);
}

TEST_F(UsbLink, OneThatStaysHaltedIsGone) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  fake_libusb().clear_halt_error = LIBUSB_ERROR_NO_DEVICE;
  reads_end(LIBUSB_TRANSFER_STALL);
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  std::array<std::uint8_t, 1> in{};
  EXPECT_EQ(link->receive(in).error(), Error::kGone);
  EXPECT_EQ(link->send(in).error(), Error::kGone);
  fake_libusb().clear_halt_error = 0;
  EXPECT_TRUE(comes_back(*link));
}

TEST_F(UsbLink, CountsWhatWentWrongByItsKind) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  reads_end(LIBUSB_TRANSFER_ERROR);
  reads_end(LIBUSB_TRANSFER_OVERFLOW);
  writes_end({LIBUSB_TRANSFER_TIMED_OUT});
  ASSERT_TRUE(link->send(Octets{1}).ok());
  ASSERT_TRUE(soon([&] { return link->counters().out_timeouts == 1 && link->counters().errors == 2; }));
  EXPECT_EQ(link->counters().stalls, 0U);
  EXPECT_TRUE(link->connected());
}

TEST_F(UsbLink, TenFailuresInARowAreOneTooMany) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  reads_end(LIBUSB_TRANSFER_ERROR, 9);
  reads_end(LIBUSB_TRANSFER_COMPLETED);
  reads_end(LIBUSB_TRANSFER_ERROR, 9);
  ASSERT_TRUE(soon([&] { return link->counters().errors == 18 && fake_libusb().in_flight == kReads; }));
  EXPECT_TRUE(link->connected());
  reads_end(LIBUSB_TRANSFER_ERROR);
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  EXPECT_EQ(link->counters().errors, 19U);
  EXPECT_TRUE(comes_back(*link));
}

TEST_F(UsbLink, ATransferThatLibusbRefusesIsTheEnd) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  ASSERT_TRUE(soon([] { return fake_libusb().in_flight == kReads; }));
  fake_libusb().submit_error = LIBUSB_ERROR_NO_DEVICE;
  ASSERT_TRUE(link->send(Octets{1}).ok());
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  fake_libusb().submit_error = 0;
  EXPECT_TRUE(comes_back(*link));
  fake_libusb().submit_error = LIBUSB_ERROR_NO_DEVICE;
  device_says({{1}});  // a read ends, and no other can begin
  EXPECT_TRUE(soon([&] { return !link->connected(); }));
  std::array<std::uint8_t, 1> in{};
  EXPECT_EQ(link->receive(in).value(), 1U) << "what came before is read first";
  EXPECT_EQ(link->receive(in).error(), Error::kGone);
}

TEST_F(UsbLink, HearsOfPluggingWithoutBeingTended) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  fake_libusb().event = LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  fake_libusb().event = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED;
  EXPECT_TRUE(soon([&] { return link->connected(); }));
}

TEST_F(UsbLink, WithoutNewsOfPluggingTendFindsIt) {
  fake_libusb().watch_error = LIBUSB_ERROR_NOT_SUPPORTED;
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  fake_libusb().unplugged = true;
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  link->tend(later());
  ASSERT_TRUE(soon([&] { return !link->problem().empty(); }));
  EXPECT_TRUE(holds(link->problem(), "cannot open the USB device 0694:0002"));
  EXPECT_TRUE(holds(link->problem(), "plug it in"));
  fake_libusb().unplugged = false;
  EXPECT_TRUE(comes_back(*link));
  EXPECT_EQ(link->problem(), "");
}

// A kernel that keeps the transfers of a device that left: they stay allocated and their device open.
TEST_F(UsbLink, WhatTheKernelKeepsIsLeftToItAndTheLinkComesBack) {
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  ASSERT_TRUE(soon([] { return fake_libusb().in_flight == kReads; }));
  const int transfers = fake_libusb().transfers;
  fake_libusb().keep_transfers = true;
  fake_libusb().event = LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  EXPECT_EQ(fake_libusb().in_flight, kReads);
  EXPECT_EQ(fake_libusb().handles, 1) << "not closed";
  fake_libusb().keep_transfers = false;
  ASSERT_TRUE(comes_back(*link));
  EXPECT_TRUE(soon([] { return fake_libusb().in_flight == 2 * kReads; }));
  EXPECT_EQ(fake_libusb().transfers, 2 * transfers) << "new ones";
  EXPECT_EQ(fake_libusb().handles, 2);
  device_says({{5}});
  std::array<std::uint8_t, 1> in{};
  EXPECT_TRUE(soon([&] { return link->receive(in).ok(); }));
  *link = std::move(*UsbPacketLink::open(quick()));  // the first ends
  EXPECT_TRUE(link->connected());
  EXPECT_TRUE(soon([] { return fake_libusb().handles == 2; })) << "one is the kernel's";
}

TEST_F(UsbLink, WithoutLibusbItTriesAgain) {
  fake_libusb().init_error = LIBUSB_ERROR_OTHER;
  EXPECT_TRUE(holds(problem_of(), "cannot start libusb"));
  fake_libusb().init_error = 0;
  Opened<UsbPacketLink> link = UsbPacketLink::open(quick());
  ASSERT_TRUE(link) << link.problem();
  fake_libusb().init_error = LIBUSB_ERROR_OTHER;
  fake_libusb().event = LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  ASSERT_TRUE(soon([&] { return !link->connected(); }));
  link->tend(later());
  ASSERT_TRUE(soon([&] { return !link->problem().empty(); }));
  EXPECT_TRUE(holds(link->problem(), "/dev/bus/usb exists"));
  fake_libusb().init_error = 0;
  EXPECT_TRUE(comes_back(*link));
}

TEST_F(UsbLink, SaysWhyItCannotBeOpenedAndWhatToTry) {
  fake_libusb().list_error = LIBUSB_ERROR_NO_MEM;
  EXPECT_TRUE(holds(problem_of(), "unplug it, plug it in again"));
  fake_libusb().list_error = 0;
  fake_libusb().open_error = LIBUSB_ERROR_ACCESS;
  EXPECT_TRUE(holds(problem_of(), "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"0694\", MODE=\"0666\""));
  fake_libusb().open_error = 0;
  fake_libusb().claim_error = LIBUSB_ERROR_BUSY;
  EXPECT_TRUE(holds(problem_of(), "another program has it"));
  fake_libusb().claim_error = 0;
  fake_libusb().configuration_error = LIBUSB_ERROR_IO;
  EXPECT_TRUE(holds(problem_of(), "unplug it, plug it in again"));
  fake_libusb().configuration_error = 0;
  fake_libusb().packet = 0;
  EXPECT_TRUE(holds(problem_of(), "it lacks the expected endpoints"));
  fake_libusb().packet = 64;
  UsbSettings other = quick();
  other.product = 3;
  EXPECT_TRUE(holds(problem_of(other), "cannot open the USB device 0694:0003: "));
  EXPECT_EQ(problem_of(), "none");
}

TEST_F(UsbLink, IsTheDeviceOfTheSerialNumber) {
  UsbSettings settings = quick();
  settings.serial = "0016530A1B2C";
  EXPECT_EQ(problem_of(settings), "none");
  for (const char* other : {"0016530A1B2", "0016530A1B2D"}) {
    settings.serial = other;
    EXPECT_TRUE(holds(problem_of(settings), "with serial number " + settings.serial));
  }
}

TEST_F(UsbLink, ConfiguresAndResetsWhereItIsAsked) {
  fake_libusb().configuration = 0;
  EXPECT_EQ(problem_of(), "none");
  EXPECT_EQ(fake_libusb().configuration, 1);
  EXPECT_EQ(fake_libusb().resets, 0);
  UsbSettings settings = quick();
  settings.reset = true;
  EXPECT_EQ(problem_of(settings), "none");
  EXPECT_EQ(fake_libusb().resets, 1);
}

TEST_F(UsbLink, ALinkOfBytesSaysTheSame) {
  fake_libusb().open_error = LIBUSB_ERROR_BUSY;
  const Opened<UsbByteLink> link = UsbByteLink::open(quick());
  ASSERT_FALSE(link);
  EXPECT_TRUE(holds(link.problem(), "another program has it"));
}

}  // namespace
}  // namespace fencepost::linux
