// The board's descriptors on USB: one serial line (USB CDC 1.2, PSTN 1.2: abstract control model).
#pragma once

#include <array>
#include <cstdint>

namespace fencepost::mcu::rp2::usb {

inline constexpr std::uint8_t kNotifyEndpoint = 1;  // in; required by the class, never used
inline constexpr std::uint8_t kDataEndpoint = 2;    // in and out
inline constexpr std::uint8_t kPacket = 64;

// USB 2.0 table 9-8; class, subclass and protocol say that an association follows (its ECN, table 9-Z): Windows then
// finds its driver for serial lines. 1209:0001 is the test id of pid.codes: whoever sells boards has to register one.
// A board with a serial number puts its index in.
inline constexpr std::array<std::uint8_t, 18> kDevice = {18,   1,    0x00, 0x02, 0xEF, 2, 1, kPacket, 0x09,
                                                         0x12, 0x01, 0x00, 0x00, 0x01, 1, 2, 0,       1};

// Configuration (table 9-10), then the association of both interfaces. Control interface with its four descriptors (CDC
// 5.2.3) and the notify endpoint; data interface with two bulk endpoints.
inline constexpr std::array<std::uint8_t, 75> kConfiguration = {
    9,    2,       75,
    0,    2,       1,
    0,    0x80,    150,  // powered by the bus, 300 mA: the board, and a Pixy2 with its lamp at VBUS
    8,    11,      0,
    2,    2,       2,
    0,    0,  // both interfaces are one function
    9,    4,       0,
    0,    1,       2,
    2,    0,       0,  // communication, abstract control model
    5,    0x24,    0,
    0x20, 0x01,  // CDC 1.2
    5,    0x24,    1,
    0,    1,  // no call management; data interface 1
    4,    0x24,    2,
    2,  // line coding and control line state are understood
    5,    0x24,    6,
    0,    1,  // union of interfaces 0 and 1
    7,    5,       0x80 | kNotifyEndpoint,
    3,    8,       0,
    255,  // interrupt
    9,    4,       1,
    0,    2,       10,
    0,    0,       0,  // data
    7,    5,       kDataEndpoint,
    2,    kPacket, 0,
    0,  // bulk out
    7,    5,       0x80 | kDataEndpoint,
    2,    kPacket, 0,
    0};  // bulk in

inline constexpr std::size_t kSerialIndexAt = 16;  // in the device's

// Strings (9.6.7): the language; maker and product; serial number.

inline constexpr std::array<std::uint8_t, 4> kLanguage = {4, 3, 0x09, 0x04};
inline constexpr std::array<std::uint8_t, 20> kName = {20,  3, 'F', 0, 'e', 0, 'n', 0, 'c', 0,
                                                       'e', 0, 'p', 0, 'o', 0, 's', 0, 't', 0};

inline constexpr std::uint8_t kSerialIndex = 3;
using SerialNumber = std::array<std::uint8_t, 34>;

/// Sixteen digits, capitals, as the vendor's programs give them.
constexpr SerialNumber serial_number(std::uint64_t id) {
  SerialNumber string = {34, 3};
  for (std::size_t at = string.size() - 2; at > 0; at -= 2) {
    const auto digit = static_cast<std::uint8_t>(id & 0xFU);
    string[at] = static_cast<std::uint8_t>(digit < 10 ? '0' + digit : 'A' + digit - 10);
    id >>= 4;
  }
  return string;
}

// Requests: USB 2.0 table 9-4; PSTN table 13.

inline constexpr std::uint8_t kClearFeature = 1;
inline constexpr std::uint8_t kSetAddress = 5;
inline constexpr std::uint8_t kGetDescriptor = 6;
inline constexpr std::uint8_t kGetConfiguration = 8;
inline constexpr std::uint8_t kSetConfiguration = 9;
inline constexpr std::uint8_t kSetLineCoding = 0x20;
inline constexpr std::uint8_t kGetLineCoding = 0x21;
inline constexpr std::uint8_t kSetControlLineState = 0x22;

}  // namespace fencepost::mcu::rp2::usb
