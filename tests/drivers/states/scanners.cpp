// Decoders that are a wire::Scanner: Pixy2, HuskyLens, NXTCam, NXT, and Chirp, which Pixys speak on USB.
#include "drivers/chirp/chirp.hpp"
#include "drivers/huskylens/frames.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxtcam/serial.hpp"
#include "drivers/pixy2/protocol.hpp"
#include "drivers/wire/endian.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/drivers/states/scanned.hpp"
#include "tests/drivers/states/walks.hpp"

namespace fencepost::test {
namespace {

struct Pixy2Answers {
  static constexpr std::size_t kCapacity = pixy2::kLongestPacket;
  static constexpr std::size_t kShortest = pixy2::kHeader;
  static constexpr std::size_t kBlock = 14;
  static constexpr std::size_t kWayBack = kCapacity + 2 * (pixy2::kHeader + kBlock);
  static constexpr auto examine = pixy2::examine;

  // Signature 1, 40 x 30 around (160, 100).
  static Bytes block() { return hex("01 00 A0 00 64 00 28 00 1E 00 00 00 01 01"); }
  static Bytes blocks(std::size_t count) {
    const Bytes header = {pixy2::kSync, pixy2::kSecondSync, 0x21, static_cast<std::uint8_t>(count * kBlock), 0, 0};
    return sealed(header + repeated(block(), count), seal_pixy2);
  }
  static Bytes good() { return blocks(1); }
  static std::vector<Sample> samples() {
    const Bytes beyond = {0xAF, 0xC1, 0x21, 253, 0, 0};
    return {{blocks(0)},
            {blocks(1)},
            {blocks(17)},
            {blocks(18)},
            {sealed(beyond + Bytes(253, 1), seal_pixy2), 0},
            {sealed(hex("AF C1 0F 10 00 00 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00"), seal_pixy2)},
            {sealed(hex("AF C1 0D 04 00 00 3C 01 D0 00"), seal_pixy2)},
            {sealed(hex("AF C1 01 04 00 00 00 00 00 00"), seal_pixy2)},
            {sealed(hex("AF C1 03 01 00 00 FE"), seal_pixy2)}};
  }
  static void control(View pending, Key& key) {
    if (pending.size() > 2) key.u8(pending[2]);
    if (pending.size() > 3) key.u8(pending[3]);
    if (pending.size() < pixy2::kHeader) return;
    unsigned missing = wire::little_u16(pending, 4);
    for (const std::uint8_t byte : pending.subspan(pixy2::kHeader)) missing -= byte;
    missing &= 0xFFFFU;  // left for the rest to add: nothing, as much as one byte can, more
    key.u8(missing == 0 ? 0 : missing < 256 ? 1 : 2);
  }
  static bool followed(View pending) {
    return pending.size() < 4 || pending[2] != 0x21 ||
           one_of<4>(pending[3], {0, kBlock, 17 * kBlock, 18 * kBlock}) != 0xFFFF;
  }
  static std::string_view trouble(View message) {
    const pixy2::Packet packet = pixy2::packet_of(message);
    if (packet.data.size() != message[3]) return "a packet has another length than it says";
    const auto seen = pixy2::blocks_in(packet);
    (void)pixy2::version_in(packet), (void)pixy2::result_in(packet), (void)pixy2::error_in(packet);
    (void)pixy2::resolution_in(packet);
    if (!seen) return {};
    for (const sensor::Blob& blob : seen->frame.blobs) {
      if (!inside(blob, pixy2::kBlobResolution.width, pixy2::kBlobResolution.height))
        return "a box outside of the image";
    }
    return seen->dropped + seen->frame.blobs.size() == packet.data.size() / kBlock ? "" : "blocks are lost";
  }
};

struct Pixy2Requests {
  static constexpr std::size_t kCapacity = pixy2::kHeader + pixy2::kProgramName;
  static constexpr std::size_t kShortest = pixy2::kHeader;
  static constexpr std::size_t kWayBack = kCapacity + 2 * 8;
  static constexpr auto examine = pixy2::examine_request;

