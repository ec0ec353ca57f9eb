// Cameras that speak in lines: the CMUcams, JeVois, XBC; and the Cognachrome.
#include "drivers/cmucam/decoder.hpp"
#include "drivers/cmucam/measure.hpp"
#include "drivers/cognachrome/decoder.hpp"
#include "drivers/jevois/decoder.hpp"
#include "drivers/xbc/decoder.hpp"
#include "tests/drivers/states/reveal.hpp"
#include "tests/drivers/states/scanned.hpp"
#include "tests/drivers/states/walks.hpp"

namespace fencepost::test {
FENCEPOST_REVEAL(CmucamMode, &cmucam::Decoder::mode_);
FENCEPOST_REVEAL(CmucamFresh, &cmucam::Decoder::fresh_);
FENCEPOST_REVEAL(CmucamSize, &cmucam::Decoder::size_);
FENCEPOST_REVEAL(CmucamWanted, &cmucam::Decoder::wanted_);
FENCEPOST_REVEAL(JevoisSize, &jevois::Decoder::size_);
FENCEPOST_REVEAL(JevoisTooLong, &jevois::Decoder::too_long_);
FENCEPOST_REVEAL(JevoisBuilding, &jevois::Decoder::building_);
FENCEPOST_REVEAL(JevoisStamp, &jevois::Decoder::stamp_);
FENCEPOST_REVEAL(JevoisAsTold, &jevois::Decoder::as_told_);
FENCEPOST_REVEAL(JevoisNext, &jevois::Decoder::next_);
FENCEPOST_REVEAL(XbcSize, &xbc::Decoder::size_);
FENCEPOST_REVEAL(XbcInLine, &xbc::Decoder::in_line_);
FENCEPOST_REVEAL(XbcBuilding, &xbc::Decoder::building_);
FENCEPOST_REVEAL(XbcAnnounced, &xbc::Decoder::announced_);
FENCEPOST_REVEAL(XbcReceived, &xbc::Decoder::received_);
FENCEPOST_REVEAL(XbcNext, &xbc::Decoder::next_);
FENCEPOST_REVEAL(CognachromeState, &cognachrome::Decoder::state_);
FENCEPOST_REVEAL(CognachromeGiven, &cognachrome::Decoder::given_);
FENCEPOST_REVEAL(CognachromeChannel, &cognachrome::Decoder::channel_);
FENCEPOST_REVEAL(CognachromeField, &cognachrome::Decoder::field_);
FENCEPOST_REVEAL(CognachromeBytes, &cognachrome::Decoder::bytes_);

namespace {

struct CmuCam : Seen {
  static constexpr std::size_t kLine = 63;

  void feed(std::uint8_t byte) {
    ++now.raw;
    const cmucam::Event event = decoder.feed(byte, now);
    right = event == cmucam::Event::kPacket && decoder.packet().letter == 'C' && decoder.packet().fields[5] == 0x40;
    if (event != cmucam::Event::kNone) ++outputs;
    if (decoder.text().size() > kLine) trouble = "a line beyond its buffer";
    if (decoder.packet().count > cmucam::Packet::kMaxFields) trouble = "fields beyond their number";
    if (event == cmucam::Event::kPacket) check();
  }
  void check() {
    using namespace cmucam;
    if (decoder.packet().t > now) trouble = "a packet of the future";
    for (const Dialect* dialect :
         {&kCmuCam1, &kCmuCam2, &kCmuCam2High, &kCmuCam2Ov7620, &kCmuCam3, &kCmuCam3High, &kCmuCam4}) {
      const auto blob = to_blob(decoder.packet(), *dialect, 1);
      if (blob && !inside(*blob, dialect->width, dialect->height)) trouble = "a box outside of the image";
    }
  }
  void rest() {
    for (const char byte : {'\r', '\r', ':'}) feed(static_cast<std::uint8_t>(byte));
    // The rest of a raw packet takes any byte.
    for (int i = 0; i < 9 && !idle(); ++i) feed('\r');
  }
  [[nodiscard]] bool idle() const { return mode() == 0 && decoder.*revealed(CmucamFresh{}); }
  void control(Key& key) const {
    key.u8(mode());
    key.u8(decoder.*revealed(CmucamFresh{}));
    const bool raw = mode() > 1;
    key.u8(raw ? decoder.*revealed(CmucamWanted{}) : boundary(decoder.*revealed(CmucamSize{}), kLine));
    key.u8(raw ? decoder.packet().count : 0);
  }
  [[nodiscard]] std::uint8_t mode() const { return static_cast<std::uint8_t>(decoder.*revealed(CmucamMode{})); }

