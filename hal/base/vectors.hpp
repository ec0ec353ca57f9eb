// Whether the processor handles several numbers at a time. Then it pays to do more of them, without branches and with
// room for what lies between; the bits are the same.
#pragma once

namespace fencepost::base {

#if defined(__SSE2__) || defined(__ARM_NEON)
inline constexpr bool kVectors = true;
#else
inline constexpr bool kVectors = false;
#endif

// Whether its vectors give the bits of single numbers even for the smallest ones. Those of 32-bit ARM do not, and
// compilers use them only on request.
#if defined(__SSE2__) || defined(__aarch64__)
inline constexpr bool kLaneVectors = true;
#else
inline constexpr bool kLaneVectors = false;
#endif

// Compiles a function for both kinds of a desk's processor; the program chooses when it starts: eight numbers at a time
// instead of four. Sanitizers are not ready so early.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(FENCEPOST_NO_CLONES)
#define FENCEPOST_FOR_EACH_PROCESSOR __attribute__((target_clones("avx2", "default")))
#else
#define FENCEPOST_FOR_EACH_PROCESSOR
#endif

}  // namespace fencepost::base
