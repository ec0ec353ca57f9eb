#include "host/emulate/models/grove.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

struct GroveModel : ::testing::Test {
  static constexpr base::Time kUp = base::Time{} + Grove::kBoot;
  // The document's box: middle (87, 83), 77 x 65, the first class. 87 - 77/2 = 48.5.
  static constexpr sensor::Blob kBox{1, 49, 51, 125, 115, {}, {}, 0, {}};

  GroveModel() { (void)camera.power_up({}); }
  static std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }
  std::string ask(const std::string& commands, base::Time now = kUp) {
    std::string answers;
    for (const char c : commands) answers += text_of(camera.take(static_cast<std::uint8_t>(c), now));
    return answers;
  }
  std::string see(std::initializer_list<sensor::Blob> blobs) {
    sensor::BlobFrame frame;
    for (const sensor::Blob& blob : blobs) (void)frame.blobs.push_back(blob);
    return text_of(camera.see(frame, kUp));
  }

  Grove camera;
};

TEST_F(GroveModel, TheDocumentsResult) {
  EXPECT_EQ(see({kBox}), "") << "it was not started";
  EXPECT_EQ(ask("AT+INVOKE=-1,0,1\r\n").substr(0, 49), "\r{\"type\": 0, \"name\": \"INVOKE\", \"code\": 0, \"data\":");
  EXPECT_EQ(see({kBox}),
            "\r{\"type\": 1, \"name\": \"INVOKE\", \"code\": 0, \"data\": {\"count\": 0, \"perf\": [6, 54, 1], "
            "\"boxes\": [[87, 83, 77, 65, 90, 0]], \"resolution\": [240, 240]}}\n");
  EXPECT_EQ(see({}).find("\"boxes\": [], "), 83U) << "nothing is seen";
  EXPECT_EQ(ask("AT+INVOKE?\r"), "\r{\"type\": 0, \"name\": \"INVOKE?\", \"code\": 0, \"data\": 1}\n");
  EXPECT_EQ(ask("AT+BREAK\r"), "\r{\"type\": 0, \"name\": \"BREAK\", \"code\": 0, \"data\": 0}\n");
  EXPECT_TRUE(see({kBox}).empty());
  EXPECT_TRUE(camera.in_use());
}

TEST_F(GroveModel, AsOftenAsAsked) {
  (void)ask("AT+INVOKE=2,0,1\r");
  EXPECT_FALSE(see({}).empty());
  EXPECT_FALSE(see({}).empty());
  EXPECT_TRUE(see({}).empty());
}

TEST_F(GroveModel, NamesWhatItDoesNotDo) {
  for (const char* command : {"ID?", "NAME?", "VER?", "STAT?"}) {
    EXPECT_EQ(ask(std::string("AT+") + command + "\r").substr(0, 12), "\r{\"type\": 0,") << command;
  }
  EXPECT_EQ(ask("AT+TSCORE=60\rAT+\x01\rhello\r").substr(0, 12), "\r{\"type\": 2,");
  EXPECT_EQ(ask("AT+INVOKE=-1,0\r").substr(0, 12), "\r{\"type\": 2,");
  EXPECT_EQ(ask("AT+INVOKE=-1,1,0\r").substr(0, 12), "\r{\"type\": 0,");
  EXPECT_EQ(camera.not_emulated(),
            (std::vector<std::string>{"TSCORE", "unreadable bytes", "INVOKE of what differs", "INVOKE with pictures"}));
}

TEST_F(GroveModel, IsDeafWhileItStarts) {
  EXPECT_EQ(ask("AT+ID?\r", base::Time{} + base::milliseconds(999)), "");
  EXPECT_EQ(ask("AT+ID?\r"), "\r{\"type\": 0, \"name\": \"ID?\", \"code\": 0, \"data\": \"7e2d02cf\"}\n");
}

// As the vendor's library asks: how much there is, then that much.
TEST_F(GroveModel, OnI2cItsBytesWait) {
  GroveOnI2c bus(camera);
  const auto transfer = [&](const char* out, std::size_t expected) {
    return bus.transfer(0x62, test::hex(out), expected, kUp);
  };
  EXPECT_FALSE(bus.transfer(0x32, {}, 1, kUp)) << "another address";
  EXPECT_FALSE(bus.transfer(0x62, {}, 1, {})) << "it starts";
  EXPECT_EQ(transfer("10 02 00 07 41 54 2B 49 44 3F 0D 00 00", 0), Bytes{}) << "AT+ID? and CR";
  EXPECT_EQ(transfer("10 03 00 00 00 00", 0), Bytes{});
  EXPECT_EQ(transfer("", 2), test::hex("00 3B"));
  EXPECT_EQ(transfer("10 01 00 06 00 00", 0), Bytes{});
  EXPECT_EQ(transfer("", 6), test::hex("0D 7B 22 74 79 70"));
  EXPECT_EQ(transfer("10 03 00 00 00 00", 0), Bytes{});
  EXPECT_EQ(transfer("", 2), test::hex("00 35"));
}

}  // namespace
}  // namespace fencepost::emulate
