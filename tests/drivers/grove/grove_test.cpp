#include "drivers/grove/grove.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/fake/scripted_link.hpp"
#include "host/emulate/models/grove.hpp"
#include "tests/drivers/bench/i2c_cable.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/drivers/says.hpp"
#include "tests/drivers/states/reveal.hpp"
#include "tests/drivers/states/scanned.hpp"

namespace fencepost::test {
FENCEPOST_REVEAL(GroveState, &grove::Decoder::state_);
FENCEPOST_REVEAL(GroveDepth, &grove::Decoder::depth_);
FENCEPOST_REVEAL(GroveArrays, &grove::Decoder::arrays_);
FENCEPOST_REVEAL(GroveTextSize, &grove::Decoder::text_size_);
FENCEPOST_REVEAL(GroveNumbers, &grove::Decoder::number_count_);
}  // namespace fencepost::test

namespace fencepost::grove {
namespace {

using sensor::Blob;
using sensor::LinkState;

struct Reading {
  Reading& bytes(std::string_view bytes) {
    for (const char byte : bytes) {
      const Event event = decoder.feed(test::octet(byte), now);
      if (event == Event::kFrame) frames.push_back(decoder.frame());
      if (event != Event::kNone) ++messages;
      ++now.raw;
    }
    return *this;
  }

