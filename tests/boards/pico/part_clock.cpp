// Preloaded to a program that talks to an emulated part: its clock is the part's, however busy this machine is.
//
// The file that FENCEPOST_PART_CLOCK names has two doubles, in seconds. The first is when the last slice of the part's
// time was done, by the machine's monotonic clock. The second is how much of its time had passed then. Until the next
// one the clock goes on for a slice at most.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

constexpr double kSlice = 0.01;            // s
constexpr timespec kNap = {0, 1'000'000};  // between two looks at the clock

using GetTime = int (*)(clockid_t, timespec*);
using Sleep = int (*)(clockid_t, int, const timespec*, timespec*);

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

double seconds(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

const volatile double* shared() {
  static const volatile double* const kShared = [] {
    const char* path = std::getenv("FENCEPOST_PART_CLOCK");
    const int file = path != nullptr ? ::open(path, O_RDONLY | O_CLOEXEC) : -1;
    void* memory = file >= 0 ? ::mmap(nullptr, 2 * sizeof(double), PROT_READ, MAP_SHARED, file, 0) : MAP_FAILED;
    if (memory == MAP_FAILED) std::abort();
    return static_cast<const volatile double*>(memory);
  }();
  return kShared;
}

double now() {
  static const auto kGetTime = next<GetTime>("clock_gettime");
  timespec time{};
  kGetTime(CLOCK_MONOTONIC, &time);
  const double since = seconds(time) - shared()[0];
  // The two are not written at once: it never goes back.
  static std::atomic<double> latest{0.0};
  const double at = std::max(latest.load(), shared()[1] + std::clamp(since, 0.0, kSlice));
  latest.store(at);
  return at;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) {
  static const auto kGetTime = next<GetTime>("clock_gettime");
  if (clock != CLOCK_MONOTONIC) return kGetTime(clock, time);
  const double at = now();
  time->tv_sec = static_cast<time_t>(at);
  time->tv_nsec = static_cast<long>(1e9 * (at - static_cast<double>(time->tv_sec)));
  return 0;
}

extern "C" int clock_nanosleep(clockid_t clock, int flags, const timespec* wanted, timespec* left) {
  static const auto kSleep = next<Sleep>("clock_nanosleep");
  if (clock != CLOCK_MONOTONIC) return kSleep(clock, flags, wanted, left);
  const double until = seconds(*wanted) + ((flags & TIMER_ABSTIME) != 0 ? 0.0 : now());
  while (now() < until) {
    if (kSleep(CLOCK_MONOTONIC, 0, &kNap, left) == EINTR) return EINTR;
  }
  return 0;
}

extern "C" int nanosleep(const timespec* wanted, timespec* left) {
  const int failed = clock_nanosleep(CLOCK_MONOTONIC, 0, wanted, left);
  if (failed == 0) return 0;
  errno = failed;
  return -1;
}
