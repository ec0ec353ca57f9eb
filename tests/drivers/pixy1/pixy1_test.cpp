#include "drivers/pixy1/pixy1.hpp"

#include <gtest/gtest.h>

#include "drivers/wire/i2c_stream.hpp"
#include "tests/drivers/bench/i2c_cable.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/drivers/pixy1/rig.hpp"

namespace fencepost::pixy1 {
namespace {

using base::milliseconds;
using base::Time;
using sensor::LinkState;
using test::hex;
using Bytes = std::vector<std::uint8_t>;

const Bytes kIdle = hex("00 00");
const Bytes kMark = hex("55 AA");
// 331 = 1 + 160 + 100 + 40 + 30.
const Bytes kOne = hex("55 AA 4B 01 01 00 A0 00 64 00 28 00 1E 00");
// 134 = 2 + 50 + 60 + 12 + 10.
const Bytes kTwo = hex("55 AA 86 00 02 00 32 00 3C 00 0C 00 0A 00");
// 0x0145 = 10 + 200 + 80 + 60 + 20 + 0xFFD3: a colour code 1-2, turned by -45 degrees.
const Bytes kCode = hex("56 AA 45 01 0A 00 C8 00 50 00 3C 00 14 00 D3 FF");

// 40 columns from 140 on; rows 85 to 115, the last one included.
const sensor::Blob kOneBlob{1, 140, 85, 179, 115, {1'595}, {1'000}, 0, {}};
const sensor::Blob kTwoBlob{2, 44, 55, 55, 65, {495}, {600}, 0, {}};        // 12 columns, rows 55 to 65
const sensor::Blob kCodeBlob{10, 170, 70, 229, 90, {1'995}, {800}, 0, {}};  // 60 columns, rows 70 to 90

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A session on a clock, a byte every half millisecond, as at 19200 baud.
struct Listener {
  Session session{Options{}};
  Time now{};

  std::vector<sensor::BlobFrame> hears(const Bytes& bytes) {
    std::vector<sensor::BlobFrame> frames;
    for (const std::uint8_t byte : bytes) {
      now = now + base::Duration{5};
      session.step(now);
      if (session.take(byte, now)) frames.push_back(session.sample());
    }
    return frames;
  }
  void wait(std::int64_t ms) {
    now = now + milliseconds(ms);
    session.step(now);
  }
};

std::vector<sensor::Blob> blobs_of(const sensor::BlobFrame& frame) { return {frame.blobs.begin(), frame.blobs.end()}; }

struct Pixy1Test : testing::Test {
  Listener listener;
};

TEST_F(Pixy1Test, BringsTheDocumentsExampleToOurPixels) {
  EXPECT_TRUE(listener.hears(kMark + kOne + kTwo).empty()) << "more blocks may follow";
  const auto frames = listener.hears(kIdle);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(blobs_of(frames[0]), (std::vector{kOneBlob, kTwoBlob}));
  EXPECT_EQ(frames[0].t, Time{} + base::Duration{5}) << "the first byte of its mark";
  EXPECT_EQ(listener.session.link(), LinkState::kOk);
}

TEST_F(Pixy1Test, TheNextImagesMarkEndsOneToo) {
  const auto frames = listener.hears(kMark + kOne + kMark + kTwo + kMark + kCode + kIdle);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(blobs_of(frames[0]), (std::vector{kOneBlob}));
  EXPECT_EQ(blobs_of(frames[1]), (std::vector{kTwoBlob}));
  EXPECT_EQ(blobs_of(frames[2]), (std::vector{kCodeBlob}));
  EXPECT_EQ(frames[2].frame, 2U);
}

TEST_F(Pixy1Test, AColourCodesSignatureIsItsOctalNumber) {
  const auto frames = listener.hears(kMark + kOne + kCode + kIdle);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(blobs_of(frames[0]), (std::vector{kCodeBlob, kOneBlob})) << "60 x 21 is larger than 40 x 31";
  // 01111 octal is 585: above 255. The sum is 585 + 200 + 80 + 60 + 20 = 945.
  const auto beyond = listener.hears(kMark + hex("56 AA B1 03 49 02 C8 00 50 00 3C 00 14 00 00 00") + kIdle);
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_TRUE(beyond[0].blobs.empty());
  EXPECT_EQ(listener.session.dropped(), 1U);
}

TEST_F(Pixy1Test, BoxesAtTheEdges) {
  const auto box = [](const char* text) { return blob_of(hex(text)); };
  // 320 x 199 around (160, 99): the whole image.
  EXPECT_EQ(box("55 AA 00 00 01 00 A0 00 63 00 40 01 C7 00"), (sensor::Blob{1, 0, 0, 319, 199, {1'595}, {995}, 0, {}}));
  // One column, one row: the height is 0.
  EXPECT_EQ(box("55 AA 00 00 07 00 0A 00 05 00 01 00 00 00"), (sensor::Blob{7, 10, 5, 10, 5, {100}, {50}, 0, {}}));
  for (const char* wrong : {"55 AA 00 00 00 00 A0 00 63 00 28 00 1E 00", "55 AA 00 00 01 00 A0 00 63 00 00 00 1E 00",
                            "55 AA 00 00 01 00 05 00 63 00 28 00 1E 00", "55 AA 00 00 01 00 3C 01 63 00 28 00 1E 00",
                            "55 AA 00 00 01 00 A0 00 05 00 28 00 1E 00"}) {
    EXPECT_EQ(box(wrong), std::nullopt) << wrong;
  }
}

// 40 columns, 30 rows and the last one: 0 to 39 and 280 to 319, 0 to 30 and 169 to 199.
TEST_F(Pixy1Test, BoxesThatTouchTheEdgesAreInside) {
  const auto box = [](unsigned signature, unsigned x, unsigned y) {
    Bytes block = hex("55 AA 00 00 01 00 00 00 00 00 28 00 1E 00");
    for (const auto& [at, word] : {std::pair(std::size_t{4}, signature), {std::size_t{6}, x}, {std::size_t{8}, y}}) {
      block[at] = static_cast<std::uint8_t>(word & 0xFFU);
      block[at + 1] = static_cast<std::uint8_t>(word >> 8U);
    }
    return blob_of(block);
  };
  EXPECT_EQ(box(1, 20, 100)->x1, 0);
  EXPECT_FALSE(box(1, 19, 100));
  EXPECT_EQ(box(1, 300, 100)->x2, 319);
  EXPECT_FALSE(box(1, 301, 100));
  EXPECT_EQ(box(1, 100, 15)->y1, 0);
  EXPECT_FALSE(box(1, 100, 14));
  EXPECT_EQ(box(1, 100, 184)->y2, 199);
  EXPECT_EQ(box(1, 100, 185)->y2, 199) << "cut, as others that speak so have more rows";
  EXPECT_EQ(box(1, 100, 214)->y1, 199);
  EXPECT_FALSE(box(1, 100, 215));
  EXPECT_EQ(box(255, 100, 100)->signature, 255);
  EXPECT_FALSE(box(256, 100, 100));
  EXPECT_FALSE(box(0, 100, 100));
}

// A block with another signature, its sum right.
Bytes block_of(const Bytes& block, unsigned signature) {
  Bytes bytes = block;
  const unsigned before = bytes[4] | static_cast<unsigned>(bytes[5]) << 8U;
  const unsigned sum = (bytes[2] | static_cast<unsigned>(bytes[3]) << 8U) - before + signature;
  bytes[2] = static_cast<std::uint8_t>(sum & 0xFFU);
  bytes[3] = static_cast<std::uint8_t>(sum >> 8U & 0xFFU);
  bytes[4] = static_cast<std::uint8_t>(signature & 0xFFU);
  bytes[5] = static_cast<std::uint8_t>(signature >> 8U);
  return bytes;
}

// OpenMV's emulation of a Pixy sorts by area. What a camera never sends is one thing twice.
TEST_F(Pixy1Test, BlocksComeInAnyOrderAndEachThingOnce) {
  const auto images = [](const Bytes& blocks) { return Listener().hears(kMark + blocks + kIdle).size(); };
  EXPECT_EQ(images(block_of(kOne, 7) + block_of(kTwo, 7)), 1U);
  EXPECT_EQ(images(block_of(kOne, 7) + block_of(kTwo, 6)), 1U);
  EXPECT_EQ(images(kCode + block_of(kTwo, 7)), 1U);
  EXPECT_EQ(images(kOne + kOne), 0U) << "a mark was lost between them";
  EXPECT_EQ(images(kTwo + kOne + kTwo), 0U);
}

TEST_F(Pixy1Test, AColourCodeAbove255IsCounted) {
  for (const auto& [signature, given] : {std::pair(255U, 1U), {256U, 0U}, {257U, 0U}}) {
    Listener fresh;
    const auto frames = fresh.hears(kMark + block_of(kCode, signature) + kIdle);
    ASSERT_EQ(frames.size(), 1U) << signature;
    EXPECT_EQ(frames[0].blobs.size(), given) << signature;
    EXPECT_EQ(fresh.session.dropped(), 1U - given) << signature;
  }
  EXPECT_EQ(Listener().hears(kMark + block_of(kOne, 256) + kIdle).size(), 0U) << "no block has it";
}

TEST_F(Pixy1Test, AnImageThatEndsInSilenceIsNone) {
  EXPECT_TRUE(listener.hears(kMark + kOne).empty());
  listener.wait(501);
  EXPECT_TRUE(listener.hears(kIdle).empty());
  EXPECT_EQ(listener.session.counts().broken, 0U);
  EXPECT_EQ(listener.hears(kMark + kTwo + kIdle).size(), 1U);
}

// Half a second, to the tenth of a millisecond.
TEST_F(Pixy1Test, WaitsHalfASecond) {
  Session session{Options{}};
  Time now{};
  const auto hear = [&](const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) (void)session.take(byte, now);
  };
  hear(kMark + kOne + kIdle);
  session.step(now + milliseconds(500));
  EXPECT_EQ(session.link(), LinkState::kOk);
  now = now + milliseconds(500);
  hear(hex("00"));
  session.step(now + base::Duration{1});
  EXPECT_EQ(session.link(), LinkState::kUnready) << "bytes, but no image";
  session.step(now + milliseconds(500));
  EXPECT_EQ(session.link(), LinkState::kUnready);
  session.step(now + milliseconds(500) + base::Duration{1});
  EXPECT_EQ(session.link(), LinkState::kSilent);
}

TEST_F(Pixy1Test, AnImageWhoseMarkWasLostIsNotAddedToTheOneBefore) {
  const auto frames = listener.hears(kMark + kOne + kTwo + kOne + kTwo + kMark + kOne + kIdle);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(blobs_of(frames[0]), (std::vector{kOneBlob}));
  EXPECT_EQ(listener.session.counts().broken, 1U);
}

// 0xAA55 = 1 + 160 + 100 + 40 + 43220: no camera sends that height, but the words of a block may be any.
TEST_F(Pixy1Test, ASumThatLooksLikeAMarkCostsItsImage) {
  const auto frames = listener.hears(kMark + hex("55 AA 55 AA 01 00 A0 00 64 00 28 00 28 A9") + kMark + kOne + kIdle);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(blobs_of(frames[0]), (std::vector{kOneBlob}));
}

TEST_F(Pixy1Test, MoreBlocksThanAFrameHoldsAreCounted) {
  Bytes image = kMark;
  for (std::uint8_t width = 2; width <= 40; width = static_cast<std::uint8_t>(width + 2)) {
    Bytes block = hex("55 AA 00 00 01 00 A0 00 64 00 00 00 1E 00");
    const auto signature = static_cast<std::uint8_t>(width / 2);
    const unsigned sum = signature + 160U + 100U + width + 30U;
    block[2] = static_cast<std::uint8_t>(sum & 0xFFU);
    block[3] = static_cast<std::uint8_t>(sum >> 8U);
    block[4] = signature;
    block[10] = width;
    image = image + block;
  }
  const auto frames = listener.hears(image + kMark + kOne + kIdle);
  ASSERT_EQ(frames.size(), 2U);
  ASSERT_EQ(frames[0].blobs.size(), 16U);
  EXPECT_EQ(frames[0].blobs[0], (sensor::Blob{20, 140, 85, 179, 115, {1'595}, {1'000}, 0, {}}));
  EXPECT_EQ(frames[0].blobs[15].x2 - frames[0].blobs[15].x1 + 1, 10);
  EXPECT_EQ(listener.session.dropped(), 4U);
  EXPECT_EQ(blobs_of(frames[1]), (std::vector{kOneBlob}));
}

// A UART's two zeros with each image, 20 ms apart: the fourth in a row says that there is nothing.
TEST_F(Pixy1Test, ZerosAloneAreAnImageWithoutBlocks) {
  ASSERT_EQ(listener.hears(kMark + kOne + kIdle).size(), 1U);
  std::vector<std::size_t> frames;
  for (int image = 0; image < 7; ++image) {
    listener.wait(19);
    const auto got = listener.hears(kIdle);
    frames.push_back(got.size());
    for (const auto& frame : got) EXPECT_TRUE(frame.blobs.empty());
  }
  EXPECT_EQ(frames, (std::vector<std::size_t>{0, 0, 1, 0, 0, 1, 0}));
  EXPECT_EQ(listener.session.link(), LinkState::kEmpty);
}

using Bench = test::Bench<test::Pixy1Rig>;
const sensor::Blob kNear{1, 100, 60, 219, 159, {1'595}, {1'095}, 0, {}};
const sensor::Blob kFar{2, 10, 20, 29, 39, {195}, {295}, 0, {}};

/// On the two-wire bus: what there is of the image is read in portions, and zeros where there is nothing.
class OnTwoWires final : public emulate::I2cDevice {
 public:
  explicit OnTwoWires(emulate::Pixy1& camera) : camera_(camera) {}
  std::optional<Bytes> transfer(std::uint8_t address, const Bytes& /*out*/, std::size_t expected, Time now) override {
    if (address != kAddress) return std::nullopt;
    return camera_.pull(expected, now);
  }

 private:
  emulate::Pixy1& camera_;
};

TEST(Pixy1Camera, SeesOverI2cWhatItSeesOverSerial) {
  fake::SteppedClock clock;
  emulate::Pixy1 camera(0);
  OnTwoWires wires(camera);
  test::I2cCable bus(wires, clock);
  wire::I2cStream<test::I2cCable> stream(bus, kAddress);
  Camera<wire::I2cStream<test::I2cCable>> driver(stream);
  camera.show({kNear, kFar});
  std::size_t frames = 0;
  for (int ms = 0; ms < 3'000; ++ms) {
    clock.advance(milliseconds(1));
    const auto frame = driver.poll(clock.now());
    if (!frame || ms < 1'050) continue;
    ++frames;
    EXPECT_EQ(blobs_of(*frame), (std::vector{kNear, kFar})) << ms;
  }
  EXPECT_GE(frames, 95U) << "of two seconds";
  EXPECT_LE(bus.longest_read(), 16U);
  camera.show({});
  for (int ms = 0; ms < 200; ++ms) {
    clock.advance(milliseconds(1));
    static_cast<void>(driver.poll(clock.now()));
  }
  EXPECT_EQ(driver.link(), LinkState::kEmpty);
}

}  // namespace
}  // namespace fencepost::pixy1