  static Bytes good() { return bytes_of(pixy2::request_blocks(0x7F).view()); }
  static std::vector<Sample> samples() {
    return {{good()},
            {bytes_of(pixy2::request_version().view())},
            {bytes_of(pixy2::request_program().view())},
            {bytes_of(pixy2::request_resolution().view())},
            {hex("AF C1 02 22 00 00") + Bytes(34, 1), 0}};
  }
  static void control(View pending, Key& key) {
    if (pending.size() > 3) key.u8(pending[3]);
  }
  static bool followed(View /*pending*/) { return true; }
  static std::string_view trouble(View message) {
    return pixy2::packet_of(message).data.size() == message[3] ? "" : "a request has another length than it says";
  }
};

struct HuskyLensFrames {
  static constexpr std::size_t kCapacity = huskylens::kLongestFrame;
  static constexpr std::size_t kShortest = huskylens::kAround;
  static constexpr std::size_t kWayBack = kCapacity + 2 * 16;
  static constexpr auto examine = huskylens::examine;

  static Bytes frame(Bytes header, std::size_t length) {
    return sealed(header + Bytes(length + 1, 0x01), seal_huskylens);
  }
  static Bytes good() { return hex("55 AA 11 0A 2A A0 00 78 00 3C 00 28 00 01 00 C1"); }
  static std::vector<Sample> samples() {
    std::vector<Sample> all = {{good()},
                               {hex("55 AA 11 0A 29 01 00 01 00 08 00 00 00 00 00 4D")},
                               {hex("55 AA 11 0A 2B 14 00 0A 00 2C 01 C8 00 01 00 59")},
                               {frame({0x55, 0xAA, 0x11, 0, 0x3D}, 0)},
                               {frame({0x55, 0xAA, 0x11, 1, 0x3D}, 1), 0}};
    for (const std::uint8_t length : std::initializer_list<std::uint8_t>{0, 1, 63, 64, 65}) {
      const std::uint32_t whole = length <= huskylens::kLongestData ? 1 : 0;
      all.push_back({frame({0x55, 0xAA, 0x11, length, 0x2E}, length), whole});
      all.push_back({frame({0x55, 0xAA, 0x40, 5, length}, length), whole});
    }
    for (const std::uint8_t length : std::initializer_list<std::uint8_t>{9, 10, 63, 64, 65}) {
      all.push_back({frame({0x55, 0xAA, 0x43, 5, length}, length), length >= 10 && length <= 64 ? 1U : 0U});
    }
    return all;
  }
  static std::uint16_t length_class(std::size_t length) { return one_of<7>(length, {0, 1, 9, 10, 63, 64, 65}); }
  static void control(View pending, Key& key) {
    if (pending.size() < 3) return;
    const bool one = pending[2] == 0x11;
    key.u8(pending[2] >= 0x40 && pending[2] <= 0x44 ? pending[2] : one ? 1 : 0);
    if (pending.size() > 3 && one) key.u16(length_class(pending[3]));
    if (pending.size() > 4) key.u8(one ? pending[4] : 0), key.u16(one ? 0 : length_class(pending[4]));
  }
  static bool followed(View pending) {
    return pending.size() < 5 || length_class(pending[2] == 0x11 ? pending[3] : pending[4]) != 0xFFFF;
  }
  static std::string_view trouble(View bytes) {
    const huskylens::Message message = huskylens::message_of(bytes);
    if (message.data.size() + huskylens::kAround != bytes.size()) return "a frame has another length than it says";
    if (message.kind == huskylens::Kind::kInfo) (void)huskylens::info_in(message);
    if (message.kind != huskylens::Kind::kBlock) return {};
    for (const std::uint16_t width : {huskylens::kWidth, huskylens::kWidth2}) {
      const auto blob = huskylens::blob_in(message, width);
      if (blob && !inside(*blob, width, width * 3 / 4)) return "a box outside of the image";
    }
    return {};
  }
};

struct AvrCam {
  static constexpr std::size_t kCapacity = nxtcam::kLongestTracking;
  static constexpr std::size_t kShortest = 2;
  static constexpr std::size_t kWayBack = kCapacity + 2 * 8;
  static constexpr auto examine = nxtcam::examine_avrcam;