  cmucam::Decoder decoder;
  base::Time now{};
};

Walked walk_cmucam() {
  Plan plan;
  plan.good = text(
      "\r\r\xFF"
      "C\1\1\2\2\1\x40");
  plan.way_back = 2 * plan.good.size();
  const auto raw = [](char letter, std::size_t fields) {
    return Bytes{0xFF, static_cast<std::uint8_t>(letter)} + Bytes(fields, 2);
  };
  plan.samples = {{plan.good},
                  {raw('M', 8)},
                  {raw('T', 8)},
                  {raw('N', 9)},
                  {raw('S', 6)},
                  {raw('X', 6), 0},
                  {text("ACK\r:"), 2},
                  {text("NCK\r:"), 2},
                  {text("ERR: Camera Timeout Error\r")},
                  {text("DAT: \r")},
                  {text("CMUcam2 v1.0 c6\r")},
                  {text("T 45 71 40 60 50 80 255 256\r")},
                  {text("T 45 71 40 60 50 80 255 255\r")},
                  {text("S 100 100 100 100 100 100 100 100 100 100 100 100\r")},
                  {text("S 1 1 1 1 1 1 1 1 1 1 1 1 1\r")},
                  {Bytes(62, 'v') + Bytes{'\r'}},
                  {Bytes(63, 'v') + Bytes{'\r'}},
                  {Bytes(64, 'v') + Bytes{'\r'}, 0}};
  return walk(CmuCam{}, plan);
}

struct JeVois : Seen {
  static constexpr std::size_t kLine = 192;

  void feed(std::uint8_t byte) {
    const jevois::Event event = decoder.feed(byte, {});
    right = event == jevois::Event::kFrame;
    if (size() > kLine) trouble = "a line beyond its buffer";
    if (!right) return;
    ++outputs;
    if (!inside(decoder.frame(), jevois::kWidth, jevois::kHeight)) trouble = "a box outside of the image";
    right = decoder.frame().blobs.size() == 1 && decoder.frame().blobs[0].signature == 2;
  }
  void rest() { feed('\n'); }
  [[nodiscard]] bool idle() const { return size() == 0 && !(decoder.*revealed(JevoisTooLong{})); }
  void control(Key& key) const {
    key.u8(boundary(size(), kLine));
    key.u8(decoder.*revealed(JevoisTooLong{}));
    const bool building = decoder.*revealed(JevoisBuilding{});
    key.u8(building);
    if (!building) return;
    key.u8((decoder.*revealed(JevoisStamp{})).has_value());
    key.u8(decoder.*revealed(JevoisAsTold{}));
    key.u8(boundary((decoder.*revealed(JevoisNext{})).blobs.size(), sensor::kMaxBlobs));
  }
  [[nodiscard]] std::size_t size() const { return decoder.*revealed(JevoisSize{}); }

  jevois::Decoder decoder{jevois::Names{}};
};

Walked walk_jevois() {
  Plan plan;
  const std::string_view good = "\nMARK START\r\nN2 blob2 250 -188 400 300\r\nMARK STOP\r\n";
  const Bytes start = text("MARK START\n");
  const Bytes stop = text("MARK STOP\n");
  const Bytes box = text("N2 a 0 0 9 9\n");
  const auto polygon = [](std::size_t numbers, std::size_t size, std::string_view head = "F2 a") {
    Bytes line = text(head);
    for (std::size_t i = 0; i < numbers; ++i) line = line + text(i % 4 < 2 ? " 1" : " 9");
    line.resize(std::max(line.size(), size), ' ');
    return line + Bytes{'\n'};
  };
  plan.good = text(good);
  plan.way_back = 2 * plan.good.size();
  plan.shortest = 21;
  plan.samples = {{text(good)},
                  {start + repeated(box, 17) + stop},
                  {text("12 MARK START\n12 N2 blob1 250.0 -187.5 400.0 300.0\n12 MARK STOP\n")},
                  {text("12 MARK START\n13 MARK STOP\n"), 0},
                  {start + polygon(5, 0) + stop, 0},
                  {start + polygon(6, 0) + stop},
                  {start + polygon(32, 0) + stop},
                  {start + text("F2 a 16") + polygon(32, 0, "") + stop},
                  {start + polygon(34, 0) + stop, 0},
                  {start + polygon(6, JeVois::kLine - 1) + stop},
                  {start + polygon(6, JeVois::kLine) + stop},
                  {start + polygon(6, JeVois::kLine + 1) + stop, 0},
                  {text("INF hello\nOK\n1/2020-01-31/12:34:56 T2 a 1 2\n"), 0}};
  return walk(JeVois{}, plan);
}

struct Xbc : Seen {
  static constexpr std::size_t kLine = 64;

  void feed(std::uint8_t byte) {
    const xbc::Event event = decoder.feed(byte, {});
    right = event == xbc::Event::kFrame;
    if (event != xbc::Event::kNone) ++outputs;
    if (decoder.*revealed(XbcSize{}) > kLine) trouble = "a line beyond its buffer";
    if (!right) return;
    if (!inside(decoder.frame(), xbc::kWidth, xbc::kHeight)) trouble = "a box outside of the image";
    right = decoder.frame().frame == 1234 && decoder.frame().blobs.size() == 1;
  }
  void rest() { feed('\n'); }
  [[nodiscard]] bool idle() const { return !(decoder.*revealed(XbcInLine{})); }
  void control(Key& key) const {
    const bool in_line = decoder.*revealed(XbcInLine{});
    key.u8(in_line);
    if (in_line) key.u8(boundary(decoder.*revealed(XbcSize{}), kLine));
    const bool building = decoder.*revealed(XbcBuilding{});
    key.u8(building);
    if (!building) return;
    key.i32(std::clamp(decoder.*revealed(XbcAnnounced{}) - decoder.*revealed(XbcReceived{}), -1, 2));
    key.u8(boundary((decoder.*revealed(XbcNext{})).blobs.size(), sensor::kMaxBlobs));
  }

