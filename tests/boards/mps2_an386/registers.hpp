// Registers of QEMU's machines mps2-an386 and mps2-an505, by Arm's Application Notes AN386 and AN505 and the Cortex-M
// System Design Kit (DDI 0479). The second has an Armv8-M core, which sees them in its secure state.
#pragma once

#include <cstdint>

namespace fencepost::test::mps2 {

#if __ARM_ARCH >= 8
inline constexpr std::uint32_t kCoreHz = 20'000'000;
inline constexpr std::uint32_t kUart = 0x5020'0000;      // the first; AN505 3.5
inline constexpr std::uint32_t kBoard = 0x5030'2000;     // its own registers
inline constexpr std::uint32_t kInterruptReceived = 32;  // of the first
#else
inline constexpr std::uint32_t kCoreHz = 25'000'000;
inline constexpr std::uint32_t kUart = 0x4000'4000;
inline constexpr std::uint32_t kBoard = 0x4002'8000;
inline constexpr std::uint32_t kInterruptReceived = 0;
#endif
inline constexpr std::uint32_t kNextUart = 0x1000;
inline constexpr std::uint32_t kNextInterrupt = 2;
inline constexpr std::uint32_t kSentAfterReceived = 1;  // its interrupt

// A serial line, DDI 0479 3.3.

inline constexpr std::uint32_t kUartData = 0x00;
inline constexpr std::uint32_t kUartState = 0x04;
inline constexpr std::uint32_t kUartControl = 0x08;
inline constexpr std::uint32_t kUartInterrupts = 0x0C;  // a bit is cleared by writing it
inline constexpr std::uint32_t kUartDivider = 0x10;
inline constexpr std::uint32_t kUartSendFull = 1U << 0;  // in the state
inline constexpr std::uint32_t kUartReceiveFull = 1U << 1;
inline constexpr std::uint32_t kUartOn = 0xF;  // both ways, with interrupts
inline constexpr std::uint32_t kUartSent = 1U << 0;
inline constexpr std::uint32_t kUartReceived = 1U << 1;

// The board's own registers, AN386 4.5.

inline constexpr std::uint32_t kLights = kBoard + 0x00;
inline constexpr std::uint32_t kCounter = kBoard + 0x18;
inline constexpr std::uint32_t kCounterDivider = kBoard + 0x1C;

}  // namespace fencepost::test::mps2