  static Bytes tracking(std::size_t count) {
    return Bytes{0x0A, static_cast<std::uint8_t>(count)} + repeated(hex("00 0A 0A 0C 0C"), count) + Bytes{0xFF};
  }
  static Bytes good() { return tracking(1); }
  static std::vector<Sample> samples() {
    const auto line = [](std::size_t size) { return Bytes(size, 'A') + Bytes{'\r'}; };
    return {{tracking(0)}, {tracking(1)},        {tracking(7)}, {tracking(8)}, {tracking(9), 0},
            {line(1)},     {hex("41 43 4B 0D")}, {line(31)},    {line(32)},    {line(33), 1}};
  }
  static void control(View pending, Key& key) {
    if (pending.empty()) return;
    key.u8(pending[0] == 0x0A ? 1 : 0);
    if (pending[0] == 0x0A && pending.size() > 1) key.u8(pending[1]);
  }
  static bool followed(View /*pending*/) { return true; }
  static std::string_view trouble(View message) {
    const auto frame = nxtcam::tracking_in(message);
    if (!frame) return nxtcam::line_in(message).empty() ? "neither objects nor text" : "";
    for (const sensor::Blob& blob : frame->blobs) {
      if (!inside(blob, nxtcam::kWidth, nxtcam::kHeight)) return "a box outside of the image";
    }
    return frame->blobs.size() == message[1] ? "" : "objects are lost";
  }
};

struct NxtCam5 {
  static constexpr std::size_t kCapacity = nxtcam::kLongestV5;
  static constexpr std::size_t kShortest = 5;
  static constexpr std::size_t kWayBack = kCapacity + 2 * 12;
  static constexpr auto examine = nxtcam::examine_v5;

  static Bytes other(std::size_t length) {
    return sealed(Bytes{0x55, 0xAA, static_cast<std::uint8_t>(length), 1} + Bytes(length + 1, 'v'), seal_nxtcam5);
  }
  static Bytes good() { return hex("55 AA 07 04 11 00 02 64 3C 8C 5A A3"); }
  static std::vector<Sample> samples() {
    return {{good()}, {other(0)}, {other(1)}, {other(63)}, {other(64)}, {other(65), 0}};
  }
  static std::uint16_t length_class(std::size_t length) { return one_of<6>(length, {0, 1, 7, 63, 64, 65}); }
  static void control(View pending, Key& key) {
    if (pending.size() > 2) key.u16(length_class(pending[2]));
    if (pending.size() > 3) key.u8(pending[3] == 4 ? 1 : 0);
  }
  static bool followed(View pending) { return pending.size() < 4 || length_class(pending[2]) != 0xFFFF; }
  static std::string_view trouble(View message) {
    const auto blob = nxtcam::v5_blob_in(message);
    return blob && !inside(blob->blob, nxtcam::kV5Width, nxtcam::kV5Height) ? "a box outside of the image" : "";
  }
};

struct NxtTelegrams {
  static constexpr std::size_t kCapacity = nxt::kLengthPrefix + nxt::kLongestTelegram;
  static constexpr std::size_t kShortest = nxt::kLengthPrefix + 3;
  static constexpr std::size_t kWayBack = kCapacity + 2 * 9;
  static constexpr auto examine = nxt::examine_framed;