  xbc::Decoder decoder{{1, 2, 3}};
};

Walked walk_xbc() {
  Plan plan;
  const auto lines = [](std::string_view unsealed) { return sealed(text(unsealed), seal_xbc); };
  const Bytes blob = lines("$B 0 0 178 146 600 54 160 131 196 160 0*00\n");
  const Bytes end = lines("$E 1234*00\n");
  const auto filler = [](std::size_t size) {
    return sealed(Bytes{'$'} + Bytes(size - 4, 'x') + text("*00\n"), seal_xbc);
  };
  plan.good = Bytes{'\n'} + lines("$F 1234 1*00\n") + blob + end;
  plan.way_back = 2 * plan.good.size();
  plan.shortest = 12;
  plan.samples = {{plan.good},
                  {lines("$V XBCL 1*00\r\n")},
                  {lines("$V XBCL 123456789*00\n")},
                  {lines("$V XBCL 1234567890*00\n"), 0},
                  {lines("$F 1234 0*00\n") + end},
                  {lines("$F 1234 0*00\n") + blob + end, 0},
                  {lines("$F 1234 17*00\n") + repeated(blob, 17) + end},
                  {lines("$F 1 96*00\n$F 1 97*00\n$F -1 0*00\n"), 0},
                  {lines("$B 2 31 355 290 32767 100 0 0 355 290 -3142*00\n"), 0},
                  {filler(63), 0},
                  {filler(64), 0},
                  {filler(65), 0}};
  return walk(Xbc{}, plan);
}

struct Cognachrome : Seen {
  void feed(std::uint8_t byte) {
    right = decoder.feed(byte, {});
    if (decoder.*revealed(CognachromeField{}) > cognachrome::kMaxFields) trouble = "fields beyond their number";
    if (!right) return;
    ++outputs;
    for (const sensor::Blob& blob : decoder.frame().blobs) {
      if (!inside(blob, cognachrome::kWidth, cognachrome::kHeight)) trouble = "a box outside of the image";
    }
    right = decoder.frame().blobs.empty();
  }
  void rest() { decoder.reset(); }
  [[nodiscard]] bool idle() const { return state() == 0; }
  void control(Key& key) const {
    key.u8(state());
    key.u8(decoder.*revealed(CognachromeGiven{}));
    key.u8(boundary(decoder.frame().blobs.size(), sensor::kMaxBlobs));
    if (state() == 0) return;
    key.u8(decoder.*revealed(CognachromeBytes{}));
    if (state() != 3) return;
    key.u8(decoder.*revealed(CognachromeChannel{}));
    key.u8(decoder.*revealed(CognachromeField{}));
  }
  [[nodiscard]] std::uint8_t state() const { return static_cast<std::uint8_t>(decoder.*revealed(CognachromeState{})); }

  cognachrome::Decoder decoder;
};

Walked walk_cognachrome_binary() {
  Plan plan;
  const Bytes record = {'a', 0, 125, 0, 100, 0, 200};
  const Bytes largest = {'c', 0, 249, 0, 199, 196, 216};  // 50,000 pixels
  plan.good = {0xFF, 0xFF};
  plan.way_back = 4;
  plan.samples = {{Bytes{0xFF} + record + Bytes{0xFF}},
                  {Bytes{0xFF} + repeated(record, 17) + Bytes{0xFF}},
                  {Bytes{0xFF} + largest + Bytes{0xFE}},
                  {Bytes{0xFF, 'b', 0, 250, 0, 0, 0, 1, 0xFF}, 0}};
  return walk(Cognachrome{{}, cognachrome::Decoder(cognachrome::kBinary)}, plan);
}

Walked walk_cognachrome_hex() {
  Plan plan;
  const Bytes record = text("#0A:10:20:00");
  plan.good = text("$00$00$");
  plan.way_back = 2 * plan.good.size();
  plan.samples = {{text("$00") + record + text("$")},
                  {text("$00") + repeated(record, 17) + text("\r\n$")},
                  {text("$fF&dF:F9:C7:1$")},
                  {text("$00^E0:00:00:00$"), 0},
                  {text("$0g"), 0},
                  {text("$00#123"), 0}};
  return walk(Cognachrome{{}, cognachrome::Decoder(cognachrome::kHex)}, plan);
}

const RegisteredWalk kTextCameras[] = {{"cmucam", "lines and packets", walk_cmucam},
                                       {"jevois", "lines", walk_jevois},
                                       {"xbc", "lines", walk_xbc},
                                       {"cognachrome", "binary", walk_cognachrome_binary},
                                       {"cognachrome", "hex", walk_cognachrome_hex}};

}  // namespace
}  // namespace fencepost::test
