// Registers of QEMU's machine mps2-an386, by Arm's Application Note AN386 and the Cortex-M System Design Kit (DDI
// 0479).
#pragma once

#include <cstdint>

namespace fencepost::test::mps2 {

inline constexpr std::uint32_t kCoreHz = 25'000'000;

// Serial line 0, DDI 0479 3.3.
inline constexpr std::uint32_t kUart = 0x4000'4000;
inline constexpr std::uint32_t kUartData = kUart + 0x00;
inline constexpr std::uint32_t kUartState = kUart + 0x04;
inline constexpr std::uint32_t kUartControl = kUart + 0x08;
inline constexpr std::uint32_t kUartInterrupts = kUart + 0x0C;  // a bit is cleared by writing it
inline constexpr std::uint32_t kUartDivider = kUart + 0x10;
inline constexpr std::uint32_t kUartSendFull = 1U << 0;  // in the state
inline constexpr std::uint32_t kUartReceiveFull = 1U << 1;
inline constexpr std::uint32_t kUartOn = 0xF;  // both ways, with interrupts
inline constexpr std::uint32_t kUartSent = 1U << 0;
inline constexpr std::uint32_t kUartReceived = 1U << 1;
inline constexpr std::uint32_t kInterruptReceived = 0;
inline constexpr std::uint32_t kInterruptSent = 1;

// The board's own registers, AN386 4.5.
inline constexpr std::uint32_t kLights = 0x4002'8000;
inline constexpr std::uint32_t kCounter = 0x4002'8018;
inline constexpr std::uint32_t kCounterDivider = 0x4002'801C;

}  // namespace fencepost::test::mps2
