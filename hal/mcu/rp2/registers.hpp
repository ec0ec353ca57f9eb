// Registers that the RP2040 and the RP2350 have alike: offsets, bits, the USB controller. Source: RP2040 Datasheet
// (Raspberry Pi Ltd), sections as given; the RP2350's has the same in its chapters 8, 9 and 12. Where they differ: the
// parts' own registers.hpp.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"

namespace fencepost::mcu::rp2 {

// Each register of a peripheral is there four times. A write to these two copies changes only the bits that are set in
// it, in one access (2.1.2).

inline constexpr std::uint32_t kSetAlias = 0x2000;
inline constexpr std::uint32_t kClearAlias = 0x3000;
inline void raise_bits(std::uint32_t address, std::uint32_t bits) { reg(address + kSetAlias) = bits; }
inline void lower_bits(std::uint32_t address, std::uint32_t bits) { reg(address + kClearAlias) = bits; }

// System information, 2.20.2.

inline constexpr std::uint32_t kChipId = 0x4000'0000;
inline constexpr std::uint32_t kChipRevisionShift = 28;  // RP2040: 1 for B0 and B1, 2 for B2; RP2350: 2 for A2

// Crystal oscillator, 2.16.7.

inline constexpr std::uint32_t kXoscEnable1To15MHz = 0x00FA'BAA0;  // the two words that mean something
inline constexpr std::uint32_t kXoscStable = 1U << 31;

// PLLs, 2.18.4.

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

inline constexpr std::uint32_t kSysFromReference = 0;
inline constexpr std::uint32_t kRefFromCrystal = 2;
inline constexpr std::uint32_t kSysFromAuxiliary = 1;  // the first of which is PLL_SYS
inline constexpr std::uint32_t kClockEnable = 1U << 11;

// Watchdog, 4.7.6.

inline constexpr std::uint32_t kWatchdogEnable = 1U << 30;
inline constexpr std::uint32_t kWatchdogTrigger = 1U << 31;
inline constexpr std::uint32_t kWatchdogByTimer = 1U << 0;

// Pins, 2.19.6.1 (functions, interrupts) and 2.19.6.3 (pads).

inline constexpr std::uint32_t kPinEdges = 0xC;           // falling, rising
inline constexpr std::uint32_t kPadInputPulledUp = 0x5A;  // input on, 4 mA, pull-up, Schmitt trigger
inline constexpr std::uint32_t kPadOutput = 0x16;         // input off, 4 mA, pull-down, Schmitt trigger
inline constexpr std::uint32_t kFunctionUart = 2;         // 2.19.2
inline constexpr std::uint32_t kFunctionI2c = 3;
inline constexpr std::uint32_t kFunctionPwm = 4;
inline constexpr std::uint32_t kFunctionSoftware = 5;

// Pulse-width modulation, 4.5.3: slices of two channels; of pin n, channel n modulo 2 (4.5.2).

inline constexpr std::uint32_t kPwmSlice = 0x14;  // from one to the next
inline constexpr std::uint32_t kPwmControl = 0x00;
inline constexpr std::uint32_t kPwmDivider = 0x04;  // in 16ths
inline constexpr std::uint32_t kPwmLevels = 0x0C;   // of channel A, of B in the upper half
inline constexpr std::uint32_t kPwmWrap = 0x10;
inline constexpr std::uint32_t kPwmEnable = 1U << 0;

// Serial lines, 4.2.8 (ARM PL011).

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

// Memory map, 2.2.

inline constexpr std::uint32_t kFlashBase = 0x1000'0000;  // 2.6.3

}  // namespace fencepost::mcu::rp2
