// hal/linux/usb_link.hpp through libusb and the kernel's own USB stack; only the wire is made of software.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>

#include "hal/linux/usb_link.hpp"
#include "hal/linux/wait.hpp"
#include "tests/guest/eventually.hpp"
#include "tests/guest/nxt_model.hpp"

namespace fencepost::guest {
namespace {

using base::Error;
using base::Result;
using linux::kNxtUsb;
using linux::Opened;
using linux::UsbByteLink;
using linux::UsbPacketLink;
using linux::UsbSettings;

constexpr std::uint8_t kOut = kNxtOut;
constexpr std::uint8_t kIn = kNxtIn;
const Bytes kAskFirmware = {0x01, 0x88};                             // protocol 1.124, firmware 1.29
const Bytes kFirmware = {0x02, 0x88, 0x00, 0x7C, 0x01, 0x1D, 0x01};  // LEGO MINDSTORMS NXT BDK, appendix 1

template <class Link>
Opened<Link> open_soon(const UsbSettings& settings) {
  Opened<Link> link = Link::open(settings);
  eventually([&] {
    if (!link) link = Link::open(settings);
    return link.ok();
  });
  return link;
}

class NxtUsb : public testing::Test {
 protected:
  void SetUp() override {
    UsbModel model = nxt_model();
    model.on_bulk = [this](const Bytes& telegram) {
      if (telegram == kAskFirmware && answering) brick->give(kIn, kFirmware);
    };
    brick = std::make_unique<UsbipDevice>(model);
    brick->plug();
    Opened<UsbPacketLink> opened = open_soon<UsbPacketLink>(kNxtUsb);
    ASSERT_TRUE(opened) << opened.problem();
    link.emplace(std::move(*opened));
  }

  Result<Bytes> receive(std::size_t room = 64) {
    Bytes buffer(room);
    const Result<std::size_t> size = settled([&] { return link->receive(buffer); });
    if (!size) return size.error();
    buffer.resize(*size);
    return buffer;
  }
  void expect_answer() {
    EXPECT_EQ(link->send(kAskFirmware).value(), 2U);
    const Result<Bytes> answer = receive();
    ASSERT_TRUE(answer) << static_cast<int>(answer.error());
    EXPECT_EQ(*answer, kFirmware);
  }
  void expect_nothing() {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::array<std::uint8_t, 64> buffer{};
    EXPECT_EQ(link->receive(buffer).error(), Error::kNotReady);
  }
  bool comes_back() {
    return eventually([this] {
      link->tend(clock.now());
      return link->connected();
    });
  }

