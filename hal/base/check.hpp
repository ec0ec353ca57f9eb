// Our own assertion: traps, links nothing (the C library's assert() pulls in printf and malloc on small parts).
#pragma once

/// A broken invariant is a bug, not bad input: stop at once, in every build.
#define FENCEPOST_CHECK(condition)      \
  do {                                  \
    if (!(condition)) __builtin_trap(); \
  } while (false)
