// Registers that every Cortex-M has. Sources: Armv6-M and Armv7-M Architecture Reference Manuals (DDI 0419, DDI 0403),
// sections B3.2 (system control), B3.3 (SysTick), B3.4 (NVIC).
#pragma once

#include <cstdint>

namespace fencepost::mcu::cortex_m {

inline constexpr std::uint32_t kSysTickControl = 0xE000E010;  // B3.3.3
inline constexpr std::uint32_t kSysTickReload = 0xE000E014;   // B3.3.4, 24 bits
inline constexpr std::uint32_t kSysTickCurrent = 0xE000E018;  // B3.3.5, a write clears it
inline constexpr std::uint32_t kSysTickEnable = 1U << 0;
inline constexpr std::uint32_t kSysTickInterrupt = 1U << 1;
inline constexpr std::uint32_t kSysTickCoreClock = 1U << 2;

inline constexpr std::uint32_t kNvicEnable = 0xE000E100;   // B3.4.4, a bit an interrupt, 32 a word
inline constexpr std::uint32_t kNvicDisable = 0xE000E180;  // B3.4.5
inline constexpr std::uint32_t kNvicForget = 0xE000E280;   // B3.4.7: no longer pending

inline constexpr std::uint32_t kInterruptControl = 0xE000ED04;  // ICSR, B3.2.4: active exception in bits 8..0
inline constexpr std::uint32_t kForgetCorePending = (1U << 25) | (1U << 27);  // SysTick's and PendSV's
inline constexpr std::uint32_t kVectorTable = 0xE000ED08;                     // VTOR, B3.2.5
inline constexpr std::uint32_t kResetControl = 0xE000ED0C;                    // AIRCR, B3.2.6
inline constexpr std::uint32_t kResetRequest = 0x05FA'0004;                   // the key and SYSRESETREQ

// Memory protection, Armv7-M B3.5, Armv6-M B3.5; parts without it read zeros.
inline constexpr std::uint32_t kProtectionType = 0xE000ED90;
inline constexpr std::uint32_t kProtectionRegions = 0xFFU << 8;  // how many it has
inline constexpr std::uint32_t kProtection = 0xE000ED94;         // MPU_CTRL
inline constexpr std::uint32_t kProtectionOn = 1U << 0;
inline constexpr std::uint32_t kElseAsWithout = 1U << 2;         // whatever is in no region may be used
inline constexpr std::uint32_t kProtectionBase = 0xE000ED9C;     // MPU_RBAR
inline constexpr std::uint32_t kProtectionFirst = 1U << 4;       // the address is region 0's
inline constexpr std::uint32_t kProtectionKind = 0xE000EDA0;     // MPU_RASR; nobody may use it, if it says no more
inline constexpr std::uint32_t kProtection256 = (7U << 1) | 1U;  // on, 256 bytes
inline constexpr std::uint32_t kProtectionEighthsOffShift = 8;   // of which these are left out
inline constexpr std::uint32_t kCoprocessorAccess = 0xE000ED88;  // CPACR, Armv7-M B3.2.20
inline constexpr std::uint32_t kFullFloatAccess = 0xFU << 20;    // CP10 and CP11

}  // namespace fencepost::mcu::cortex_m
