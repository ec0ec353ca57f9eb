// Registers of the Game Boy Advance. Nintendo published no manual; the source is GBATEK (M. Korth, "GBA Reference"),
// its chapters as given. All registers are 16 bits wide unless it says otherwise.
#pragma once

#include <cstdint>

namespace fencepost::mcu::gba {

inline constexpr std::uint32_t kCoreHz = 16'777'216;  // Technical Data: 2^24

// Video: LCD I/O Display Control, LCD I/O Interrupts and Status, LCD VRAM Bitmap BG Modes, LCD Color Palettes.
inline constexpr std::uint32_t kDisplayControl = 0x0400'0000;
inline constexpr std::uint32_t kDisplayLine = 0x0400'0006;     // VCOUNT: 0..227, from 160 on nothing is drawn
inline constexpr std::uint16_t kDisplayMode4 = 4;              // 240 x 160, a byte a pixel, two pages
inline constexpr std::uint16_t kDisplaySecondPage = 1U << 4;   // shown page
inline constexpr std::uint16_t kDisplayBackground = 1U << 10;  // BG2, the bitmap
inline constexpr std::uint32_t kPalette = 0x0500'0000;         // 256 times 5 bits each of red, green, blue from bit 0
inline constexpr std::uint32_t kVideoMemory = 0x0600'0000;     // written in 16 bits at least
inline constexpr std::uint32_t kVideoPage = 0xA000;            // bytes from the first page to the second

// Timers: Timer Registers; four, 4 bytes apart.

inline constexpr std::uint32_t kTimerCount = 0x0400'0100;  // read: count; write: what it starts again from
inline constexpr std::uint32_t kTimerControl = 0x0400'0102;
inline constexpr std::uint32_t kTimerStride = 4;
inline constexpr std::uint16_t kTimerBy64 = 1;           // counts every 64 cycles
inline constexpr std::uint16_t kTimerCascade = 1U << 2;  // counts the overflows of the timer before it
inline constexpr std::uint16_t kTimerInterrupt = 1U << 6;
inline constexpr std::uint16_t kTimerStart = 1U << 7;

// Link port as a UART: SIO UART Mode, SIO General-Purpose Mode (RCNT).
inline constexpr std::uint32_t kSerialControl = 0x0400'0128;  // SIOCNT
inline constexpr std::uint32_t kSerialData = 0x0400'012A;     // SIODATA8
inline constexpr std::uint32_t kLinkMode = 0x0400'0134;       // RCNT; 0: SIOCNT decides
inline constexpr std::uint16_t kSerialFull = 1U << 4;         // nothing more can be sent
inline constexpr std::uint16_t kSerialEmpty = 1U << 5;        // nothing was received
inline constexpr std::uint16_t kSerialFault = 1U << 6;        // cleared by reading
inline constexpr std::uint16_t kSerialEightBits = 1U << 7;
inline constexpr std::uint16_t kSerialFifo = 1U << 8;  // four bytes each way; emptied while it is off
inline constexpr std::uint16_t kSerialSend = 1U << 10;
inline constexpr std::uint16_t kSerialReceive = 1U << 11;
inline constexpr std::uint16_t kSerialUart = 3U << 12;
inline constexpr std::uint16_t kSerialInterrupt = 1U << 14;  // when "full", "empty" or "fault" becomes set

// Keys: Keypad Input. A bit is 0 while its key is held.
inline constexpr std::uint32_t kKeys = 0x0400'0130;

// Interrupt Control.
inline constexpr std::uint32_t kInterruptEnable = 0x0400'0200;
inline constexpr std::uint32_t kInterruptFlags = 0x0400'0202;  // writing a bit clears it
inline constexpr std::uint32_t kInterruptMaster = 0x0400'0208;
inline constexpr std::uint16_t kInterruptTimer2 = 1U << 5;
inline constexpr std::uint16_t kInterruptSerial = 1U << 7;
inline constexpr std::uint32_t kBiosInterruptFlags = 0x0300'7FF8;  // read by the BIOS's own waiting
inline constexpr std::uint32_t kInterruptHandler = 0x0300'7FFC;    // 32 bits: where the BIOS jumps, in ARM state

// System Control: waits of the cartridge.
inline constexpr std::uint32_t kWaitControl = 0x0400'0204;
// Memory 8 cycles; program 3, then 1 a halfword; prefetch. What cartridges of that time are made for.
inline constexpr std::uint16_t kWaits = 0x4317;

}  // namespace fencepost::mcu::gba
