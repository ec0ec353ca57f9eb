#include "host/emulate/models/messages.hpp"

#include <algorithm>
#include <cstdio>

#include "host/text/plural.hpp"

namespace fencepost::emulate {
namespace {

using View = std::span<const std::uint8_t>;

struct Meaning {
  int code;
  const char* text;
};

template <std::size_t N>
std::string look_up(const Meaning (&meanings)[N], int code) {
  for (const Meaning& meaning : meanings) {
    if (meaning.code == code) return meaning.text;
  }
  return {};
}

std::string hex_byte(std::uint8_t byte) {
  char text[4] = {};
  (void)std::snprintf(text, sizeof text, "%02X", static_cast<unsigned>(byte));
  return text;
}

std::string quoted(View bytes) {
  std::string text = "\"";
  for (const std::uint8_t byte : bytes.first(std::min<std::size_t>(bytes.size(), 100))) {
    if (byte == '\r') {
      text += "\\r";
    } else if (byte == '\n') {
      text += "\\n";
    } else {
      text += byte >= ' ' && byte <= '~' ? std::string(1, static_cast<char>(byte)) : "\\x" + hex_byte(byte);
    }
  }
  return text + "\"";
}

constexpr Meaning kPixy2Types[] = {{0x0E, "getVersion"},    {0x0F, "version"},    {0x0C, "getResolution"},
                                   {0x0D, "resolution"},    {0x02, "changeProg"}, {0x01, "result"},
                                   {0x10, "setBrightness"}, {0x12, "setServos"},  {0x14, "setLED"},
                                   {0x16, "setLamp"},       {0x18, "getFPS"},     {0x20, "getBlocks"}};
constexpr Meaning kPixy2Errors[] = {{-1, "general"},         {-2, "busy: no new frame"},
                                    {-3, "invalid request"}, {-4, "unsupported type"},
                                    {-5, "button"},          {-6, "program changing"}};

constexpr Meaning kCreateCodes[] = {{128, "start"},  {131, "safe"},       {132, "full"},
                                    {137, "drive"},  {142, "sensors"},    {145, "drive direct"},
                                    {148, "stream"}, {149, "query list"}, {150, "pause/resume"}};

constexpr Meaning kNxtCodes[] = {{0x05, "set input mode"}, {0x06, "get output state"}, {0x0B, "battery"},
                                 {0x0D, "keep alive"},     {0x0E, "LS get status"},    {0x0F, "LS write"},
                                 {0x10, "LS read"},        {0x88, "firmware version"}};
constexpr Meaning kNxtStates[] = {
    {0x00, "ok"},           {0x20, "pending"},   {0xBE, "unknown opcode"}, {0xBF, "insane packet"},
    {0xC0, "out of range"}, {0xDD, "bus error"}, {0xE0, "not configured"}};

constexpr std::size_t kNxtCam5Blob = 12;  ///< bytes of its frame

}  // namespace

std::string hex_of(View bytes, std::size_t most) {
  std::string text;
  for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), most))) {
    text += (text.empty() ? "" : " ") + hex_byte(byte);
  }
  return bytes.size() > most ? text + " ..." : text;
}

std::string describe_pixy2(bool /*from_host*/, View bytes) {
  if (bytes.size() < 4 || (bytes[0] != 0xAE && bytes[0] != 0xAF) || bytes[1] != 0xC1) return {};
  constexpr std::size_t kBlock = 14;
  if (bytes[2] == 0x21) return host::plural(bytes[3] / kBlock, "block");
  if (bytes[2] == 0x03 && bytes.size() >= 7) {
    return "error " + look_up(kPixy2Errors, static_cast<std::int8_t>(bytes[6]));
  }
  return look_up(kPixy2Types, bytes[2]);
}

std::string describe_create(bool from_host, View bytes) {
  if (!from_host) return bytes[0] == 0x13 ? "stream frame" : "values";
  std::string words;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::string word = look_up(kCreateCodes, bytes[i]);
    if (word.empty()) continue;
    words += (words.empty() ? "" : ", ") + word;
    if (bytes[i] == 148 || bytes[i] == 149) break;  // packet numbers follow
  }
  return words;
}

std::string describe_nxt(bool /*from_host*/, View bytes) {
  if (bytes.size() < 4) return {};
  const std::string name = look_up(kNxtCodes, bytes[3]);
  if (bytes[2] != 0x02 || bytes.size() < 5) return name.empty() ? "unknown command" : name;
  return name + ": " + look_up(kNxtStates, bytes[4]);
}

std::string describe_nxtcam5(bool from_host, View bytes) {
  if (bytes.size() < 5 || bytes[0] != 0x55 || bytes[1] != 0xAA) return {};
  switch (bytes[3]) {
    case 1: return from_host ? "ask version" : "version";
    case 3: return std::string("command '") + static_cast<char>(bytes[4]) + "'";
    case 4: return host::plural(bytes.size() / kNxtCam5Blob, "blob");
    default: return {};
  }
}

std::string describe_text(bool /*from_host*/, View bytes) { return quoted(bytes); }

std::string describe_avrcam(bool from_host, View bytes) {
  if (!from_host && bytes[0] == 0x0A && bytes.size() > 1) return host::plural(bytes[1], "object");
  return quoted(bytes);
}

std::string describe_can(bool /*from_host*/, View /*bytes*/) { return "frame"; }

}  // namespace fencepost::emulate
