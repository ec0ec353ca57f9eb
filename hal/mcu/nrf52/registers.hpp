// Registers of the nRF52833 that the nRF51822 does not have. Source: nRF52833 Product Specification v1.5, chapters by
// their names; addresses: its memory map. All others are those of hal/mcu/nrf51/registers.hpp. This part has the serial
// line, the I2C master, timer, watchdog, flash controller and pins of the older one as well, at the same addresses. Its
// manual calls UART and TWI deprecated.
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/registers.hpp"

namespace fencepost::mcu::nrf52 {

inline constexpr std::uint32_t kFlashPage = 4096;  // bytes (Memory)

// Supply watch, POWER.

inline constexpr std::uint32_t kSupplyFell = nrf51::kPower + 0x108;   // POFWARN, event
inline constexpr std::uint32_t kSupplyWatch = nrf51::kPower + 0x510;  // POFCON
inline constexpr std::uint32_t kWatchSupply = 1U << 0;
inline constexpr std::uint32_t kSupplyAbove2V1 = 8U << 1;

// Flash controller, NVMC: a cache of instructions, off after a reset.

inline constexpr std::uint32_t kInstructionCache = nrf51::kFlash + 0x540;
inline constexpr std::uint32_t kCacheOn = 1U << 0;

// Timer.

inline constexpr std::uint32_t kTimerStop = nrf51::kTimer + 0x004;
inline constexpr std::uint32_t kTimerClear = nrf51::kTimer + 0x00C;
inline constexpr std::uint32_t kTimerInterruptsOff = nrf51::kTimer + 0x308;

// Serial line and I2C master: while they are on, their pins must not be chosen (UART, TWI: registers PSEL).

inline constexpr std::uint32_t kUartInterruptsOff = nrf51::kUart + 0x308;
inline constexpr std::uint32_t kUartOff = 0;

// Configuration that the part reads from its flash before it starts (UICR): the pin that resets it, in two equal words.

inline constexpr std::uint32_t kResetPin0 = 0x1000'1200;
inline constexpr std::uint32_t kResetPin1 = 0x1000'1204;
inline constexpr std::uint32_t kErased = 0xFFFF'FFFF;

// Second serial line, UARTE.

inline constexpr std::uint32_t kLine = 0x4002'8000;
inline constexpr std::uint32_t kLineStartReceiving = kLine + 0x000;
inline constexpr std::uint32_t kLineStopReceiving = kLine + 0x004;
inline constexpr std::uint32_t kLineStartSending = kLine + 0x008;
inline constexpr std::uint32_t kLineStopSending = kLine + 0x00C;
inline constexpr std::uint32_t kLineReceived = kLine + 0x110;  // event: as many bytes as asked for are in memory
inline constexpr std::uint32_t kLineSent = kLine + 0x120;      // event: the last of the bytes has gone out
inline constexpr std::uint32_t kLineError = kLine + 0x124;     // event
inline constexpr std::uint32_t kLineReceivingStopped = kLine + 0x144;  // event
inline constexpr std::uint32_t kLineSendingStopped = kLine + 0x158;    // event
inline constexpr std::uint32_t kLineShorts = kLine + 0x200;
inline constexpr std::uint32_t kLineInterrupts = kLine + 0x304;
inline constexpr std::uint32_t kLineInterruptsOff = kLine + 0x308;
inline constexpr std::uint32_t kLineReceivedInterrupt = 1U << 4;
inline constexpr std::uint32_t kLineSentInterrupt = 1U << 8;
inline constexpr std::uint32_t kLineErrorInterrupt = 1U << 9;
inline constexpr std::uint32_t kLineErrorSource = kLine + 0x480;  // a bit is cleared by writing it
inline constexpr std::uint32_t kLineErrors = 0xF;                 // overrun, parity, framing, break
inline constexpr std::uint32_t kLineEnable = kLine + 0x500;
inline constexpr std::uint32_t kLineEnabled = 8;
inline constexpr std::uint32_t kLinePinSend = kLine + 0x50C;
inline constexpr std::uint32_t kLinePinReceive = kLine + 0x514;
inline constexpr std::uint32_t kLineBaud = kLine + 0x524;
inline constexpr std::uint32_t kLineBaud9600 = 0x0027'5000;
inline constexpr std::uint32_t kLineBaud19200 = 0x004E'A000;
inline constexpr std::uint32_t kLineBaud38400 = 0x009D'0000;
inline constexpr std::uint32_t kLineBaud57600 = 0x00EB'0000;
inline constexpr std::uint32_t kLineBaud115200 = 0x01D6'0000;
inline constexpr std::uint32_t kLineBaud921600 = 0x0F00'0000;    // 941,176 in fact
inline constexpr std::uint32_t kLineReceivesTo = kLine + 0x534;  // an address
inline constexpr std::uint32_t kLineReceivesBytes = kLine + 0x538;
inline constexpr std::uint32_t kLineSendsFrom = kLine + 0x544;
inline constexpr std::uint32_t kLineSendsBytes = kLine + 0x548;
inline constexpr std::uint32_t kLineFormat = kLine + 0x56C;  // 0: 8N1, no flow control

// Edges of pins, GPIOTE: eight channels, four bytes apart.

inline constexpr std::uint32_t kEdges = 0x4000'6000;
inline constexpr std::uint32_t kEdgeSeen = kEdges + 0x100;  // events
inline constexpr std::uint32_t kEdgeInterrupts = kEdges + 0x304;
inline constexpr std::uint32_t kEdgeInterruptsOff = kEdges + 0x308;
inline constexpr std::uint32_t kEdgeChannel = kEdges + 0x510;
inline constexpr std::uint32_t kEdgeEvents = 1U << 0;
inline constexpr unsigned kEdgePinPlace = 8;  // its number, of both ports, is from this bit on
inline constexpr std::uint32_t kEdgeBoth = 3U << 16;
static_assert(nrf51::interrupt_of(kLine) == 40 && nrf51::interrupt_of(kEdges) == 6,
              "as the interrupts' table has them");

}  // namespace fencepost::mcu::nrf52
