// Symbols that the compiler and the C library expect of an operating system, so that neither links one in.
#include "hal/base/check.hpp"

extern "C" {
void abort();
// Unreachable, but referenced by the standard library.
[[noreturn]] void abort() { __builtin_trap(); }
// Destructors at exit: there is no exit.
void* __dso_handle = nullptr;  // NOLINT(bugprone-reserved-identifier)
}
