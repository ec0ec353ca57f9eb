// hal/linux/can.hpp on the kernel's own SocketCAN, over virtual interfaces.
#include "hal/linux/can.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "hal/linux/wait.hpp"
#include "tests/guest/eventually.hpp"

namespace fencepost::guest {
namespace {

using base::Error;
using base::milliseconds;
using base::Result;
using bus::CanFrame;
using linux::Can;
using linux::Opened;

const std::string kInterface = "vcan7";

void shell(const std::string& line) { ASSERT_EQ(std::system(line.c_str()), 0) << line; }

class CanTest : public testing::Test {
 protected:
  void SetUp() override {
    shell("ip link add " + kInterface + " type vcan");
    shell("ip link set " + kInterface + " up");
  }
  void TearDown() override { std::system(("ip link delete " + kInterface + " 2> /dev/null").c_str()); }

  void listen(std::vector<linux::CanFilter> filters = {}) {
    Opened<Can> opened = Can::open({kInterface, std::move(filters)}, clock);
    ASSERT_TRUE(opened) << opened.problem();
    can.emplace(std::move(*opened));
  }
  Result<CanFrame> receive() {
    return settled([this] { return can->receive(); });
  }
  // A frame from another program; flags as in linux/can.h.
  void send(canid_t id, const std::vector<std::uint8_t>& data = {}) {
    const linux::Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW));
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(kInterface.c_str()));
    const void* anything = &address;
    ASSERT_EQ(::bind(socket.get(), static_cast<const sockaddr*>(anything), sizeof address), 0);
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = static_cast<std::uint8_t>((id & CAN_ERR_FLAG) != 0 ? CAN_ERR_DLC : data.size());
    std::copy(data.begin(), data.end(), frame.data);
    ASSERT_EQ(::write(socket.get(), &frame, sizeof frame), static_cast<ssize_t>(sizeof frame)) << errno;
  }
  bool comes_back() {
    return eventually([this] {
      can->tend(clock.now());
      return can->connected();
    });
  }

  const linux::MonotonicClock clock;
  std::optional<Can> can;
};

TEST_F(CanTest, TakesFramesOfEachKind) {
  listen();
  EXPECT_EQ(can->receive().error(), Error::kNotReady);
  send(0x201, {1, 2, 3, 4, 5, 6, 7, 0xFF});
  send(0x1ABCDEF0 | CAN_EFF_FLAG, {9});
  send(0x7FF | CAN_RTR_FLAG);
  const Result<CanFrame> standard = receive();
  ASSERT_TRUE(standard);
  EXPECT_EQ(standard->id, 0x201U);
  EXPECT_FALSE(standard->extended || standard->remote);
  EXPECT_EQ(standard->length, 8);
  EXPECT_EQ(standard->data, (std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 0xFF}));
  const Result<CanFrame> extended = receive();
  ASSERT_TRUE(extended);
  EXPECT_EQ(extended->id, 0x1ABCDEF0U);
  EXPECT_TRUE(extended->extended);
  EXPECT_EQ(extended->length, 1);
  const Result<CanFrame> remote = receive();
  ASSERT_TRUE(remote);
  EXPECT_TRUE(remote->remote);
  EXPECT_EQ(remote->id, 0x7FFU);
  EXPECT_EQ(can->receive().error(), Error::kNotReady);
}

TEST_F(CanTest, StampsFramesWhenTheyCameAndNotWhenTheyAreRead) {
  listen();
  base::Time before;
  base::Time read;
  std::optional<base::Time> stamp;
  // The kernel starts stamping a little after it is asked: until then a frame is as old as its reading.
  EXPECT_TRUE(eventually([&] {
    before = clock.now();
    send(0x100);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // or more, so that stamp and reading differ
    read = clock.now();
    const Result<CanFrame> frame = receive();
    stamp = frame ? frame->received : std::nullopt;
    return !frame || (stamp && *stamp < read);
  }));
  ASSERT_TRUE(stamp);
  EXPECT_GE(*stamp, before - milliseconds(1));
  EXPECT_LT(*stamp, read);
}

TEST_F(CanTest, WakesTheLoop) {
  listen();
  linux::WaitSet set;
  set.add_readable(can->descriptor());
  EXPECT_FALSE(set.wait_until(clock, clock.now() + milliseconds(20)));
  send(0x100);
  EXPECT_TRUE(set.wait_until(clock, clock.now() + kPatience));
}

TEST_F(CanTest, LetsThroughWhatAnyFilterMatches) {
  listen({{.id = 0x201, .mask = 0x7FF}, {.id = 0x1800, .mask = 0xFF00, .extended = true}});
  send(0x200);
  send(0x201 | CAN_EFF_FLAG);
  send(0x201);
  send(0x1234 | CAN_EFF_FLAG);
  send(0x18FF | CAN_EFF_FLAG);
  send(0x000);
  const Result<CanFrame> first = receive();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->id, 0x201U);
  EXPECT_FALSE(first->extended);
  const Result<CanFrame> second = receive();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->id, 0x18FFU);
  EXPECT_TRUE(second->extended);
  EXPECT_EQ(can->receive().error(), Error::kNotReady);
}

