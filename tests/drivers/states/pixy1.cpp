// Pixy on a serial line, whose images follow each other without a length, and on USB.
#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy1/usb.hpp"
#include "drivers/wire/endian.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/drivers/states/reveal.hpp"
#include "tests/drivers/states/scanned.hpp"
#include "tests/drivers/states/walks.hpp"

namespace fencepost::test {
FENCEPOST_REVEAL(Pixy1Scanner, &pixy1::Session::scanner_);
FENCEPOST_REVEAL(Pixy1Images, &pixy1::Session::images_);
FENCEPOST_REVEAL(Pixy1Building, &pixy1::Images::building_);
FENCEPOST_REVEAL(Pixy1Damaged, &pixy1::Images::damaged_);
FENCEPOST_REVEAL(Pixy1Given, &pixy1::Images::given_);
FENCEPOST_REVEAL(Pixy1Any, &pixy1::Images::any_);
FENCEPOST_REVEAL(Pixy1Last, &pixy1::Images::last_);
FENCEPOST_REVEAL(Pixy1UsbScanner, &pixy1::UsbSession::scanner_);
FENCEPOST_REVEAL(Pixy1Phase, &pixy1::UsbSession::phase_);
FENCEPOST_REVEAL(Pixy1MessageAt, &pixy1::UsbSession::message_at_);
FENCEPOST_REVEAL(Pixy1FrameAt, &pixy1::UsbSession::frame_at_);

namespace {

// Signature 1, 40 x 30 around (160, 100).
const Bytes kPixy1Block = hex("55 AA 4B 01 01 00 A0 00 64 00 28 00 1E 00");
constexpr std::int16_t kPixy1Left = 140;  // its first column

struct Pixy1Seen : Seen {
  void judge(const sensor::BlobFrame& frame) {
    ++outputs;
    if (!inside(frame, pixy1::kWidth, pixy1::kHeight)) trouble = "a box outside of the image";
    right = frame.blobs.size() == 1 && frame.blobs[0].x1 == kPixy1Left;
  }
};

struct Pixy1Stream : Pixy1Seen {
  // Two bytes of zeros are long enough for an image without blocks.
  static constexpr base::Duration kByte = base::milliseconds(30);

  void feed(std::uint8_t byte) {
    now = now + kByte;
    right = session.take(byte, now);
    if (right) judge(session.sample());
  }
  void rest() { session.step(now + base::milliseconds(501)); }
  [[nodiscard]] bool idle() const {
    return message().empty() && session.link() == sensor::LinkState::kSilent && !(images().*revealed(Pixy1Building{}));
  }
  void control(Key& key) const {
    const pixy1::Images& all = images();
    const bool building = all.*revealed(Pixy1Building{});
    const bool damaged = all.*revealed(Pixy1Damaged{});
    key.u8(static_cast<std::uint8_t>(2 * building + damaged));
    key.u8(all.*revealed(Pixy1Given{}));
    const auto& last = all.*revealed(Pixy1Last{});
    if (building && !damaged) {
      key.u8(all.*revealed(Pixy1Any{}));
      key.u8(static_cast<std::uint8_t>(all.frame().blobs.size()));
    } else if (!building) {
      key.u8(last ? static_cast<std::uint8_t>(std::min<std::int64_t>((now - *last).raw / kByte.raw, 2)) : 3);
    }
    const View bytes = message();
    key.u8(static_cast<std::uint8_t>(bytes.size()));
    if (!bytes.empty()) key.u8(bytes[0]);
    if (bytes.size() == 3) key.u8(bytes[2] == 0x55 || bytes[2] == 0x56);
    // Whether the last byte can complete it.
    if (bytes.size() > 4 && bytes.size() + 1 == (bytes[0] == 0x55 ? pixy1::kBlock : pixy1::kColourCode)) {
      unsigned low = bytes[2];
      for (std::size_t at = 4; at < bytes.size(); at += 2) low -= bytes[at];
      key.u8(low % 256 == 0);
    }
  }
  [[nodiscard]] const pixy1::Images& images() const { return session.*revealed(Pixy1Images{}); }
  [[nodiscard]] View message() const { return (session.*revealed(Pixy1Scanner{})).pending(); }