  Decoder decoder;
  base::Time now{0};
  std::vector<sensor::BlobFrame> frames;
  std::size_t messages = 0;
};

std::string result(const std::string& data) {
  return "\r{\"type\": 1, \"name\": \"INVOKE\", \"code\": 0, \"data\": {" + data + "}}\n";
}
std::string boxes(const std::string& boxes) { return result("\"boxes\": [" + boxes + "]"); }

Blob only(const std::string& data) {
  Reading reading;
  reading.bytes(result(data));
  EXPECT_EQ(reading.frames.size(), 1U) << data;
  if (reading.frames.empty() || reading.frames[0].blobs.empty()) return {};
  return reading.frames[0].blobs[0];
}

// The vendor's document: middle (87, 83), 77 x 65, class 0. Columns 48.5 to 125.5, rows 50.5 to 115.5: nearest pixels.
constexpr Blob kExample{1, 49, 51, 125, 115, {865}, {825}, 0, {}};

TEST(GroveDecoder, TheDocumentsResult) {
  Reading reading;
  reading.bytes(
      result(R"("count": 8, "perf": [8, 365, 0], "boxes": [[87, 83, 77, 65, 70, 0]], "resolution": [240, 240])"));
  ASSERT_EQ(reading.frames.size(), 1U);
  EXPECT_EQ(reading.frames[0].frame, 8U);
  EXPECT_EQ(reading.frames[0].t.raw, 1) << "its brace";
  ASSERT_EQ(reading.frames[0].blobs.size(), 1U);
  EXPECT_EQ(reading.frames[0].blobs[0], kExample);
}

TEST(GroveDecoder, SpacesAndLineEndsAreFree) {
  for (const std::string line :
       {"\r{\"type\":1,\"name\":\"INVOKE\",\"code\":0,\"data\":{\"boxes\":[[87,83,77,65,70,0]]}}\n",
        "\r{ \"type\" : 1 , \"name\" : \"INVOKE\" , \"code\" : 0 , \"data\" : { \"boxes\" : [ [ 87 , 83 , 77 , 65 , 70 "
        ", 0 ] ] } }\r\n",
        "\r{\"data\": {\"boxes\": [[87, 83, 77, 65, 70, 0]]}, \"code\": 0, \"name\": \"INVOKE\", \"type\": 1}\r"}) {
    Reading reading;
    reading.bytes(line);
    ASSERT_EQ(reading.frames.size(), 1U) << line;
    EXPECT_EQ(reading.frames[0].blobs[0], kExample) << line;
    EXPECT_EQ(reading.frames[0].frame, 1U) << "counted by itself";
  }
}

TEST(GroveDecoder, TheResolutionIsThatOfTheMessage) {
  EXPECT_EQ(only(R"("boxes": [[320, 240, 128, 96, 70, 4]], "resolution": [640, 480])"),
            (Blob{5, 96, 96, 143, 143, {1'195}, {1'195}, 0, {}}));
  EXPECT_EQ(only(R"("resolution": [480, 480], "boxes": [[240, 240, 96, 96, 70, 4]])"),
            (Blob{5, 96, 96, 143, 143, {1'195}, {1'195}, 0, {}}));
}

TEST(GroveDecoder, TheWholePictureAndItsEdges) {
  EXPECT_EQ(only(R"("boxes": [[120, 120, 240, 240, 100, 254]])"), (Blob{255, 0, 0, 239, 239, {1'195}, {1'195}, 0, {}}));
  EXPECT_EQ(only(R"("boxes": [[230, 5, 40, 40, 1, 0]])"), (Blob{1, 210, 0, 239, 24, {2'295}, {45}, 0, {}}))
      << "cut off";
  EXPECT_EQ(only(R"("boxes": [[249, 249, 20, 20, 1, 0]])"), (Blob{1, 239, 239, 239, 239, {2'390}, {2'390}, 0, {}}));
  EXPECT_EQ(only(R"("boxes": [[0, 0, 1, 1, 0, 0]])"), (Blob{1, 0, 0, 0, 0, {0}, {0}, 0, {}}));
  EXPECT_EQ(only(R"("boxes": [[239, 239, 2, 2, 0, 0]])"), (Blob{1, 238, 238, 239, 239, {2'385}, {2'385}, 0, {}}));
}

TEST(GroveDecoder, ImpossibleBoxesCostTheirFrame) {
  for (const std::string box :
       {"[87, 83, 77, 65, 70]", "[87, 83, 77, 65, 70, 0, 1]", "[-1, 83, 77, 65, 70, 0]", "[87, 4096, 77, 65, 70, 0]",
        "[87, 83, 0, 65, 70, 0]", "[87, 83, 77, -65, 70, 0]", "[87, 83, 77, 65, 101, 0]", "[87, 83, 77, 65, 70, 255]",
        "[87.5, 83, 77, 65, 70, 0]", "[8700000000, 83, 77, 65, 70, 0]", "[87, 83, \"77\", 65, 70, 0]",
        "[300, 83, 20, 20, 70, 0]", "[250, 83, 20, 20, 70, 0]", "[83, 250, 20, 20, 70, 0]", "[87, 83, 77, 65, [70], 0]",
        "{\"x\": 87}", "87", "null", "[]"}) {
    Reading reading;
    reading.bytes(boxes(box));
    EXPECT_TRUE(reading.frames.empty()) << box;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << box;
    EXPECT_EQ(reading.messages, 1U) << "it answers";
    EXPECT_EQ(reading.bytes(boxes("[87, 83, 77, 65, 70, 0]")).frames.size(), 1U) << box;
  }
  for (const std::string size : {"[0, 240]", "[240]", "[240, 240, 3]", "[240, 4096]", "[240, \"240\"]"}) {
    EXPECT_TRUE(Reading().bytes(result("\"boxes\": [], \"resolution\": " + size)).frames.empty()) << size;
  }
}

TEST(GroveDecoder, WhatIsNoResultWithBoxesIsNoFrame) {
  for (const std::string data : {"\"count\": 1", "\"classes\": [[90, 1]]", "\"boxes\": 3", "\"boxes\": {}",
                                 "\"points\": [[[87, 83, 77, 65, 70, 0], [[1, 2, 3, 4]]]]"}) {
    Reading reading;
    EXPECT_TRUE(reading.bytes(result(data)).frames.empty()) << data;
    EXPECT_EQ(reading.decoder.counts().unused, 1U) << data;
  }
  for (const std::string other :
       {"\r{\"type\": 0, \"name\": \"INVOKE\", \"code\": 0, \"data\": {\"boxes\": []}}\n",
        "\r{\"type\": 1, \"name\": \"SAMPLE\", \"code\": 0, \"data\": {\"boxes\": []}}\n",
        "\r{\"type\": 1, \"name\": \"INVOKE\", \"code\": 4, \"data\": {\"boxes\": []}}\n",
        "\r{\"type\": 1, \"name\": \"INVOKE\", \"code\": 0, \"info\": {\"boxes\": []}}\n",
        "\r{\"type\": 2, \"name\": \"AT\", \"code\": 5, \"data\": \"Unknown \\\"command\\\"\"}\n"}) {
    Reading reading;
    EXPECT_TRUE(reading.bytes(other).frames.empty()) << other;
    EXPECT_EQ(reading.messages, 1U) << other;
  }
}

TEST(GroveDecoder, WhatIsNoJsonIsRefused) {
  for (const std::string bad :
       {"{\"type\"; 1}", "{type: 1}", "{\"type\": }", "{\"type\": 1]", "{\"type\": [1}}", "{\"type\": -}",
        "{\"type\": +1}", "{\"type\": 1,}", "{\"type\": 1 2}", "{,}", "{\"a\": 1} x", "{\"a\": Tr}",
        "{\"a\": [[[[[[1]]]]]]}", "{}", "{\"type\": 1}", "{\"a\": [,1]}", "{\"a\": 1..2}"}) {
    Reading reading;
    reading.bytes("\r" + bad + "\n");
    EXPECT_EQ(reading.messages, 0U) << bad;
    EXPECT_EQ(reading.decoder.counts().damaged, 1U) << bad;
  }
  Reading reading;
  EXPECT_EQ(reading.bytes("hello\n{\"type\": 1}\n\r \r\n").decoder.counts().damaged, 0U) << "not behind CR: no message";
}

TEST(GroveDecoder, TextsAreReadToTheirEnd) {
  EXPECT_EQ(Reading().bytes(result("\"image\": \"" + std::string(9'000, 'A') + "\\\\\", \"boxes\": []")).frames.size(),
            1U);
  EXPECT_EQ(Reading().bytes(result("\"boxes\\\"\": [], \"boxes_\": []")).frames.size(), 0U) << "another key";
  EXPECT_EQ(Reading().bytes(result("\"ok\": true, \"no\": null, \"boxes\": []")).frames.size(), 1U);
}

TEST(GroveDecoder, KeepsTheLargestAndCountsTheOthers) {
  std::string all;
  for (int i = 0; i < 20; ++i)
    all += (i > 0 ? ", [120, 120, " : "[120, 120, ") + std::to_string(20 + 10 * i) + ", 40, 70, 1]";
  Reading reading;
  reading.bytes(boxes(all));
  ASSERT_EQ(reading.frames.size(), 1U);
  ASSERT_EQ(reading.frames[0].blobs.size(), 16U);
  EXPECT_EQ(reading.frames[0].blobs[0], (Blob{2, 15, 100, 224, 139, {1'195}, {1'195}, 0, {}}));
  EXPECT_EQ(reading.frames[0].blobs[15].x1, 90) << "60 wide: the fifth";
  EXPECT_EQ(reading.decoder.counts().dropped, 4U);
}

struct Walking : test::Seen {
  void feed(std::uint8_t byte) {
    const Event event = decoder.feed(byte, {});
    right = event == Event::kFrame;
    if (event != Event::kNone) ++outputs;
    if (decoder.*revealed(test::GroveDepth{}) > 6) trouble = "deeper than it has room for";
    if (!right) return;
    if (!test::inside(decoder.frame(), kSide, kSide)) trouble = "a box outside of the picture";
    right = decoder.frame().blobs.size() == 1;
  }
  void rest() { feed('\n'); }
  [[nodiscard]] bool idle() const { return state() == 0; }
  // The uppermost of what is open decides what may close.
  void control(test::Key& key) const {
    const unsigned depth = decoder.*revealed(test::GroveDepth{});
    const unsigned arrays = decoder.*revealed(test::GroveArrays{});
    key.u8(state());
    if (state() == 0) return;
    key.u8(static_cast<std::uint8_t>(2 * depth + (arrays >> depth & 1U)));
    key.u8(test::boundary(decoder.*revealed(test::GroveTextSize{}), 10));
    key.u8(test::boundary(decoder.*revealed(test::GroveNumbers{}), 6));
  }
  [[nodiscard]] std::uint8_t state() const { return static_cast<std::uint8_t>(decoder.*revealed(test::GroveState{})); }

  Decoder decoder;
};

TEST(GroveDecoder, EachByteInEachState) {
  const std::string box = "[87, 83, 77, 65, 70, 0]";
  std::string crowd = box;
  for (int i = 0; i < 16; ++i) crowd += ", " + box;
  test::Plan plan;
  plan.good = test::text("\n" + boxes(box));
  plan.way_back = 2 * plan.good.size();
  plan.shortest = 20;
  plan.samples = {{plan.good},
                  {test::text(boxes(crowd))},
                  {test::text(result("\"count\": 999999999, \"boxes\": []"))},
                  {test::text(result("\"points\": [[[1, 2.5], [[1]]]]"))},
                  {test::text(result("\"boxes\": [], \"resolution\": [640, 480]"))},
                  {test::text("\r{\"a\": [[[[[[1]]]]]]}\n"), 0}};
  const test::Walked walked = test::walk(Walking{}, plan);
  EXPECT_EQ(walked.trouble, "");
  EXPECT_GT(walked.states, 500U);
}

TEST(GroveSession, StartsItUntilFramesCome) {
  fake::ScriptedLink<1'024> link({});
  Camera<fake::ScriptedLink<1'024>> driver(link);
  for (std::int64_t ms = 0; ms < 1'590; ms += 10) EXPECT_FALSE(driver.poll({ms * 10}).ok());
  const std::string once = "AT+BREAK\r\nAT+INVOKE=-1,0,1\r\n";
  EXPECT_EQ(std::string(link.written().begin(), link.written().end()), once + once);
  EXPECT_EQ(driver.link(), LinkState::kSilent);
}

TEST(GroveSession, WaitsForItsModel) {
  Session session;
  const auto hear = [&](const std::string& text, std::int64_t t) {
    for (const char c : text) (void)session.take(test::octet(c), {t});
  };
  const auto said = [&](std::int64_t t) { return test::says(session, t); };
  EXPECT_TRUE(said(0));
  EXPECT_FALSE(said(7'999));
  EXPECT_TRUE(said(8'000));
  hear("\r{\"type\": 0, \"name\": \"INVOKE\", \"code\": 0, \"data\": {}}\n", 9'000);
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_FALSE(said(38'999)) << "it loads a model";
  EXPECT_TRUE(said(39'000));
  EXPECT_EQ(session.link(), LinkState::kSilent);
  hear(boxes(""), 40'000);
  EXPECT_EQ(session.link(), LinkState::kEmpty);
  hear(boxes("[87, 83, 77, 65, 70, 0]"), 41'000);
  EXPECT_EQ(session.link(), LinkState::kOk);
  EXPECT_FALSE(said(48'999));
  EXPECT_TRUE(said(49'000));
  hear("\r{\"type\": 1, \"na", 49'100);
  session.link_lost();
  hear("me\": \"INVOKE\", \"code\": 0, \"data\": {\"boxes\": []}}\n", 49'200);
  EXPECT_EQ(session.link(), LinkState::kSilent) << "half a message from before";
  EXPECT_TRUE(said(49'201)) << "at once";
}

TEST(GroveCamera, SeesOverI2cWhatItSeesOverSerial) {
  const sensor::Blob box{3, 40, 50, 81, 79, {605}, {645}, 0, {}};
  sensor::BlobFrame scene;
  (void)scene.blobs.push_back(box);
  fake::SteppedClock clock;
  emulate::Grove camera;
  emulate::GroveOnI2c wires(camera);
  test::I2cCable bus(wires, clock);
  I2cCamera<test::I2cCable> driver(bus);
  std::size_t frames = 0;
  for (int ms = 0; ms < 4'000; ++ms) {
    clock.advance(base::milliseconds(1));
    if (ms % 66 == 0) wires.say(camera.see(scene, clock.now()));
    const auto frame = driver.poll(clock.now());
    if (!frame) continue;
    ++frames;
    ASSERT_EQ(frame->blobs.size(), 1U);
    EXPECT_EQ(frame->blobs[0], box);
  }
  EXPECT_GT(frames, 28U) << "of two and a half seconds at 15 /s";
  EXPECT_EQ(driver.link(), LinkState::kOk);
  EXPECT_EQ(bus.longest_read(), 32U);
  bus.unplug();
  EXPECT_FALSE(driver.poll(clock.now() + base::milliseconds(20)).ok());
  EXPECT_EQ(driver.link(), LinkState::kAbsent);
}

// A camera that starts does not acknowledge, and a bus without pull-ups reads ones.
TEST(GroveCamera, OnI2cWhatIsNotThereIsSilent) {
  struct Ones final : emulate::I2cDevice {
    std::optional<std::vector<std::uint8_t>> transfer(std::uint8_t /*address*/,
                                                      const std::vector<std::uint8_t>& /*out*/, std::size_t expected,
                                                      base::Time /*now*/) override {
      if (refuses) return std::nullopt;
      return std::vector<std::uint8_t>(expected, 0xFF);
    }
    bool refuses = true;
  } ones;
  fake::SteppedClock clock;
  test::I2cCable bus(ones, clock);
  I2cCamera<test::I2cCable> driver(bus);
  for (int ms = 0; ms < 2'000; ++ms) {
    ones.refuses = ms < 1'000;
    clock.advance(base::milliseconds(1));
    EXPECT_FALSE(driver.poll(clock.now()).ok());
  }
  EXPECT_EQ(driver.link(), LinkState::kSilent);
  EXPECT_LT(bus.transfers(), 700U) << "with rests between";
}

}  // namespace
}  // namespace fencepost::grove