TEST_F(CanTest, TellsOfErrorsOnTheBus) {
  listen();
  send(CAN_ERR_FLAG | CAN_ERR_PROT);
  send(0x100);
  EXPECT_EQ(receive().error(), Error::kBadInput);
  EXPECT_TRUE(can->connected());
  EXPECT_EQ(receive()->id, 0x100U);
}

TEST_F(CanTest, IsGoneWhileTheControllerIsBusOff) {
  listen();
  send(CAN_ERR_FLAG | CAN_ERR_BUSOFF);
  EXPECT_EQ(receive().error(), Error::kGone);
  EXPECT_EQ(can->receive().error(), Error::kGone);
  EXPECT_FALSE(can->connected());
  send(CAN_ERR_FLAG | CAN_ERR_RESTARTED);
  send(0x100);
  EXPECT_TRUE(eventually([this] { return can->receive().ok(); }));
  EXPECT_TRUE(can->connected());
  EXPECT_EQ(can->receive().error(), Error::kNotReady);
}

TEST_F(CanTest, IsGoneWhileTheInterfaceIsDown) {
  listen();
  send(0x123);
  shell("ip link set " + kInterface + " down");
  EXPECT_EQ(receive()->id, 0x123U) << "a frame from before is given out before";
  EXPECT_EQ(receive().error(), Error::kGone);
  EXPECT_FALSE(can->connected());
  EXPECT_EQ(can->descriptor(), -1);
  can->tend(clock.now());
  EXPECT_FALSE(can->connected());
  EXPECT_NE(can->problem().find("ip link set " + kInterface + " up"), std::string::npos) << can->problem();
  shell("ip link set " + kInterface + " up");
  ASSERT_TRUE(comes_back()) << can->problem();
  send(0x124);
  EXPECT_EQ(receive()->id, 0x124U);
}

TEST_F(CanTest, FindsAnAdapterThatWasUnplugged) {
  listen();
  shell("ip link delete " + kInterface);
  EXPECT_EQ(receive().error(), Error::kGone);
  can->tend(clock.now());
  EXPECT_NE(can->problem().find("plug the adapter in"), std::string::npos) << can->problem();
  SetUp();
  ASSERT_TRUE(comes_back()) << can->problem();
  send(0x125);
  EXPECT_EQ(receive()->id, 0x125U);
}

TEST_F(CanTest, SaysWhatIsWrongWithAnInterface) {
  shell("ip link set " + kInterface + " down");
  Opened<Can> down = Can::open({kInterface, {}}, clock);
  ASSERT_FALSE(down);
  EXPECT_NE(down.problem().find("ip link set " + kInterface + " up"), std::string::npos) << down.problem();
  Opened<Can> missing = Can::open({"can42", {}}, clock);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.problem().find("can42"), std::string::npos);
  EXPECT_NE(missing.problem().find("plug the adapter in"), std::string::npos) << missing.problem();
  Opened<Can> long_name = Can::open({"an_interface_name_too_long", {}}, clock);
  ASSERT_FALSE(long_name);
  EXPECT_NE(long_name.problem().find("1 to 15 characters"), std::string::npos) << long_name.problem();
  Opened<Can> other = Can::open({"lo", {}}, clock);
  EXPECT_FALSE(other) << "the loopback of the internet is no CAN";
}

TEST_F(CanTest, TellsOfFramesItHadNoRoomFor) {
  listen();
  shell("cangen " + kInterface + " -g 0 -n 20000 -I 123 -L 8 -D i -i");
  int frames = 0;
  for (; can->receive().ok(); ++frames) continue;
  ASSERT_GT(frames, 0);
  ASSERT_LT(frames, 20'000);
  send(0x200);
  const Result<CanFrame> news = receive();
  ASSERT_FALSE(news);
  EXPECT_EQ(news.error(), Error::kBadInput);
  EXPECT_EQ(receive()->id, 0x200U);
  send(0x201);
  EXPECT_EQ(receive()->id, 0x201U) << "a loss is reported once";
}

TEST_F(CanTest, HearsARecordedLog) {
  const std::string log = std::filesystem::temp_directory_path() / "fencepost_can.log";
  {
    std::ofstream file(log);
    for (int i = 0; i < 50; ++i) {
      std::array<char, 80> line{};
      std::snprintf(line.data(), line.size(), "(1700000000.%06d) %s 201#%08X%08X\n", i * 10'000, kInterface.c_str(), i,
                    3 * i);
      file << line.data();
    }
  }
  listen({{.id = 0x201, .mask = 0x7FF}});
  shell("canplayer -I " + log);
  std::optional<base::Time> first;
  std::optional<base::Time> last;
  for (std::uint8_t i = 0; i < 50 && !HasFailure(); ++i) {
    const Result<CanFrame> frame = receive();
    ASSERT_TRUE(frame && frame->received) << int{i};
    EXPECT_EQ(frame->data, (std::array<std::uint8_t, 8>{0, 0, 0, i, 0, 0, 0, static_cast<std::uint8_t>(3 * i)}));
    EXPECT_TRUE(!last || *frame->received >= *last - milliseconds(1));
    if (!first) first = frame->received;
    last = frame->received;
  }
  ASSERT_TRUE(first && last);
  // Played at the pace of the recording, which is 0.49 s long; never faster.
  EXPECT_GE(*last - *first, milliseconds(450));
  std::filesystem::remove(log);
}

}  // namespace
}  // namespace fencepost::guest
