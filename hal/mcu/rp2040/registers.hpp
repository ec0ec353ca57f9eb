// Registers of the RP2040. Source: RP2040 Datasheet (Raspberry Pi Ltd), sections as given; memory map 2.2.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"

namespace fencepost::mcu::rp2040 {

// Each register of a peripheral is there four times; a write to these two changes only the bits that are set in it,
// in one access (2.1.2).
inline constexpr std::uint32_t kSetAlias = 0x2000;
inline constexpr std::uint32_t kClearAlias = 0x3000;
inline void raise_bits(std::uint32_t address, std::uint32_t bits) { reg(address + kSetAlias) = bits; }
inline void lower_bits(std::uint32_t address, std::uint32_t bits) { reg(address + kClearAlias) = bits; }

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

// System information, 2.20.2.
inline constexpr std::uint32_t kChipId = 0x4000'0000;
inline constexpr std::uint32_t kChipRevisionShift = 28;  // 1 for B0 and B1, 2 for B2

// Crystal oscillator, 2.16.7.
inline constexpr std::uint32_t kXoscControl = 0x4002'4000;
inline constexpr std::uint32_t kXoscStatus = 0x4002'4004;
inline constexpr std::uint32_t kXoscStartup = 0x4002'400C;         // in units of 256 periods
inline constexpr std::uint32_t kXoscEnable1To15MHz = 0x00FA'BAA0;  // the two words that mean something
inline constexpr std::uint32_t kXoscStable = 1U << 31;

// PLLs, 2.18.4.
inline constexpr std::uint32_t kPllSys = 0x4002'8000;
inline constexpr std::uint32_t kPllUsb = 0x4002'C000;
inline constexpr std::uint32_t kPllControl = 0x0;  // reference divider; lock
inline constexpr std::uint32_t kPllPower = 0x4;
inline constexpr std::uint32_t kPllFeedback = 0x8;
inline constexpr std::uint32_t kPllPostDividers = 0xC;
inline constexpr std::uint32_t kPllLocked = 1U << 31;
inline constexpr std::uint32_t kPllDown = 1U << 0;
inline constexpr std::uint32_t kPllPostDividersDown = 1U << 3;
inline constexpr std::uint32_t kPllOscillatorDown = 1U << 5;
inline constexpr std::uint32_t kPllFirstShift = 16;
inline constexpr std::uint32_t kPllSecondShift = 12;

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
inline constexpr std::uint32_t kClockSysResuscitate = 0x4000'8078;  // what to do when it stops
inline constexpr std::uint32_t kSysFromReference = 0;
inline constexpr std::uint32_t kUndivided = 1U << 8;
inline constexpr std::uint32_t kRefFromCrystal = 2;
inline constexpr std::uint32_t kSysFromAuxiliary = 1;  // which is PLL_SYS after reset
inline constexpr std::uint32_t kClockEnable = 1U << 11;

// Power-on state machine, 2.13.5: what a watchdog reset resets.
inline constexpr std::uint32_t kPowerWatchdogSelect = 0x4001'0008;
inline constexpr std::uint32_t kAllButOscillators = 0x1'FFFC;

// Why the chip was reset, 2.12.8.
inline constexpr std::uint32_t kChipReset = 0x4006'4008;
inline constexpr std::uint32_t kResetByPower = 1U << 8;
inline constexpr std::uint32_t kResetByRunPin = 1U << 16;
inline constexpr std::uint32_t kResetByDebugger = 1U << 20;

// Watchdog, 4.7.6.
inline constexpr std::uint32_t kWatchdogControl = 0x4005'8000;
inline constexpr std::uint32_t kWatchdogLoad = 0x4005'8004;
inline constexpr std::uint32_t kWatchdogReason = 0x4005'8008;
inline constexpr std::uint32_t kWatchdogScratch = 0x4005'800C;  // eight words; the boot ROM uses 4 to 7 (2.8.1.1)
inline constexpr std::uint32_t kWatchdogTick = 0x4005'802C;
inline constexpr std::uint32_t kWatchdogEnable = 1U << 30;
inline constexpr std::uint32_t kWatchdogTrigger = 1U << 31;
inline constexpr std::uint32_t kWatchdogByTimer = 1U << 0;
inline constexpr std::uint32_t kTickEnable = 1U << 9;

// Timer, 4.6.5: microseconds in 64 bits.
inline constexpr std::uint32_t kTimerAlarm0 = 0x4005'4010;
inline constexpr std::uint32_t kTimerRawHigh = 0x4005'4024;
inline constexpr std::uint32_t kTimerRawLow = 0x4005'4028;
inline constexpr std::uint32_t kTimerDebugPause = 0x4005'402C;  // while a debugger holds a core; on after a reset
inline constexpr std::uint32_t kTimerInterrupts = 0x4005'4034;
inline constexpr std::uint32_t kTimerInterruptEnable = 0x4005'4038;

// Pins, 2.19.6.1 (functions, interrupts) and 2.19.6.3 (pads); single-cycle access 2.3.1.7.
inline constexpr std::uint32_t kPinControl = 0x4001'4004;          // 8 bytes a pin
inline constexpr std::uint32_t kPinInterrupts = 0x4001'40F0;       // four bits a pin, eight pins a word
inline constexpr std::uint32_t kPinInterruptEnable = 0x4001'4100;  // for core 0
inline constexpr std::uint32_t kPinInterruptStatus = 0x4001'4120;
inline constexpr std::uint32_t kPinEdges = 0xC;           // falling, rising
inline constexpr std::uint32_t kPad = 0x4001'C004;        // 4 bytes a pin
inline constexpr std::uint32_t kPadInputPulledUp = 0x5A;  // input on, 4 mA, pull-up, Schmitt trigger
inline constexpr std::uint32_t kPadInputPulledDown = 0x56;
inline constexpr std::uint32_t kFunctionUart = 2;  // 2.19.2
inline constexpr std::uint32_t kFunctionI2c = 3;
inline constexpr std::uint32_t kFunctionPwm = 4;
inline constexpr std::uint32_t kFunctionSoftware = 5;
inline constexpr std::uint32_t kSioIn = 0xD000'0004;
inline constexpr std::uint32_t kSioOutSet = 0xD000'0014;
inline constexpr std::uint32_t kSioOutClear = 0xD000'0018;
inline constexpr std::uint32_t kSioDriveSet = 0xD000'0024;
inline constexpr std::uint32_t kSioDriveClear = 0xD000'0028;

// Pulse-width modulation, 4.5.3: eight slices of two channels; of pin n, slice n / 2 modulo 8, channel n modulo 2
// (4.5.2).
inline constexpr std::uint32_t kPwm = 0x4005'0000;
inline constexpr std::uint32_t kPwmSlice = 0x14;  // from one to the next
inline constexpr std::uint32_t kPwmControl = 0x00;
inline constexpr std::uint32_t kPwmDivider = 0x04;  // in 16ths
inline constexpr std::uint32_t kPwmLevels = 0x0C;   // of channel A, of B in the upper half
inline constexpr std::uint32_t kPwmWrap = 0x10;
inline constexpr std::uint32_t kPwmEnable = 1U << 0;

// Serial lines, 4.2.8 (ARM PL011).
inline constexpr std::uint32_t kUart0 = 0x4003'4000;
inline constexpr std::uint32_t kUart1 = 0x4003'8000;
inline constexpr std::uint32_t kUartData = 0x00;
inline constexpr std::uint32_t kUartFlags = 0x18;
inline constexpr std::uint32_t kUartWholeDivisor = 0x24;
inline constexpr std::uint32_t kUartFraction = 0x28;
inline constexpr std::uint32_t kUartLine = 0x2C;
inline constexpr std::uint32_t kUartControl = 0x30;
inline constexpr std::uint32_t kUartInterruptEnable = 0x38;
inline constexpr std::uint32_t kUartDataFaults = 0xFU << 8;  // framing, parity, break, overrun
inline constexpr std::uint32_t kUartDataDamaged = 0x7U << 8;
inline constexpr std::uint32_t kUartNothingReceived = 1U << 4;
inline constexpr std::uint32_t kUartSendFull = 1U << 5;
inline constexpr std::uint32_t kUartEightBits = 3U << 5;
inline constexpr std::uint32_t kUartFifos = 1U << 4;
inline constexpr std::uint32_t kUartOn = (1U << 0) | (1U << 8) | (1U << 9);     // itself, sending, receiving
inline constexpr std::uint32_t kUartReceiveInterrupts = (1U << 4) | (1U << 6);  // half full; quiet for 32 bits
inline constexpr std::uint32_t kUartSendInterrupt = 1U << 5;

// I2C master, 4.3.17.
inline constexpr std::uint32_t kI2c0 = 0x4004'4000;
inline constexpr std::uint32_t kI2c1 = 0x4004'8000;
inline constexpr std::uint32_t kI2cControl = 0x00;
inline constexpr std::uint32_t kI2cTarget = 0x04;
inline constexpr std::uint32_t kI2cData = 0x10;
inline constexpr std::uint32_t kI2cHighPeriod = 0x1C;
inline constexpr std::uint32_t kI2cLowPeriod = 0x20;
inline constexpr std::uint32_t kI2cInterruptStatus = 0x2C;
inline constexpr std::uint32_t kI2cInterruptEnable = 0x30;
inline constexpr std::uint32_t kI2cReceiveThreshold = 0x38;
inline constexpr std::uint32_t kI2cSendThreshold = 0x3C;
inline constexpr std::uint32_t kI2cClearInterrupts = 0x40;
inline constexpr std::uint32_t kI2cClearAbort = 0x54;
inline constexpr std::uint32_t kI2cClearStop = 0x60;
inline constexpr std::uint32_t kI2cEnable = 0x6C;
inline constexpr std::uint32_t kI2cSendLevel = 0x74;
inline constexpr std::uint32_t kI2cReceiveLevel = 0x78;
inline constexpr std::uint32_t kI2cDataHold = 0x7C;
inline constexpr std::uint32_t kI2cSpikeLength = 0xA0;
inline constexpr std::uint32_t kI2cFifo = 16;
inline constexpr std::uint32_t kI2cMaster = 0x65;  // master, fast mode, 7 bits, restarts, no slave
inline constexpr std::uint32_t kI2cReceived = 1U << 2;
inline constexpr std::uint32_t kI2cSendEmpty = 1U << 4;
inline constexpr std::uint32_t kI2cAborted = 1U << 6;
inline constexpr std::uint32_t kI2cStopped = 1U << 9;
inline constexpr std::uint32_t kI2cRead = 1U << 8;
inline constexpr std::uint32_t kI2cStop = 1U << 9;
inline constexpr std::uint32_t kI2cRestart = 1U << 10;

// USB device: memory 4.1.2.5, registers 4.1.4.
inline constexpr std::uint32_t kUsbMemory = 0x5010'0000;
inline constexpr std::uint32_t kUsbMemorySize = 0x1000;
inline constexpr std::uint32_t kUsbEndpointControl = kUsbMemory + 0x08;  // from 1 in, 1 out, 2 in, ...
inline constexpr std::uint32_t kUsbBufferControl = kUsbMemory + 0x80;    // from 0 in, 0 out, 1 in, ...
inline constexpr std::uint32_t kUsbAddress = 0x5011'0000;
inline constexpr std::uint32_t kUsbControl = 0x5011'0040;
inline constexpr std::uint32_t kUsbFrame = 0x5011'0048;  // its number; reading it clears the interrupt
inline constexpr std::uint32_t kUsbSieControl = 0x5011'004C;
inline constexpr std::uint32_t kUsbSieStatus = 0x5011'0050;
inline constexpr std::uint32_t kUsbBufferStatus = 0x5011'0058;
inline constexpr std::uint32_t kUsbAbort = 0x5011'0060;
inline constexpr std::uint32_t kUsbAborted = 0x5011'0064;
inline constexpr std::uint32_t kUsbStallArm = 0x5011'0068;
inline constexpr std::uint32_t kUsbMux = 0x5011'0074;
inline constexpr std::uint32_t kUsbPower = 0x5011'0078;
inline constexpr std::uint32_t kUsbInterruptEnable = 0x5011'0090;
inline constexpr std::uint32_t kUsbInterruptStatus = 0x5011'0098;
inline constexpr std::uint32_t kUsbControllerOn = 1U << 0;
inline constexpr std::uint32_t kUsbToPhy = (1U << 0) | (1U << 3);
inline constexpr std::uint32_t kUsbForcePowered = (1U << 2) | (1U << 3);  // the board does not wire VBUS to a pin
inline constexpr std::uint32_t kUsbTellEachEp0Buffer = 1U << 29;
inline constexpr std::uint32_t kUsbPullUp = 1U << 16;
inline constexpr std::uint32_t kUsbSuspended = 1U << 4;  // in the status
inline constexpr std::uint32_t kUsbResumed = 1U << 11;
inline constexpr std::uint32_t kUsbSetupReceived = 1U << 17;
inline constexpr std::uint32_t kUsbBusReset = 1U << 19;
inline constexpr std::uint32_t kUsbTellBuffers = 1U << 4;  // in the interrupts
inline constexpr std::uint32_t kUsbTellBusReset = 1U << 12;
inline constexpr std::uint32_t kUsbTellSuspend = 1U << 14;
inline constexpr std::uint32_t kUsbTellResume = 1U << 15;
inline constexpr std::uint32_t kUsbTellSetup = 1U << 16;
inline constexpr std::uint32_t kUsbTellFrame = 1U << 17;
inline constexpr std::uint32_t kEndpointOn = 1U << 31;
inline constexpr std::uint32_t kEndpointTellEach = 1U << 29;
inline constexpr std::uint32_t kEndpointBulk = 2U << 26;
inline constexpr std::uint32_t kEndpointInterrupt = 3U << 26;
inline constexpr std::uint32_t kBufferAvailable = 1U << 10;  // last of all, after some cycles (4.1.2.5.1)
inline constexpr std::uint32_t kBufferStall = 1U << 11;
inline constexpr std::uint32_t kBufferData1 = 1U << 13;
inline constexpr std::uint32_t kBufferFull = 1U << 15;
inline constexpr std::uint32_t kBufferLength = 0x3FF;

// Boot ROM, 2.8.3: where it says what it is, and where its functions are.
inline constexpr std::uint32_t kRomMagic = 0x10;          // 'M', 'u', 1, version
inline constexpr std::uint32_t kRomFunctionTable = 0x14;  // 16 bits
inline constexpr std::uint32_t kRomLookUp = 0x18;         // 16 bits
inline constexpr std::uint32_t kFlashBase = 0x1000'0000;  // 2.6.3

// Interrupt numbers, 2.3.2.
inline constexpr std::uint32_t kInterruptTimer0 = 0;
inline constexpr std::uint32_t kInterruptUsb = 5;
inline constexpr std::uint32_t kInterruptPins = 13;
inline constexpr std::uint32_t kInterruptUart0 = 20;
inline constexpr std::uint32_t kInterruptUart1 = 21;
inline constexpr std::uint32_t kInterruptI2c0 = 23;
inline constexpr std::uint32_t kInterruptI2c1 = 24;

/// A peripheral comes out of reset; bounded, it takes some cycles.
inline void bring_up(std::uint32_t peripherals) {
  raise_bits(kResets, peripherals);
  lower_bits(kResets, peripherals);
  static_cast<void>(await_bits(kResetsDone, peripherals, 10'000));
}

}  // namespace fencepost::mcu::rp2040
