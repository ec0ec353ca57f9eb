// Whether the processor handles several numbers at a time. Then it pays to do more of them, without branches and with
// room for what lies between; the bits are the same.
#pragma once

namespace fencepost::base {

#if defined(__SSE2__) || defined(__ARM_NEON)
inline constexpr bool kVectors = true;
#else
inline constexpr bool kVectors = false;
#endif

}  // namespace fencepost::base
