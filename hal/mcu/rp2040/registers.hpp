// Registers of the RP2040 where the RP2350 differs. Source: RP2040 Datasheet (Raspberry Pi Ltd), sections as given;
// memory map 2.2.
#pragma once

#include <cstdint>

namespace fencepost::mcu::rp2040 {

// Resets of the peripherals, 2.14.3.

inline constexpr std::uint32_t kResets = 0x4000'C000;
inline constexpr std::uint32_t kResetsDone = kResets + 0x08;
inline constexpr std::uint32_t kResetI2c0 = 1U << 3;
inline constexpr std::uint32_t kResetI2c1 = 1U << 4;
inline constexpr std::uint32_t kResetIoBank0 = 1U << 5;
inline constexpr std::uint32_t kResetPadsBank0 = 1U << 8;
inline constexpr std::uint32_t kResetPllSys = 1U << 12;
inline constexpr std::uint32_t kResetPllUsb = 1U << 13;
inline constexpr std::uint32_t kResetPwm = 1U << 14;
inline constexpr std::uint32_t kResetTimer = 1U << 21;
inline constexpr std::uint32_t kResetUart0 = 1U << 22;
inline constexpr std::uint32_t kResetUart1 = 1U << 23;
inline constexpr std::uint32_t kResetUsb = 1U << 24;

// Crystal oscillator, 2.16.7.

inline constexpr std::uint32_t kXoscControl = 0x4002'4000;
inline constexpr std::uint32_t kXoscStatus = 0x4002'4004;
inline constexpr std::uint32_t kXoscStartup = 0x4002'400C;  // in units of 256 periods

// Ring oscillator, 2.17; PLLs, 2.18.4.

inline constexpr std::uint32_t kRingHz = 6'500'000;
inline constexpr std::uint32_t kPllSys = 0x4002'8000;
inline constexpr std::uint32_t kPllUsb = 0x4002'C000;
inline constexpr std::uint32_t kCoreHz = 125'000'000;  // 1500 MHz / 6 / 2
inline constexpr std::uint32_t kPllSysFirst = 6;

// Clock generators, 2.15.7.

inline constexpr std::uint32_t kClockRefControl = 0x4000'8030;
inline constexpr std::uint32_t kClockRefDivider = 0x4000'8034;   // in 256ths
inline constexpr std::uint32_t kClockRefSelected = 0x4000'8038;  // one bit a source
inline constexpr std::uint32_t kClockSysControl = 0x4000'803C;
inline constexpr std::uint32_t kClockSysDivider = 0x4000'8040;
inline constexpr std::uint32_t kClockSysSelected = 0x4000'8044;
inline constexpr std::uint32_t kClockPeriControl = 0x4000'8048;
inline constexpr std::uint32_t kClockUsbControl = 0x4000'8054;
inline constexpr std::uint32_t kClockUsbDivider = 0x4000'8058;
inline constexpr std::uint32_t kClockSysResuscitate = 0x4000'8078;  // the remedy when it stops
inline constexpr std::uint32_t kUndivided = 1U << 8;

// Power-on state machine, 2.13.5: what a watchdog reset resets.

inline constexpr std::uint32_t kPowerWatchdogSelect = 0x4001'0008;
inline constexpr std::uint32_t kAllButOscillators = 0x1'FFFC;

// Why the chip was reset, 2.12.8. A brown-out looks like power-on.

inline constexpr std::uint32_t kChipReset = 0x4006'4008;
inline constexpr std::uint32_t kResetByPower = 1U << 8;
inline constexpr std::uint32_t kResetByBrownOut = 0;
inline constexpr std::uint32_t kResetByRunPin = 1U << 16;
inline constexpr std::uint32_t kResetByDebugger = 1U << 20;

// Watchdog, 4.7.6.

inline constexpr std::uint32_t kWatchdogControl = 0x4005'8000;
inline constexpr std::uint32_t kWatchdogLoad = 0x4005'8004;
inline constexpr std::uint32_t kWatchdogReason = 0x4005'8008;
inline constexpr std::uint32_t kWatchdogScratch = 0x4005'800C;  // eight words; the boot ROM uses 4 to 7 (2.8.1.1)
inline constexpr std::uint32_t kWatchdogTick = 0x4005'802C;
inline constexpr std::uint32_t kTickEnable = 1U << 9;
inline constexpr std::uint32_t kCountsPerMicrosecond = 2;  // erratum RP2040-E1

// Timer, 4.6.5: microseconds in 64 bits.

inline constexpr std::uint32_t kTimerAlarm0 = 0x4005'4010;
inline constexpr std::uint32_t kTimerRawHigh = 0x4005'4024;
inline constexpr std::uint32_t kTimerRawLow = 0x4005'4028;
inline constexpr std::uint32_t kTimerDebugPause = 0x4005'402C;  // while a debugger holds a core; on after a reset
inline constexpr std::uint32_t kTimerInterrupts = 0x4005'4034;
inline constexpr std::uint32_t kTimerInterruptEnable = 0x4005'4038;

// Pins, 2.19.6.1 (functions, interrupts) and 2.19.6.3 (pads); single-cycle access 2.3.1.7.

inline constexpr std::uint32_t kPins = 30;
inline constexpr std::uint32_t kPinControl = 0x4001'4004;          // 8 bytes a pin
inline constexpr std::uint32_t kPinInterrupts = 0x4001'40F0;       // four bits a pin, eight pins a word
inline constexpr std::uint32_t kPinInterruptEnable = 0x4001'4100;  // for core 0
inline constexpr std::uint32_t kPad = 0x4001'C004;                 // 4 bytes a pin
inline constexpr std::uint32_t kSioIn = 0xD000'0004;
inline constexpr std::uint32_t kSioOutSet = 0xD000'0014;
inline constexpr std::uint32_t kSioOutClear = 0xD000'0018;
inline constexpr std::uint32_t kSioDriveSet = 0xD000'0024;
inline constexpr std::uint32_t kSioDriveClear = 0xD000'0028;

// Peripherals, 2.2.

inline constexpr std::uint32_t kPwm = 0x4005'0000;
inline constexpr std::uint32_t kUart0 = 0x4003'4000;
inline constexpr std::uint32_t kUart1 = 0x4003'8000;
inline constexpr std::uint32_t kI2c0 = 0x4004'4000;
inline constexpr std::uint32_t kI2c1 = 0x4004'8000;

// The flash's serial port, 4.10.13; its chip select is a pin of a bank of its own, 2.19.6.2.

inline constexpr std::uint32_t kSsiStatus = 0x1800'0028;
inline constexpr std::uint32_t kSsiData = 0x1800'0060;
inline constexpr std::uint32_t kSsiReceived = 1U << 3;
inline constexpr std::uint32_t kFlashSelect = 0x4001'800C;
inline constexpr std::uint32_t kFlashSelectLow = 2U << 8;  // whatever the SSI says
inline constexpr std::uint32_t kFlashSelectHigh = 3U << 8;

// Boot ROM, 2.8.3: where it says what it is, and where its functions are.

inline constexpr std::uint32_t kRomMagic = 0x10;          // 'M', 'u', 1, version
inline constexpr std::uint32_t kRomFunctionTable = 0x14;  // 16 bits
inline constexpr std::uint32_t kRomLookUp = 0x18;         // 16 bits

// Interrupt numbers, 2.3.2.

inline constexpr std::uint32_t kInterrupts = 26;
inline constexpr std::uint32_t kInterruptTimer0 = 0;
inline constexpr std::uint32_t kInterruptUsb = 5;
inline constexpr std::uint32_t kInterruptPins = 13;
inline constexpr std::uint32_t kInterruptUart0 = 20;
inline constexpr std::uint32_t kInterruptUart1 = 21;
inline constexpr std::uint32_t kInterruptI2c0 = 23;
inline constexpr std::uint32_t kInterruptI2c1 = 24;

}  // namespace fencepost::mcu::rp2040