  static Bytes telegram(std::size_t length) {
    return Bytes{static_cast<std::uint8_t>(length), 0, 2} + Bytes(length - 1, 0);
  }
  static Bytes good() { return hex("07 00 02 0D 00 40 77 1B 00"); }
  static std::vector<Sample> samples() {
    std::vector<Sample> all = {{good()}, {telegram(2), 0}, {telegram(65), 0}};
    for (const std::size_t length : {3U, 4U, 20U, 25U, 63U, 64U}) all.push_back({telegram(length)});
    return all;
  }
  static std::uint16_t length_class(View pending) {
    return one_of<10>(pending[0] + 256U * (pending.size() > 1 ? pending[1] : 0), {3, 4, 5, 6, 7, 20, 24, 25, 63, 64});
  }
  static void control(View pending, Key& key) {
    if (!pending.empty()) key.u16(length_class(pending));
  }
  static bool followed(View pending) { return pending.size() < 2 || length_class(pending) != 0xFFFF; }
  static std::string_view trouble(View message) {
    const View telegram = message.subspan(nxt::kLengthPrefix);
    if (telegram.size() != message[0]) return "a telegram has another length than it says";
    const auto reply = nxt::reply_in(telegram);
    if (reply && reply->status == nxt::status::kOk && reply->opcode == nxt::Opcode::kSensorRead &&
        nxt::sensor_bytes_of(*reply).size() > nxt::kMaxSensorBytes) {
      return "more bytes of a sensor than it can send";
    }
    return {};
  }
};

struct Chirp {
  static constexpr std::size_t kCapacity = chirp::kLongest;
  static constexpr std::size_t kShortest = chirp::kHeader;
  static constexpr std::size_t kWayBack = kCapacity + 2 * 16;
  static constexpr std::size_t kMax = chirp::kLongest - chirp::kHeader;
  static constexpr auto examine = chirp::examine;

  static Bytes message(std::size_t length) {
    return hex("55 55 AA AA 40 00 00 00") +
           Bytes{static_cast<std::uint8_t>(length % 256), static_cast<std::uint8_t>(length / 256), 0, 0} +
           Bytes(length, 1);
  }
  static Bytes good() { return hex("55 55 AA AA 60 00 00 00 04 00 00 00 05 00 00 00"); }
  static std::vector<Sample> samples() {
    return {{good()},
            {hex("55 55 AA AA 40 00 FF FF 0D 00 00 00 00 00 00 00 01 03 81 81 01 00 00 00 FE")},
            {message(0)},
            {message(1)},
            {message(kMax - 1)},
            {message(kMax)},
            {message(kMax + 1), 0}};
  }
  // Of its bytes that are there; the others are zero.
  static std::uint16_t length_class(View pending) {
    std::uint32_t length = 0;
    for (std::size_t at = pending.size(); at > chirp::kHeader - 4; --at) {
      if (at <= chirp::kHeader) length = 256 * length + pending[at - 1];
    }
    return one_of<8>(length, {0, 1, 4, 5, (kMax - 1) % 256, kMax % 256, kMax - 1, kMax});
  }
  static void control(View pending, Key& key) { key.u16(length_class(pending)); }
  static bool followed(View pending) { return pending.size() < chirp::kHeader || length_class(pending) != 0xFFFF; }
  static std::string_view trouble(View message) {
    const auto answer = chirp::message_in(message);
    if (!answer) return {};
    const auto packet = chirp::packet_in(*answer);
    return packet && packet->data.size() > 255 ? "a packet is too long" : "";
  }
};

const RegisteredWalk kWalks[] = {
    {"pixy2", "answers", walk_scanner<Pixy2Answers>},
    {"pixy2", "requests", walk_scanner<Pixy2Requests>},
    {"huskylens", "frames", walk_scanner<HuskyLensFrames>},
    {"nxtcam", "AVRcam", walk_scanner<AvrCam>},
    {"nxtcam", "v5", walk_scanner<NxtCam5>},
    {"nxt", "telegrams", walk_scanner<NxtTelegrams>},
    {"chirp", "messages", walk_scanner<Chirp>},
};

}  // namespace
}  // namespace fencepost::test