  pixy1::Session session{{}};
  base::Time now{};
};

Walked walk_pixy1() {
  const Bytes mark = hex("55 AA");
  const Bytes end(2, 0);
  Plan plan;
  plan.good = Bytes(17, 0) + mark + kPixy1Block + Bytes(3, 0);
  plan.way_back = 2 * plan.good.size();
  plan.shortest = pixy1::kWord;
  const Bytes code = sealed(hex("56 AA 00 00 0A 00 A0 00 64 00 28 00 1E 00 2D 00"), seal_pixy1);
  const Bytes other_code = sealed(hex("56 AA 00 00 01 01 A0 00 64 00 28 00 1E 00 2D 00"), seal_pixy1);
  const Bytes last = sealed(hex("55 AA 00 00 07 00 A0 00 64 00 28 00 1E 00"), seal_pixy1);
  Bytes others;  // of 17 signatures: one more than a frame holds
  for (std::uint8_t signature = 1; signature <= 17; ++signature) {
    Bytes block = kPixy1Block;
    block[4] = signature;
    others = others + sealed(block, seal_pixy1);
  }
  plan.samples = {{mark + kPixy1Block + end},
                  {mark + others + end},
                  {mark + repeated(kPixy1Block, 2) + end, 0},
                  {kPixy1Block, 0},
                  {last, 0},
                  {code, 0},
                  {other_code, 0},
                  {mark + kPixy1Block + last + code + other_code + end},
                  {mark + last + kPixy1Block + end},
                  {mark + end, 0},
                  {end + end, 1}};
  return walk(Pixy1Stream{}, plan);
}

struct Pixy1Pushes : Pixy1Seen {
  static constexpr std::size_t kMax = pixy1::kLongestMessage - chirp::kHeader;

  Pixy1Pushes() { session.step(now); }
  void feed(std::uint8_t byte) {
    now = now + base::milliseconds(1);
    right = session.take(byte, now);
    if (right) judge(session.sample());
  }
  void rest() { session.link_lost(); }
  [[nodiscard]] bool idle() const {
    return message().empty() && session.link() == sensor::LinkState::kSilent && phase() == 0;
  }
  void control(Key& key) const {
    key.u8(phase());
    key.u8(static_cast<std::uint8_t>(session.link()));
    key.u16(static_cast<std::uint16_t>(message().size()));
    if (message().size() > 4) key.u8(kind());
    key.u32(length());
  }
  // A long message is followed to its end in one phase, and where its bytes are a sample's.
  [[nodiscard]] bool followed(bool in_sample) const {
    if (message().size() < chirp::kHeader || length() <= 6 || length() == 44) return true;
    const bool long_one = message().size() > 256;
    return in_sample && (!long_one || (phase() == 0 && session.link() == sensor::LinkState::kSilent));
  }
  [[nodiscard]] std::uint8_t kind() const {
    const std::uint8_t type = message()[4];
    return type == 0x18 ? 1 : type == 0x60 ? 2 : type == 0x61 ? 3 : 0;
  }
  // Of its bytes that are there; the others are zero.
  [[nodiscard]] std::uint32_t length() const {
    std::uint32_t length = 0;
    for (std::size_t at = std::min(message().size(), chirp::kHeader); at > chirp::kHeader - 4; --at) {
      length = 256 * length + message()[at - 1];
    }
    return length <= 6 || length == 44 || length == kMax % 256 || length == kMax ? length : 7;
  }
  [[nodiscard]] std::uint8_t phase() const { return static_cast<std::uint8_t>(session.*revealed(Pixy1Phase{})); }
  [[nodiscard]] View message() const { return (session.*revealed(Pixy1UsbScanner{})).pending(); }

  pixy1::UsbSession session{{}};
  base::Time now{};
};

Bytes pushed(std::size_t blocks) {
  const auto words = static_cast<std::uint8_t>(5 * blocks);
  const auto size = static_cast<std::uint8_t>(24 + 2 * words);
  return hex("55 55 AA AA 18 00 00 00") + Bytes{size, 0, 0, 0} +
         hex("64 64 64 64 43 43 42 31 41 01 42 42 40 01 42 42 C8 00 82 82") + Bytes{words, 0, 0, 0} +
         repeated(hex("01 00 8C 00 B4 00 55 00 73 00"), blocks);
}

Walked walk_pixy1_usb() {
  Plan plan;
  plan.good = pushed(1);
  plan.way_back = pixy1::kLongestMessage + 2 * plan.good.size();
  plan.shortest = plan.good.size() - 10;
  const auto filler = [](std::size_t length) {
    return hex("55 55 AA AA 40 00 00 00") +
           Bytes{static_cast<std::uint8_t>(length % 256), static_cast<std::uint8_t>(length / 256), 0, 0} +
           Bytes(length, 1);
  };
  plan.samples = {
      {pushed(0)},
      {pushed(1)},
      {pushed(17)},
      {hex("55 55 AA AA 18 00 00 00 2C 00 00 00 64 64 64 64 43 43 42 32 41 01 42 42 40 01 42 42 C8 00 82 82 "
           "00 00 00 00 82 82 82 82 06 00 00 00 0A 00 AA 00 E6 00 46 00 5A 00 D3 FF")},
      {hex("55 55 AA AA 61 00 00 00 06 00 00 00 00 00 00 00 01 01"), 0},
      {hex("55 55 AA AA 60 00 00 00 04 00 00 00 05 00 00 00"), 0},
      {filler(Pixy1Pushes::kMax), 0},
      {filler(Pixy1Pushes::kMax + 1), 0}};
  return walk(Pixy1Pushes{}, plan);
}

const RegisteredWalk kPixy1[] = {{"pixy1", "stream", walk_pixy1}, {"pixy1", "usb", walk_pixy1_usb}};

}  // namespace
}  // namespace fencepost::test