  const linux::MonotonicClock clock;
  std::atomic<bool> answering = true;  // the device asks on a thread of its own
  std::unique_ptr<UsbipDevice> brick;
  std::optional<UsbPacketLink> link;
};

TEST_F(NxtUsb, AnswersInOrder) {
  for (int i = 0; i < 200 && !HasFailure(); ++i) expect_answer();
  EXPECT_EQ(link->counters().errors + link->counters().stalls + link->counters().out_timeouts, 0U);
}

TEST_F(NxtUsb, WakesTheLoop) {
  linux::WaitSet set;
  set.add_readable(link->descriptor());
  std::array<std::uint8_t, 64> buffer{};
  EXPECT_EQ(link->receive(buffer).error(), Error::kNotReady);
  EXPECT_FALSE(set.wait_until(clock, clock.now() + base::milliseconds(50)));
  brick->give(kIn, {1, 2, 3});
  EXPECT_TRUE(set.wait_until(clock, clock.now() + kPatience));
  EXPECT_EQ(link->receive(buffer).value(), 3U);
  EXPECT_FALSE(set.wait_until(clock, clock.now() + base::milliseconds(50)));
}

TEST_F(NxtUsb, IsNotReadyWhileTheBrickIsSilent) {
  answering = false;
  EXPECT_TRUE(link->send(kAskFirmware));
  expect_nothing();
  EXPECT_TRUE(link->connected());
  answering = true;
  expect_answer();
}

TEST_F(NxtUsb, TakesALateAnswer) {
  brick->hold(true);
  EXPECT_TRUE(link->send(kAskFirmware));
  expect_nothing();
  brick->hold(false);
  const Result<Bytes> answer = receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(*answer, kFirmware);
}

TEST_F(NxtUsb, KeepsTelegramsApart) {
  const Bytes full(64, 0x5A);  // fills a packet: nothing but the transfer's end tells where it ends
  brick->give(kIn, full);
  brick->give(kIn, {7});
  EXPECT_EQ(*receive(), full);
  EXPECT_EQ(*receive(), Bytes{7});
}

TEST_F(NxtUsb, DropsWhatDoesNotFitTheBuffer) {
  brick->give(kIn, {1, 2, 3, 4, 5});
  brick->give(kIn, {6});
  EXPECT_EQ(receive(4).error(), Error::kBadInput);
  EXPECT_EQ(*receive(4), Bytes{6});
}

TEST_F(NxtUsb, RefusesTelegramsLongerThanAPacket) {
  EXPECT_EQ(link->send(Bytes(65)).error(), Error::kRefused);
  EXPECT_EQ(link->send(Bytes(64)).value(), 64U);
}

TEST_F(NxtUsb, GoesOnAfterAStallOfTheAnswer) {
  brick->halt(kIn);
  ASSERT_TRUE(eventually([this] { return link->counters().stalls >= 1; }));
  expect_answer();
  EXPECT_TRUE(link->connected());
}

TEST_F(NxtUsb, GoesOnAfterAStallOfTheQuestion) {
  brick->halt(kOut);
  EXPECT_TRUE(link->send(kAskFirmware));
  ASSERT_TRUE(eventually([this] { return link->counters().stalls == 1; }));
  expect_answer();
}

TEST_F(NxtUsb, CountsGarbledAnswersAndGoesOn) {
  brick->garble(3);
  ASSERT_TRUE(eventually([this] { return link->counters().errors == 3; }));
  expect_answer();
  EXPECT_TRUE(link->connected());
}

TEST_F(NxtUsb, CountsAnAnswerLongerThanAPacket) {
  brick->give(kIn, Bytes(65));
  ASSERT_TRUE(eventually([this] { return link->counters().errors == 1; }));
  expect_answer();
}

TEST_F(NxtUsb, OpensAnewAfterTooManyGarbledAnswers) {
  brick->garble(1000);
  EXPECT_EQ(receive().error(), Error::kGone);
  brick->garble(0);
  ASSERT_TRUE(comes_back()) << link->problem();
  expect_answer();
}

TEST_F(NxtUsb, IsFullWhenTheBrickTakesNothing) {
  brick->hold(true);
  int taken = 0;
  while (taken < 100 && link->send(kAskFirmware)) ++taken;
  EXPECT_GE(taken, 8);
  EXPECT_LE(taken, 9);  // eight wait, one is on its way
  EXPECT_EQ(link->send(kAskFirmware).error(), Error::kFull);
  ASSERT_TRUE(eventually([this] { return link->counters().out_timeouts >= 1; }));
  EXPECT_GE(brick->taken_back(), 1);
  brick->hold(false);
  EXPECT_EQ(*receive(), kFirmware);
}

TEST_F(NxtUsb, LosesNothingWhenNobodyReads) {
  constexpr std::uint8_t kTelegrams = 200;  // three times what is kept here
  for (std::uint8_t i = 0; i < kTelegrams; ++i) brick->give(kIn, {i, 1});
  ASSERT_TRUE(eventually([this] { return brick->waiting() == 0; }));
  for (std::uint8_t i = 0; i < kTelegrams && !HasFailure(); ++i) {
    const Result<Bytes> telegram = receive();
    ASSERT_TRUE(telegram) << int{i};
    EXPECT_EQ(*telegram, (Bytes{i, 1}));
  }
  expect_answer();
}

TEST_F(NxtUsb, TellsOfAnUnplugWithTransfersInFlightAndComesBack) {
  ASSERT_TRUE(eventually([this] { return brick->waiting() > 0; }));
  brick->hold(true);
  EXPECT_TRUE(link->send(kAskFirmware));
  brick->unplug();
  EXPECT_EQ(receive().error(), Error::kGone);
  EXPECT_EQ(link->send(kAskFirmware).error(), Error::kGone);
  EXPECT_FALSE(link->connected());
  link->tend(clock.now());
  ASSERT_TRUE(eventually([this] { return !link->problem().empty(); }));
  EXPECT_NE(link->problem().find("0694:0002"), std::string::npos) << link->problem();
  brick->plug();
  ASSERT_TRUE(comes_back()) << link->problem();
  expect_answer();
}

TEST_F(NxtUsb, GivesWhatCameBeforeAnUnplugFirst) {
  brick->give(kIn, {9, 9});
  ASSERT_TRUE(eventually([this] { return brick->waiting() == 4; }));  // it went over, and the next ones wait
  brick->unplug();
  ASSERT_TRUE(eventually([this] { return !link->connected(); }));
  EXPECT_EQ(*receive(), (Bytes{9, 9}));
  EXPECT_EQ(receive().error(), Error::kGone);
}

TEST_F(NxtUsb, IsFoundByUdevWithoutBeingLookedFor) {
  brick->unplug();
  ASSERT_TRUE(eventually([this] { return !link->connected(); }));
  brick->plug();
  EXPECT_TRUE(eventually([this] { return link->connected(); })) << link->problem();
  expect_answer();
}

TEST_F(NxtUsb, SurvivesManyUnplugs) {
  for (int i = 0; i < 3 && !HasFailure(); ++i) {
    brick->unplug();
    ASSERT_TRUE(eventually([this] { return !link->connected(); }));
    brick->plug();
    ASSERT_TRUE(comes_back()) << link->problem();
    expect_answer();
  }
}

// libusb's own end is not safe while it hears of plugging from udev.
TEST_F(NxtUsb, EndsAtTheMomentOfAnUnplug) {
  for (int i = 0; i < 4 && !HasFailure(); ++i) {
    brick->unplug();
    link.reset();
    brick->plug();
    Opened<UsbPacketLink> opened = open_soon<UsbPacketLink>(kNxtUsb);
    ASSERT_TRUE(opened) << opened.problem();
    link.emplace(std::move(*opened));
    expect_answer();
  }
}

TEST_F(NxtUsb, IsForOneProgramAlone) {
  Opened<UsbPacketLink> second = UsbPacketLink::open(kNxtUsb);
  ASSERT_FALSE(second);
  EXPECT_NE(second.problem().find("another program has it"), std::string::npos) << second.problem();
}

TEST_F(NxtUsb, IsChosenBySerialNumber) {
  link.reset();
  UsbSettings settings = kNxtUsb;
  settings.serial = "0016530A1B2D";
  Opened<UsbPacketLink> other = UsbPacketLink::open(settings);
  ASSERT_FALSE(other);
  EXPECT_NE(other.problem().find("0016530A1B2D"), std::string::npos) << other.problem();
  settings.serial = "0016530A1B2C";
  Opened<UsbPacketLink> mine = UsbPacketLink::open(settings);
  EXPECT_TRUE(mine) << mine.problem();
}

TEST_F(NxtUsb, NamesMissingEndpoints) {
  link.reset();
  UsbSettings settings = kNxtUsb;
  settings.in_endpoint = 0x83;
  Opened<UsbPacketLink> other = UsbPacketLink::open(settings);
  ASSERT_FALSE(other);
  EXPECT_NE(other.problem().find("lacks the expected endpoints"), std::string::npos) << other.problem();
}

TEST_F(NxtUsb, WorksAfterAReset) {
  link.reset();
  UsbSettings settings = kNxtUsb;
  settings.reset = true;
  Opened<UsbPacketLink> opened = open_soon<UsbPacketLink>(settings);
  ASSERT_TRUE(opened) << opened.problem();
  link.emplace(std::move(*opened));
  expect_answer();
}

TEST_F(NxtUsb, IsAStreamOfBytesToo) {
  link.reset();
  Opened<UsbByteLink> stream = UsbByteLink::open(kNxtUsb);
  ASSERT_TRUE(stream) << stream.problem();
  for (const std::uint8_t byte : kFirmware) brick->give(kIn, {byte});
  Bytes heard;
  std::array<std::uint8_t, 3> buffer{};
  while (heard.size() < kFirmware.size()) {
    const Result<std::size_t> count = settled([&] { return stream->read(buffer); });
    ASSERT_TRUE(count);
    heard.insert(heard.end(), buffer.begin(), buffer.begin() + static_cast<long>(*count));
  }
  EXPECT_EQ(heard, kFirmware);
  EXPECT_EQ(stream->write(Bytes(100)).value(), 64U);
  brick->unplug();
  EXPECT_EQ(settled([&] { return stream->read(buffer); }).error(), Error::kGone);
  EXPECT_EQ(stream->write(Bytes(1)).error(), Error::kGone);
}

}  // namespace
}  // namespace fencepost::guest
