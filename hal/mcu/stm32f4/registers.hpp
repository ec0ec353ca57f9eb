// Registers of the STM32F405. Sources: RM0090 rev 19 (reference manual), sections as given; memory map 2.3.
#pragma once

#include <cstdint>

namespace fencepost::mcu::stm32f4 {

// Reset and clock control, RM0090 7.3 (registers: 7.3.24).
inline constexpr std::uint32_t kRcc = 0x4002'3800;
inline constexpr std::uint32_t kRccControl = kRcc + 0x00;     // 7.3.1
inline constexpr std::uint32_t kRccPll = kRcc + 0x04;         // 7.3.2
inline constexpr std::uint32_t kRccConfig = kRcc + 0x08;      // 7.3.3
inline constexpr std::uint32_t kRccInterrupts = kRcc + 0x0C;  // 7.3.4
inline constexpr std::uint32_t kRccAhb1Reset = kRcc + 0x10;   // 7.3.5
inline constexpr std::uint32_t kRccAhb2Reset = kRcc + 0x14;   // 7.3.6
inline constexpr std::uint32_t kRccApb1Reset = kRcc + 0x20;   // 7.3.8
inline constexpr std::uint32_t kRccApb2Reset = kRcc + 0x24;   // 7.3.9
inline constexpr std::uint32_t kRccAhb1Enable = kRcc + 0x30;  // 7.3.10, ports A..I are bits 0..8
inline constexpr std::uint32_t kRccApb1Enable = kRcc + 0x40;  // 7.3.13
inline constexpr std::uint32_t kRccApb2Enable = kRcc + 0x44;  // 7.3.14
inline constexpr std::uint32_t kRccStatus = kRcc + 0x74;      // 7.3.21: why it was reset
inline constexpr std::uint32_t kHsiOn = 1U << 0;
inline constexpr std::uint32_t kHsiReady = 1U << 1;
inline constexpr std::uint32_t kHseOn = 1U << 16;
inline constexpr std::uint32_t kHseReady = 1U << 17;
inline constexpr std::uint32_t kHseBypass = 1U << 18;
inline constexpr std::uint32_t kWatchHse = 1U << 19;  // the clock security system
inline constexpr std::uint32_t kPllOn = 1U << 24;
inline constexpr std::uint32_t kPllReady = 1U << 25;
inline constexpr std::uint32_t kAudioPllOn = 1U << 26;
inline constexpr std::uint32_t kPllFromCrystal = 1U << 22;          // in kRccPll
inline constexpr std::uint32_t kRccForgetInterrupts = 0x00BF'0000;  // all off, their flags cleared
inline constexpr std::uint32_t kCrystalDividedBy31 = 31U << 16;     // in kRccConfig, for the real-time clock
inline constexpr std::uint32_t kSwitchMask = 0x3;
inline constexpr std::uint32_t kSwitchToPll = 0x2;
inline constexpr std::uint32_t kSwitchedMask = 0x3U << 2;
inline constexpr std::uint32_t kSwitchedToPll = 0x2U << 2;
inline constexpr std::uint32_t kApb1DividedBy4 = 0x5U << 10;
inline constexpr std::uint32_t kApb2DividedBy2 = 0x4U << 13;
inline constexpr std::uint32_t kTimer2Clock = 1U << 0;  // in kRccApb1Enable
inline constexpr std::uint32_t kTimer3Clock = 1U << 1;
inline constexpr std::uint32_t kTimer4Clock = 1U << 2;
inline constexpr std::uint32_t kTimer5Clock = 1U << 3;
inline constexpr std::uint32_t kUsart2Clock = 1U << 17;
inline constexpr std::uint32_t kUsart3Clock = 1U << 18;
inline constexpr std::uint32_t kUart4Clock = 1U << 19;
inline constexpr std::uint32_t kPowerClock = 1U << 28;
inline constexpr std::uint32_t kUsart1Clock = 1U << 4;  // in kRccApb2Enable
inline constexpr std::uint32_t kUsart6Clock = 1U << 5;
inline constexpr std::uint32_t kTimer11Clock = 1U << 18;
inline constexpr std::uint32_t kForgetResets = 1U << 24;
inline constexpr std::uint32_t kResetByBrownOut = 1U << 25;
inline constexpr std::uint32_t kResetByPin = 1U << 26;
inline constexpr std::uint32_t kResetByPower = 1U << 27;
inline constexpr std::uint32_t kResetBySoftware = 1U << 28;
inline constexpr std::uint32_t kResetByWatchdog = 1U << 29;        // independent
inline constexpr std::uint32_t kResetByWindowWatchdog = 1U << 30;  // not used here

// Flash interface, RM0090 3.9.
inline constexpr std::uint32_t kFlashAccess = 0x4002'3C00;           // 3.9.1
inline constexpr std::uint32_t kFlashKey = kFlashAccess + 0x04;      // 3.9.2
inline constexpr std::uint32_t kFlashStatus = kFlashAccess + 0x0C;   // 3.9.4
inline constexpr std::uint32_t kFlashControl = kFlashAccess + 0x10;  // 3.9.5
inline constexpr std::uint32_t kFlashKey1 = 0x4567'0123;             // 3.6.1
inline constexpr std::uint32_t kFlashKey2 = 0xCDEF'89AB;
inline constexpr std::uint32_t kFlashBusy = 1U << 16;
inline constexpr std::uint32_t kFlashErrors = 0xF2;  // operation, write protection, alignment, parallelism, sequence
inline constexpr std::uint32_t kFlashProgram = 1U << 0;
inline constexpr std::uint32_t kFlashErase = 1U << 1;
inline constexpr std::uint32_t kFlashSectorShift = 3;
inline constexpr std::uint32_t kFlashByWords = 0x2U << 8;  // 32 bits a time: 2.7 to 3.6 V
inline constexpr std::uint32_t kFlashStart = 1U << 16;
inline constexpr std::uint32_t kFlashLock = 1U << 31;
inline constexpr std::uint32_t kFlashWaitMask = 0x7;
// 5 wait states at 168 MHz and 2.7 to 3.6 V (table 10), prefetch and both caches.
inline constexpr std::uint32_t kFlashAt168MHz = 5U | (1U << 8) | (1U << 9) | (1U << 10);

// Ports, RM0090 8.4: 0x400 bytes each.

inline constexpr std::uint32_t kPortA = 0x4002'0000;
inline constexpr std::uint32_t kPortStride = 0x400;
inline constexpr std::uint32_t kPortMode = 0x00;      // 8.4.1, two bits a pin
inline constexpr std::uint32_t kPortOpen = 0x04;      // 8.4.2: drives low only
inline constexpr std::uint32_t kPortPull = 0x0C;      // 8.4.4, two bits a pin
inline constexpr std::uint32_t kPortInput = 0x10;     // 8.4.5
inline constexpr std::uint32_t kPortSet = 0x18;       // 8.4.7, lower half sets, upper half clears
inline constexpr std::uint32_t kPortFunction = 0x20;  // 8.4.9 and 8.4.10, four bits a pin, eight pins a word
inline constexpr std::uint32_t kModeOutput = 1;
inline constexpr std::uint32_t kModeAlternate = 2;
inline constexpr std::uint32_t kPullUp = 1;

// Serial lines, RM0090 30.6.

inline constexpr std::uint32_t kUsart1 = 0x4001'1000;
inline constexpr std::uint32_t kUsart2 = 0x4000'4400;
inline constexpr std::uint32_t kUsart3 = 0x4000'4800;
inline constexpr std::uint32_t kUart4 = 0x4000'4C00;
inline constexpr std::uint32_t kUsart6 = 0x4001'1400;
inline constexpr std::uint32_t kUsartStatus = 0x00;   // 30.6.1
inline constexpr std::uint32_t kUsartData = 0x04;     // 30.6.2
inline constexpr std::uint32_t kUsartBaud = 0x08;     // 30.6.3: clock divided by baud, at 16-fold oversampling
inline constexpr std::uint32_t kUsartControl = 0x0C;  // 30.6.4, CR1
inline constexpr std::uint32_t kUsartFaults = 0xE;    // framing, noise, overrun
inline constexpr std::uint32_t kUsartReceived = 1U << 5;
inline constexpr std::uint32_t kUsartCanSend = 1U << 7;
inline constexpr std::uint32_t kUsartReceive = 1U << 2;
inline constexpr std::uint32_t kUsartSend = 1U << 3;
inline constexpr std::uint32_t kUsartReceiveInterrupt = 1U << 5;
inline constexpr std::uint32_t kUsartSendInterrupt = 1U << 7;
inline constexpr std::uint32_t kUsartEnable = 1U << 13;

// The I2C bus, RM0090 27.6.
inline constexpr std::uint32_t kI2c1 = 0x4000'5400;
inline constexpr std::uint32_t kI2c1Clock = 1U << 21;  // in kRccApb1Enable
inline constexpr std::uint32_t kI2cControl1 = 0x00;    // 27.6.1
inline constexpr std::uint32_t kI2cControl2 = 0x04;    // 27.6.2
inline constexpr std::uint32_t kI2cData = 0x10;        // 27.6.5
inline constexpr std::uint32_t kI2cStatus1 = 0x14;     // 27.6.6
inline constexpr std::uint32_t kI2cStatus2 = 0x18;     // 27.6.7
inline constexpr std::uint32_t kI2cClock = 0x1C;       // 27.6.8
inline constexpr std::uint32_t kI2cRise = 0x20;        // 27.6.9
inline constexpr std::uint32_t kI2cEnable = 1U << 0;   // control 1
inline constexpr std::uint32_t kI2cStart = 1U << 8;
inline constexpr std::uint32_t kI2cStop = 1U << 9;
inline constexpr std::uint32_t kI2cAcknowledge = 1U << 10;
inline constexpr std::uint32_t kI2cPosition = 1U << 11;  // the acknowledge is the next byte's
inline constexpr std::uint32_t kI2cReset = 1U << 15;
inline constexpr std::uint32_t kI2cErrorInterrupt = 1U << 8;  // control 2
inline constexpr std::uint32_t kI2cEventInterrupt = 1U << 9;
inline constexpr std::uint32_t kI2cBufferInterrupt = 1U << 10;
inline constexpr std::uint32_t kI2cStarted = 1U << 0;  // status 1
inline constexpr std::uint32_t kI2cAddressed = 1U << 1;
inline constexpr std::uint32_t kI2cByteFinished = 1U << 2;
inline constexpr std::uint32_t kI2cReceived = 1U << 6;
inline constexpr std::uint32_t kI2cNoAcknowledge = 1U << 10;
inline constexpr std::uint32_t kI2cErrors = 0xF00;  // bus, arbitration, acknowledge, overrun
inline constexpr std::uint32_t kI2cBusError = 1U << 8;
inline constexpr std::uint32_t kI2cBusy = 1U << 1;  // status 2

// Timers, RM0090 18.4 (2 to 5) and 19.5 (11); as quadrature decoders 18.3.12.

inline constexpr std::uint32_t kTimer2 = 0x4000'0000;
inline constexpr std::uint32_t kTimer3 = 0x4000'0400;
inline constexpr std::uint32_t kTimer4 = 0x4000'0800;
inline constexpr std::uint32_t kTimer5 = 0x4000'0C00;
inline constexpr std::uint32_t kTimer11 = 0x4001'4800;
inline constexpr std::uint32_t kTimerControl = 0x00;    // 18.4.1
inline constexpr std::uint32_t kTimerSlaveMode = 0x08;  // 18.4.3
inline constexpr std::uint32_t kTimerStatus = 0x10;     // 18.4.5
inline constexpr std::uint32_t kTimerEvent = 0x14;      // 18.4.6
inline constexpr std::uint32_t kTimerInputs = 0x18;     // 18.4.7
inline constexpr std::uint32_t kTimerPolarity = 0x20;   // 18.4.9
inline constexpr std::uint32_t kTimerCount = 0x24;      // 18.4.10
inline constexpr std::uint32_t kTimerPrescaler = 0x28;  // 18.4.11
inline constexpr std::uint32_t kTimerReload = 0x2C;     // 18.4.12
inline constexpr std::uint32_t kTimerCapture1 = 0x34;   // 18.4.13
inline constexpr std::uint32_t kTimerOption = 0x50;     // 19.5.11, of timer 11
inline constexpr std::uint32_t kTimerUpdate = 1U << 0;  // in the event register
inline constexpr std::uint32_t kTimer11SeesCrystal = 0x2;
inline constexpr std::uint32_t kCaptureEvery8 = 0xD;  // input 1 on channel 1, every eighth edge
inline constexpr std::uint32_t kCaptureOn = 1U << 0;
inline constexpr std::uint32_t kCaptured = 1U << 1;      // in the status
inline constexpr std::uint32_t kEncoderBothEdges = 0x3;  // encoder mode 3: four counts a period
inline constexpr std::uint32_t kInputsFiltered =
    0x5151;  // IC1 on TI1, IC2 on TI2; an edge counts after 8 equal samples at half the clock
inline constexpr std::uint32_t kTimerEnable = 1U << 0;

// Independent watchdog, RM0090 21.4.
inline constexpr std::uint32_t kWatchdogKey = 0x4000'3000;        // 21.4.1
inline constexpr std::uint32_t kWatchdogPrescaler = 0x4000'3004;  // 21.4.2
inline constexpr std::uint32_t kWatchdogReload = 0x4000'3008;     // 21.4.3
inline constexpr std::uint32_t kWatchdogStatus = 0x4000'300C;     // 21.4.4
inline constexpr std::uint32_t kWatchdogReloadBusy = 1U << 1;
inline constexpr std::uint32_t kWatchdogUnlock = 0x5555;
inline constexpr std::uint32_t kWatchdogStart = 0xCCCC;
inline constexpr std::uint32_t kWatchdogFeed = 0xAAAA;
inline constexpr std::uint32_t kWatchdogBy64 = 4;

// Power, RM0090 5.4.
inline constexpr std::uint32_t kPowerControl = 0x4000'7000;  // 5.4.1
inline constexpr std::uint32_t kRegulatorScale1 = 1U << 14;  // needed above 144 MHz, and the reset value
inline constexpr std::uint32_t kWatchSupply = 1U << 4;
inline constexpr std::uint32_t kSupplyAbove2V7 = 5U << 5;
inline constexpr std::uint32_t kPowerStatus = 0x4000'7004;  // 5.4.2
inline constexpr std::uint32_t kSupplyBelow = 1U << 2;

// Interrupt numbers, RM0090 table 61.

inline constexpr std::uint32_t kInterruptI2c1Event = 31;
inline constexpr std::uint32_t kInterruptI2c1Error = 32;
inline constexpr std::uint32_t kInterruptUsart1 = 37;
inline constexpr std::uint32_t kInterruptUsart2 = 38;
inline constexpr std::uint32_t kInterruptUsart3 = 39;
inline constexpr std::uint32_t kInterruptUart4 = 52;
inline constexpr std::uint32_t kInterruptUsart6 = 71;

}  // namespace fencepost::mcu::stm32f4
