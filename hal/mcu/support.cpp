// What the compiler and the C library expect of a system, so that neither brings a system along.
#include "hal/base/check.hpp"

extern "C" {
void abort();
// A path that cannot be taken, by the standard library.
[[noreturn]] void abort() { __builtin_trap(); }
// Destructors at exit: there is no exit.
void* __dso_handle = nullptr;  // NOLINT(bugprone-reserved-identifier)
}
