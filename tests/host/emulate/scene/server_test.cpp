// On this machine's ptys and ports, with hal/linux as the host's end, on the clock of tests/stage.
#include "host/emulate/scene/server.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "drivers/create/create.hpp"
#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy2/camera.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/tty.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/folder.hpp"
#include "tests/host/emulate/scene/running.hpp"

namespace fencepost::emulate {
namespace {

namespace fs = std::filesystem;
using test::hex;

struct EmulateServer : testing::Test {
  const test::Folder folder;
};

TEST_F(EmulateServer, ShowsFramesAndThePoseOnPtys) {
  const Feed feed = moving_box(316, 208, 12);
  Running running(feed, unhurried());
  running.add("pixy2,baud=0", open_pty(folder.file("pixy2")));
  running.add("create2", open_pty(folder.file("create2")));
  running.start();
  auto camera_tty = linux::Tty::open({folder.file("pixy2"), 19'200});
  ASSERT_TRUE(camera_tty.ok()) << camera_tty.problem();
  auto wheels_tty = linux::Tty::open({folder.file("create2"), 115'200});
  ASSERT_TRUE(wheels_tty.ok()) << wheels_tty.problem();
  pixy2::Camera<linux::Tty> camera(*camera_tty);
  create::Create<linux::Tty> wheels(*wheels_tty, create::Config{});
  std::vector<sensor::Blob> seen;
  sensor::OdometrySample last;
  const bool all = eventually(running.clock(), [&] {
    const base::Time now = running.clock().now();
    if (const auto frame = camera.poll(now)) seen.push_back(frame->blobs[0]);
    if (const auto sample = wheels.poll(now)) last = *sample;
    return (seen.size() == feed.frames.size() && last.x.to_double() > 0.235) || running.finished();
  });
  EXPECT_TRUE(all) << seen.size() << " frames, x " << last.x.to_double();
  EXPECT_TRUE(running.join());
  EXPECT_TRUE(in_order(seen, feed));
  EXPECT_NEAR(last.x.to_double(), 0.24, 0.005);
  EXPECT_EQ(last.y.raw, 0);
}

TEST_F(EmulateServer, LinkIsThereWhileItRuns) {
  const std::string link = folder.file("pixy2");
  {
    OpenedTransport transport = open_pty(link);
    ASSERT_TRUE(transport.ok());
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_character_file(link));
    EXPECT_EQ((*transport)->place(), link);
    (*transport)->hang_up();
    EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
    EXPECT_EQ((*transport)->plug_in(), "");
    EXPECT_TRUE(fs::is_character_file(link));
  }
  EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
}

TEST_F(EmulateServer, LinkReplacesADeadOneAndNothingElse) {
  const std::string link = folder.file("pixy2");
  fs::create_symlink("/dev/pts/no_such_one", link);
  EXPECT_TRUE(open_pty(link).ok());
  std::ofstream(link) << "mine";
  OpenedTransport taken = open_pty(link);
  ASSERT_FALSE(taken.ok());
  EXPECT_NE(taken.problem().find("remove it"), std::string::npos) << taken.problem();
  EXPECT_TRUE(fs::is_regular_file(link));
  EXPECT_FALSE(open_pty(folder.file("no/such/folder")).ok());
}

TEST_F(EmulateServer, SurvivesAHostThatClosesAndReopens) {
  Running running(moving_box(316, 208, 1'000));
  running.add("cmucam1", open_pty(folder.file("camera")));
  running.start();
  for (int round = 0; round < 3; ++round) {
    auto tty = linux::Tty::open({folder.file("camera"), 115'200});
    ASSERT_TRUE(tty.ok()) << tty.problem();
    std::string heard;
    base::Time asked{-10'000};
    EXPECT_TRUE(eventually(running.clock(), [&] {
      const std::string command = "GV\r";
      const base::Time now = running.clock().now();
      // Bytes sent before the server has seen the host open are lost, as on a cable that is being plugged in.
      if (now - asked > base::milliseconds(100)) {
        asked = now;
        (void)tty->write({reinterpret_cast<const std::uint8_t*>(command.data()), command.size()});
      }
      std::array<std::uint8_t, 64> in{};
      if (const auto got = tty->read(in)) heard.append(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(*got));
      return heard.find("CMUcam v1.12\r:") != std::string::npos;
    })) << round;
    EXPECT_EQ(heard.find("GV"), std::string::npos) << "no echo";
  }
  running.stop();
  EXPECT_EQ(running.endpoint(0).faults().unplugs, 0U);
}

// `cat` and `printf > port` set no rate.
TEST_F(EmulateServer, IsHeardByAHostThatSetsNoBaudRate) {
  Running running(moving_box(316, 208, 1'000));
  running.add("cmucam4", open_pty(folder.file("camera")));
  running.start();
  { const auto other = linux::Tty::open({folder.file("camera"), 115'200}); }  // leaves nothing behind
  std::string heard;
  EXPECT_TRUE(eventually(running.clock(), [&] {
    const linux::Descriptor port(::open(folder.file("camera").c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    for (int i = 0; i < 20 && heard.find("CMUcam4") == std::string::npos; ++i) {
      if (i % 10 == 0 && ::write(port.get(), "GV\r", 3) != 3) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::array<char, 64> in{};
      if (const ssize_t got = ::read(port.get(), in.data(), in.size()); got > 0)
        heard.append(in.data(), static_cast<std::size_t>(got));
    }
    return heard.find("CMUcam4") != std::string::npos;
  })) << heard;
  running.stop();
}

// A megabyte that a camera of 115,200 baud would answer for minutes: the host's writes wait, and nothing piles up.
TEST_F(EmulateServer, AHostThatFloodsItWaits) {
  Running running(moving_box(316, 208, 1'000));
  running.add("cmucam2", open_pty(folder.file("camera")));
  running.start();
  const linux::Descriptor port(::open(folder.file("camera").c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  const std::string returns(1024, '\r');
  std::size_t sent = 0;
  for (int refused = 0; refused < 100 && sent < (std::size_t{1} << 20U);) {
    const ssize_t wrote = ::write(port.get(), returns.data(), returns.size());
    if (wrote > 0) sent += static_cast<std::size_t>(wrote);
    refused = wrote > 0 ? 0 : refused + 1;
    if (wrote <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::array<char, 4096> in{};
    while (::read(port.get(), in.data(), in.size()) > 0) {
    }
  }
  EXPECT_GT(sent, std::size_t{1} << 10U);
  EXPECT_LT(sent, std::size_t{1} << 18U) << "it never had to wait";
  running.stop();
}

// The answer to BM comes at the old rate; from then on the camera is heard, and hears, at the new one.
TEST_F(EmulateServer, FollowsACmucam4ThatChangesItsRate) {
  Running running(moving_box(316, 208, 1'000));
  running.add("cmucam4", open_pty(folder.file("camera")));
  running.start();
  for (const auto& [baud, command, expected] :
       {std::tuple(19'200U, "BM 250000\r", "ACK\r"), std::tuple(250'000U, "GV\r", "ACK\rCMUcam4 v1.02\r:")}) {
    auto tty = linux::Tty::open({folder.file("camera"), baud});
    ASSERT_TRUE(tty.ok()) << tty.problem();
    std::string heard;
    base::Time asked{-10'000};
    EXPECT_TRUE(eventually(running.clock(),
                           [&] {
                             const base::Time now = running.clock().now();
                             if (now - asked > base::milliseconds(500)) {
                               asked = now;
                               (void)tty->write({reinterpret_cast<const std::uint8_t*>(command), std::strlen(command)});
                             }
                             std::array<std::uint8_t, 64> in{};
                             if (const auto got = tty->read(in))
                               heard.append(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(*got));
                             return heard.find(expected) != std::string::npos;
                           }))
        << baud << ": " << heard;
  }
  running.stop();
}

// The first host has the right rate. The second one's wrong rate is reported once, and nothing gets through.
TEST_F(EmulateServer, ComparesTheBaudRateOfEachHost) {
  Running running(moving_box(316, 208, 1'000));
  running.add("cmucam4", open_pty(folder.file("camera")));
  running.start();
  std::array<std::uint8_t, 64> in{};
  {
    auto tty = linux::Tty::open({folder.file("camera"), 19'200});
    ASSERT_TRUE(tty.ok()) << tty.problem();
    EXPECT_TRUE(eventually(running.clock(), [&] {
      (void)tty->write(hex("0D"));
      return tty->read(in).ok();
    }));
  }
  auto tty = linux::Tty::open({folder.file("camera"), 115'200});
  ASSERT_TRUE(tty.ok()) << tty.problem();
  const auto complained = [&] {
    (void)tty->write(hex("0D"));
    const auto said = running.said();
    return std::ranges::any_of(
        said, [](const std::string& line) { return line.find("the host has set") != std::string::npos; });
  };
  EXPECT_TRUE(eventually(running.clock(), complained));
  // The answers that it still owed the first host come before.
  const auto quiet = [&] {
    const bool silent = !tty->read(in).ok();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return silent && !tty->read(in).ok();
  };
  EXPECT_TRUE(eventually(running.clock(), quiet));
  for (int i = 0; i < 50; ++i) {
    (void)tty->write(hex("0D"));
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
  }
  EXPECT_FALSE(tty->read(in).ok()) << "it has heard nothing to answer";
  running.stop();
  std::vector<std::string> complaints;
  for (const std::string& line : running.said()) {
    if (line.find("the host has set") != std::string::npos) complaints.push_back(line);
  }
  // Twice if the first one's end was noticed only when the second one had already spoken.
  EXPECT_GE(complaints.size(), 1U);
  EXPECT_LE(complaints.size(), 2U);
  for (const std::string& complaint : complaints) {
    EXPECT_NE(complaint.find("115200 Bd, the device 19200"), std::string::npos) << complaint;
  }
}

// One that speaks unasked.
TEST_F(EmulateServer, SaysGarbageAtAnotherBaudRate) {
  Running running(moving_box(320, 200, 1'000));
  running.add("pixy1", open_pty(folder.file("camera")));
  running.start();
  for (const bool right : {false, true}) {
    auto tty = linux::Tty::open({folder.file("camera"), right ? 19'200U : 57'600U});
    ASSERT_TRUE(tty.ok()) << tty.problem();
    pixy1::Camera<linux::Tty> camera(*tty);
    std::uint32_t frames = 0;
    bool heard = false;
    const auto begin = running.clock().now();
    while (running.clock().now() - begin < base::milliseconds(1'500)) {
      if (camera.poll(running.clock().now())) ++frames;
      heard = heard || camera.link() != sensor::LinkState::kSilent;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(heard) << "something comes";
    EXPECT_EQ(frames > 10, right) << frames;
  }
  running.stop();
}

TEST_F(EmulateServer, ShowsFramesOnTcp) {
  const Feed feed = moving_box(316, 208, 12);
  Running running(feed, unhurried());
  running.add("pixy2,baud=0", open_tcp("0"));
  running.start();
  Socket socket(running.place(0));
  ASSERT_TRUE(socket.connected()) << running.place(0);
  pixy2::Camera<Socket> camera(socket);
  std::vector<sensor::Blob> seen;
  EXPECT_TRUE(eventually(running.clock(), [&] {
    if (const auto frame = camera.poll(running.clock().now())) seen.push_back(frame->blobs[0]);
    return seen.size() == feed.frames.size() || running.finished();
  }));
  EXPECT_TRUE(running.join());
  EXPECT_TRUE(in_order(seen, feed));
}

TEST_F(EmulateServer, TakesOneHostAtATimeOnTcp) {
  Running running(moving_box(316, 208, 1'000));
  running.add("pixy2", open_tcp("127.0.0.1:0"));
  running.start();
  std::array<std::uint8_t, 64> in{};
  {
    Socket first(running.place(0));
    ASSERT_TRUE(eventually(running.clock(), [&] {
      (void)first.write(hex("AE C1 0E 00"));
      return first.read(in).ok();
    }));
    Socket second(running.place(0));
    EXPECT_TRUE(eventually(running.clock(), [&] {
      const auto got = second.read(in);
      return !got.ok() && got.error() == base::Error::kGone;
    }));
  }
  Socket third(running.place(0));
  EXPECT_TRUE(eventually(running.clock(), [&] {
    (void)third.write(hex("AE C1 0E 00"));
    return third.read(in).ok();
  })) << "the first one has gone";
}

TEST_F(EmulateServer, UnplugsAndComesBackUnderItsLink) {
  FaultSettings faults;
  faults.unplug = base::milliseconds(300);
  faults.unplug_time = base::milliseconds(300);
  Running running(moving_box(316, 208, 1'000));
  running.add("pixy2,baud=0", open_pty(folder.file("pixy2")), faults);
  running.start();
  auto tty = linux::Tty::open({folder.file("pixy2"), 19'200});
  ASSERT_TRUE(tty.ok()) << tty.problem();
  pixy2::Camera<linux::Tty> camera(*tty);
  int losses = 0;
  bool there = true;
  EXPECT_TRUE(eventually(running.clock(), [&] {
    const base::Time now = running.clock().now();
    tty->tend(now);
    (void)camera.poll(now);
    if (there && !tty->connected()) ++losses;
    there = tty->connected();
    return losses == 2 && there;
  })) << losses;
  running.stop();
  EXPECT_GE(running.endpoint(0).faults().unplugs, 2U);
}

TEST_F(EmulateServer, SaysWhyAPortCannotBe) {
  OpenedTransport first = open_tcp("0");
  ASSERT_TRUE(first.ok());
  const std::string place = (*first)->place();
  OpenedTransport second = open_tcp(place);
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.problem().find(place), std::string::npos) << second.problem();
  EXPECT_NE(second.problem().find("choose another port"), std::string::npos) << second.problem();
  for (const char* wrong : {"", "port", "99999", "127.0.0.1:", "-1", "no.such.host.invalid:0"}) {
    EXPECT_FALSE(open_tcp(wrong).ok()) << wrong;
  }
  EXPECT_FALSE(open_can("no_such_interface_here").ok());
  EXPECT_FALSE(open_can("nosuch0").ok());
}

}  // namespace
}  // namespace fencepost::emulate
