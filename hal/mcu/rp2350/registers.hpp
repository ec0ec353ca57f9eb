// Registers of the RP2350 where the RP2040 differs. Source: RP2350 Datasheet (Raspberry Pi Ltd), sections as given;
// memory map 2.2.
#pragma once

#include <cstdint>

namespace fencepost::mcu::rp2350 {

// Resets of the peripherals, 7.5.3.

inline constexpr std::uint32_t kResets = 0x4002'0000;
inline constexpr std::uint32_t kResetsDone = kResets + 0x08;
inline constexpr std::uint32_t kResetI2c0 = 1U << 4;
inline constexpr std::uint32_t kResetI2c1 = 1U << 5;
inline constexpr std::uint32_t kResetIoBank0 = 1U << 6;
inline constexpr std::uint32_t kResetPadsBank0 = 1U << 9;
inline constexpr std::uint32_t kResetPllSys = 1U << 14;
inline constexpr std::uint32_t kResetPllUsb = 1U << 15;
inline constexpr std::uint32_t kResetPwm = 1U << 16;
inline constexpr std::uint32_t kResetTimer = 1U << 23;
inline constexpr std::uint32_t kResetUart0 = 1U << 26;
inline constexpr std::uint32_t kResetUart1 = 1U << 27;
inline constexpr std::uint32_t kResetUsb = 1U << 28;

// Crystal oscillator, 8.2.8.

inline constexpr std::uint32_t kXoscControl = 0x4004'8000;
inline constexpr std::uint32_t kXoscStatus = 0x4004'8004;
inline constexpr std::uint32_t kXoscStartup = 0x4004'800C;  // in units of 256 periods

// Ring oscillator, 8.3.1; PLLs, 8.6.5.

inline constexpr std::uint32_t kRingHz = 11'000'000;
inline constexpr std::uint32_t kPllSys = 0x4005'0000;
inline constexpr std::uint32_t kPllUsb = 0x4005'8000;
inline constexpr std::uint32_t kCoreHz = 150'000'000;  // 1500 MHz / 5 / 2
inline constexpr std::uint32_t kPllSysFirst = 5;

// Clock generators, 8.1.7.

inline constexpr std::uint32_t kClockRefControl = 0x4001'0030;
inline constexpr std::uint32_t kClockRefDivider = 0x4001'0034;   // in 65536ths
inline constexpr std::uint32_t kClockRefSelected = 0x4001'0038;  // one bit a source
inline constexpr std::uint32_t kClockSysControl = 0x4001'003C;
inline constexpr std::uint32_t kClockSysDivider = 0x4001'0040;
inline constexpr std::uint32_t kClockSysSelected = 0x4001'0044;
inline constexpr std::uint32_t kClockPeriControl = 0x4001'0048;
inline constexpr std::uint32_t kClockUsbControl = 0x4001'0060;
inline constexpr std::uint32_t kClockUsbDivider = 0x4001'0064;
inline constexpr std::uint32_t kClockSysResuscitate = 0x4001'0084;  // the remedy when it stops
inline constexpr std::uint32_t kUndivided = 1U << 16;

// Power-on state machine, 7.4.4: what a watchdog reset resets.

inline constexpr std::uint32_t kPowerWatchdogSelect = 0x4001'8008;
inline constexpr std::uint32_t kAllButOscillators = 0x1FF'FFF3;

// Why the chip was reset, 6.4 (POWMAN).

inline constexpr std::uint32_t kChipReset = 0x4010'002C;
inline constexpr std::uint32_t kResetByPower = 1U << 16;
inline constexpr std::uint32_t kResetByBrownOut = 1U << 17;
inline constexpr std::uint32_t kResetByRunPin = 1U << 18;
inline constexpr std::uint32_t kResetByDebugger = 1U << 19;

// Watchdog, 12.9.7.

inline constexpr std::uint32_t kWatchdogControl = 0x400D'8000;
inline constexpr std::uint32_t kWatchdogLoad = 0x400D'8004;
inline constexpr std::uint32_t kWatchdogReason = 0x400D'8008;
inline constexpr std::uint32_t kWatchdogScratch = 0x400D'800C;  // eight words; the boot ROM uses 2 to 7 (5.2.4)
inline constexpr std::uint32_t kCountsPerMicrosecond = 1;

// Generators of microseconds, 8.5.2: one for the timer, one for the watchdog.

inline constexpr std::uint32_t kTimerTickControl = 0x4010'8018;
inline constexpr std::uint32_t kTimerTickCycles = 0x4010'801C;
inline constexpr std::uint32_t kWatchdogTickControl = 0x4010'8030;
inline constexpr std::uint32_t kWatchdogTickCycles = 0x4010'8034;
inline constexpr std::uint32_t kTickEnable = 1U << 0;

// Timer, 12.8.5: microseconds in 64 bits.

inline constexpr std::uint32_t kTimerAlarm0 = 0x400B'0010;
inline constexpr std::uint32_t kTimerRawHigh = 0x400B'0024;
inline constexpr std::uint32_t kTimerRawLow = 0x400B'0028;
inline constexpr std::uint32_t kTimerDebugPause = 0x400B'002C;  // while a debugger holds a core; on after a reset
inline constexpr std::uint32_t kTimerInterrupts = 0x400B'003C;
inline constexpr std::uint32_t kTimerInterruptEnable = 0x400B'0040;

// Pins, 9.11.1 (functions, interrupts) and 9.11.3 (pads); single-cycle access 3.1.11, where a bank of 32 pins has its
// registers 4 bytes behind the first's.

inline constexpr std::uint32_t kPins = 48;
inline constexpr std::uint32_t kPinControl = 0x4002'8004;          // 8 bytes a pin
inline constexpr std::uint32_t kPinInterrupts = 0x4002'8230;       // four bits a pin, eight pins a word
inline constexpr std::uint32_t kPinInterruptEnable = 0x4002'8248;  // for core 0
inline constexpr std::uint32_t kPad = 0x4003'8004;                 // 4 bytes a pin
inline constexpr std::uint32_t kSioIn = 0xD000'0004;
inline constexpr std::uint32_t kSioOutSet = 0xD000'0018;
inline constexpr std::uint32_t kSioOutClear = 0xD000'0020;
inline constexpr std::uint32_t kSioDriveSet = 0xD000'0038;
inline constexpr std::uint32_t kSioDriveClear = 0xD000'0040;

// Peripherals, 2.2.

inline constexpr std::uint32_t kPwm = 0x400A'8000;
inline constexpr std::uint32_t kUart0 = 0x4007'0000;
inline constexpr std::uint32_t kUart1 = 0x4007'8000;
inline constexpr std::uint32_t kI2c0 = 0x4009'0000;
inline constexpr std::uint32_t kI2c1 = 0x4009'8000;

// Boot ROM, 5.4.1: where it says what it is, and what finds its functions.

inline constexpr std::uint32_t kRomMagic = 0x10;        // 'M', 'u', 2, version
inline constexpr std::uint32_t kRomLookUp = 0x16;       // 16 bits
inline constexpr std::uint32_t kRomSecureFunction = 4;  // the kind that it finds
inline constexpr std::uint32_t kRomToLoader = 0x002;    // of a reset, 5.4.8.24
inline constexpr std::uint32_t kRomNoReturn = 0x100;
inline constexpr std::uint32_t kRomChipInfo = 0x001;  // package and id, 5.4.8.17

// Interrupt numbers, 3.2.

inline constexpr std::uint32_t kInterrupts = 52;
inline constexpr std::uint32_t kInterruptTimer0 = 0;
inline constexpr std::uint32_t kInterruptUsb = 14;
inline constexpr std::uint32_t kInterruptPins = 21;
inline constexpr std::uint32_t kInterruptUart0 = 33;
inline constexpr std::uint32_t kInterruptUart1 = 34;
inline constexpr std::uint32_t kInterruptI2c0 = 36;
inline constexpr std::uint32_t kInterruptI2c1 = 37;

}  // namespace fencepost::mcu::rp2350
