// Registers of the nRF51822. Sources: nRF51 Series Reference Manual v3.0, chapters as given; addresses: its memory map.
// The nRF52833 has them, too, at the same addresses; what differs there is in hal/mcu/nrf52. A peripheral's interrupt
// has the number that its address has in bits 12 to 17 (chapter 10.1); this part's all have less than 32.
#pragma once

#include <cstdint>

namespace fencepost::mcu::nrf51 {

inline constexpr std::uint32_t kTrigger = 1;  ///< written to a task (10.1.4)

constexpr std::uint32_t interrupt_of(std::uint32_t peripheral) { return (peripheral >> 12) & 0x3FU; }

// Power and clock share an address; chapters 12 and 13.
inline constexpr std::uint32_t kPower = 0x4000'0000;
inline constexpr std::uint32_t kStartCrystal = kPower + 0x000;    // HFCLKSTART
inline constexpr std::uint32_t kCrystalStarted = kPower + 0x100;  // event
inline constexpr std::uint32_t kResetReason = kPower + 0x400;     // RESETREAS; a bit is cleared by writing it
inline constexpr std::uint32_t kResetByPin = 1U << 0;
inline constexpr std::uint32_t kResetByWatchdog = 1U << 1;
inline constexpr std::uint32_t kResetBySoftware = 1U << 2;
inline constexpr std::uint32_t kResetByLockup = 1U << 3;  // a fault within a fault's handler

// Serial line, chapter 29.

inline constexpr std::uint32_t kUart = 0x4000'2000;
inline constexpr std::uint32_t kUartStartReceiving = kUart + 0x000;
inline constexpr std::uint32_t kUartStartSending = kUart + 0x008;
inline constexpr std::uint32_t kUartReceived = kUart + 0x108;  // event: RXD has a byte
inline constexpr std::uint32_t kUartSent = kUart + 0x11C;      // event: TXD has gone out
inline constexpr std::uint32_t kUartError = kUart + 0x124;     // event
inline constexpr std::uint32_t kUartInterrupts = kUart + 0x304;
inline constexpr std::uint32_t kUartReceivedInterrupt = 1U << 2;
inline constexpr std::uint32_t kUartSentInterrupt = 1U << 7;
inline constexpr std::uint32_t kUartErrorInterrupt = 1U << 9;
inline constexpr std::uint32_t kUartErrorSource = kUart + 0x480;  // a bit is cleared by writing it
inline constexpr std::uint32_t kUartErrors = 0xF;                 // overrun, parity, framing, break
inline constexpr std::uint32_t kUartEnable = kUart + 0x500;
inline constexpr std::uint32_t kUartEnabled = 4;
inline constexpr std::uint32_t kUartPinSend = kUart + 0x50C;
inline constexpr std::uint32_t kUartPinReceive = kUart + 0x514;
inline constexpr std::uint32_t kUartRxd = kUart + 0x518;
inline constexpr std::uint32_t kUartTxd = kUart + 0x51C;
inline constexpr std::uint32_t kUartBaud = kUart + 0x524;

// I2C master, chapter 28: offsets, since there are two of them.

inline constexpr std::uint32_t kTwi0 = 0x4000'3000;
inline constexpr std::uint32_t kTwiStartReading = 0x000;
inline constexpr std::uint32_t kTwiStartWriting = 0x008;
inline constexpr std::uint32_t kTwiStop = 0x014;
inline constexpr std::uint32_t kTwiResume = 0x020;
inline constexpr std::uint32_t kTwiStopped = 0x104;   // event
inline constexpr std::uint32_t kTwiReceived = 0x108;  // event: RXD has a byte
inline constexpr std::uint32_t kTwiSent = 0x11C;      // event: TXD has gone out
inline constexpr std::uint32_t kTwiError = 0x124;     // event
inline constexpr std::uint32_t kTwiShorts = 0x200;
inline constexpr std::uint32_t kTwiSuspendAfterByte = 1U << 0;
inline constexpr std::uint32_t kTwiStopAfterByte = 1U << 1;
inline constexpr std::uint32_t kTwiInterruptsOn = 0x304;
inline constexpr std::uint32_t kTwiInterruptsOff = 0x308;
inline constexpr std::uint32_t kTwiStoppedInterrupt = 1U << 1;
inline constexpr std::uint32_t kTwiReceivedInterrupt = 1U << 2;
inline constexpr std::uint32_t kTwiSentInterrupt = 1U << 7;
inline constexpr std::uint32_t kTwiErrorInterrupt = 1U << 9;
inline constexpr std::uint32_t kTwiAllInterrupts =
    kTwiStoppedInterrupt | kTwiReceivedInterrupt | kTwiSentInterrupt | kTwiErrorInterrupt;
inline constexpr std::uint32_t kTwiErrorSource = 0x4C4;  // a bit is cleared by writing it
inline constexpr std::uint32_t kTwiErrors = 0x7;         // overrun, address or data not acknowledged
inline constexpr std::uint32_t kTwiEnable = 0x500;
inline constexpr std::uint32_t kTwiEnabled = 5;
inline constexpr std::uint32_t kTwiPinClock = 0x508;
inline constexpr std::uint32_t kTwiPinData = 0x50C;
inline constexpr std::uint32_t kTwiRxd = 0x518;
inline constexpr std::uint32_t kTwiTxd = 0x51C;
inline constexpr std::uint32_t kTwiFrequency = 0x524;
inline constexpr std::uint32_t kTwi100kHz = 0x0198'0000;
inline constexpr std::uint32_t kTwiAddress = 0x588;
inline constexpr std::uint32_t kTwiPower =
    0xFFC;  // of every peripheral, of this part alone; here by PAN 56 of the anomaly list

// Timer 0, the one of 32 bits, chapter 18.

inline constexpr std::uint32_t kTimer = 0x4000'8000;
inline constexpr std::uint32_t kTimerStart = kTimer + 0x000;
inline constexpr std::uint32_t kTimerCapture = kTimer + 0x040;  // four tasks, four bytes apart
inline constexpr std::uint32_t kTimerReached = kTimer + 0x140;  // four events, likewise
inline constexpr std::uint32_t kTimerInterrupts = kTimer + 0x304;
inline constexpr std::uint32_t kTimerReached0Interrupt = 1U << 16;
inline constexpr std::uint32_t kTimerBits = kTimer + 0x508;
inline constexpr std::uint32_t kTimer32Bits = 3;
inline constexpr std::uint32_t kTimerPrescaler = kTimer + 0x510;
inline constexpr std::uint32_t kTimer1MHz = 4;                  // 16 MHz / 2^4
inline constexpr std::uint32_t kTimerCompare = kTimer + 0x540;  // four, likewise

// Watchdog, chapter 20.

inline constexpr std::uint32_t kWatchdog = 0x4001'0000;
inline constexpr std::uint32_t kWatchdogStart = kWatchdog + 0x000;
inline constexpr std::uint32_t kWatchdogReload = kWatchdog + 0x504;  // of 32768 Hz, less one
inline constexpr std::uint32_t kWatchdogConfig = kWatchdog + 0x50C;
inline constexpr std::uint32_t kWatchdogWhileAsleep = 1U << 0;
inline constexpr std::uint32_t kWatchdogWhileHalted = 1U << 3;
inline constexpr std::uint32_t kWatchdogFeed = kWatchdog + 0x600;  // RR[0], the only one enabled after a reset
inline constexpr std::uint32_t kWatchdogFood = 0x6E52'4635;

// Flash controller, chapter 6.

inline constexpr std::uint32_t kFlash = 0x4001'E000;
inline constexpr std::uint32_t kFlashReady = kFlash + 0x400;
inline constexpr std::uint32_t kFlashConfig = kFlash + 0x504;
inline constexpr std::uint32_t kFlashReadOnly = 0;
inline constexpr std::uint32_t kFlashWrite = 1;
inline constexpr std::uint32_t kFlashErase = 2;
inline constexpr std::uint32_t kFlashErasePage = kFlash + 0x508;  // takes the page's address
inline constexpr std::uint32_t kFlashPage = 1024;                 // bytes (chapter 5.1)

// Pins, chapter 14.
inline constexpr std::uint32_t kPins = 0x5000'0000;
inline constexpr std::uint32_t kPinsStride = 0x300;  // to a second port, where there is one
inline constexpr std::uint32_t kPinsSet = kPins + 0x508;
inline constexpr std::uint32_t kPinsClear = kPins + 0x50C;
inline constexpr std::uint32_t kPinsIn = kPins + 0x510;
inline constexpr std::uint32_t kPinsConfig = kPins + 0x700;  // a word a pin
inline constexpr std::uint32_t kPinOutput = 1U << 0;
inline constexpr std::uint32_t kPinInputOff = 1U << 1;
inline constexpr std::uint32_t kPinPullUp = 3U << 2;
inline constexpr std::uint32_t kPinDrivesLowOnly = 6U << 8;  // S0D1: standard 0, disconnected 1

}  // namespace fencepost::mcu::nrf51
