// Preloaded into each program on the stage: its clock is the stage's, and its waits end when the stage says so.
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <utility>

#include "tests/stage/message.hpp"

// No exceptions, no heap: a shell and a Python live with it.
namespace fencepost::stage {
namespace {

constexpr std::size_t kMaxWatched = 256;
/// First descriptor of the connections, out of the way of a program that counts its own.
constexpr int kFirstDescriptor = 512;

Board* board = nullptr;  // null: not on a stage
sockaddr_un stage_address{};
pthread_key_t at_thread_end;
thread_local int connection = -1;
thread_local std::uint32_t waits = 0;
thread_local pid_t process = 0;
thread_local pid_t thread = 0;

std::int64_t now_ns() { return board->now_ns; }
std::int64_t ns(const timespec& t) { return t.tv_sec * kNanosecondsPerSecond + t.tv_nsec; }
timespec as_timespec(std::int64_t nanoseconds) {
  return {nanoseconds / kNanosecondsPerSecond, nanoseconds % kNanosecondsPerSecond};
}
std::int64_t deadline_in(std::int64_t nanoseconds) {
  const std::int64_t now = now_ns();
  return nanoseconds < kNever - now ? now + nanoseconds : kNever;
}

int really_poll(pollfd* files, nfds_t count, const timespec* patience, const sigset_t* signals) {
  timespec left = patience != nullptr ? *patience : timespec{};  // the system writes the rest there
  return static_cast<int>(
      ::syscall(SYS_ppoll, files, count, patience != nullptr ? &left : nullptr, signals, sizeof(std::uint64_t)));
}

void leave() {
  if (connection >= 0) ::close(connection);
  connection = -1;
}
void leave_at_thread_end(void* /*one*/) { leave(); }

bool connect() {
  if (connection >= 0) return true;
  const int made = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  if (::connect(made, reinterpret_cast<const sockaddr*>(&stage_address), sizeof stage_address) != 0) {
    ::close(made);
    return false;
  }
  connection = ::fcntl(made, F_DUPFD_CLOEXEC, kFirstDescriptor);
  if (connection >= 0) {
    ::close(made);
  } else {
    connection = made;
  }
  process = ::getpid();
  thread = static_cast<pid_t>(::syscall(SYS_gettid));
  ::pthread_setspecific(at_thread_end, &connection);
  return true;
}

bool say(Word word, std::int64_t deadline = kNever) {
  if (!connect()) return false;
  const Message message{word, waits, deadline, process, thread};
  return ::send(connection, &message, sizeof message, MSG_NOSIGNAL) == sizeof message;
}

/// False when the stage is gone.
bool hear(Message& message) { return ::recv(connection, &message, sizeof message, 0) == sizeof message; }

/// As ppoll(2), until a deadline of the stage's clock.
int wait(pollfd* files, nfds_t count, std::int64_t deadline, const sigset_t* signals) {
  const timespec at_once{};
  const int ready = really_poll(files, count, &at_once, signals);
  if (ready != 0 || deadline <= now_ns()) return ready;
  std::array<pollfd, kMaxWatched + 1> watched;
  if (count > kMaxWatched) std::abort();
  std::copy(files, files + count, watched.begin());
  ++waits;
  if (!say(Word::kWait, deadline)) return really_poll(files, count, nullptr, signals);
  watched[count] = {connection, POLLIN, 0};
  while (true) {
    const int all = really_poll(watched.data(), count + 1, nullptr, signals);
    const int error = errno;
    const int own = all - (all > 0 && watched[count].revents != 0 ? 1 : 0);
    if (own != 0) {
      say(Word::kAwake);
      std::copy(watched.begin(), watched.begin() + static_cast<std::ptrdiff_t>(count), files);
      errno = error;
      return own;
    }
    Message message;
    if (!hear(message)) return 0;
    if (message.wait != waits) continue;
    if (message.word == Word::kTime) return 0;
    say(Word::kIdle);
  }
}

/// Whether it slept to the deadline.
bool sleep_until(std::int64_t deadline) { return wait(nullptr, 0, deadline, nullptr) == 0; }

template <class Function>
Function next_of(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// A thread that waits for a condition variable as if it was a descriptor.
struct Sleeper {
  const pthread_cond_t* condition;
  int bell;
  Sleeper* next;
};
Sleeper* sleepers = nullptr;
pthread_mutex_t sleepers_mutex = PTHREAD_MUTEX_INITIALIZER;

/// 0, or ETIMEDOUT. Whoever notifies it needs no mutex; a needless wake-up is allowed.
int wait_condition(const pthread_cond_t* condition, pthread_mutex_t* mutex, std::int64_t deadline) {
  Sleeper self{condition, ::eventfd(0, EFD_CLOEXEC), nullptr};
  ::pthread_mutex_lock(&sleepers_mutex);
  self.next = std::exchange(sleepers, &self);
  ::pthread_mutex_unlock(&sleepers_mutex);
  ::pthread_mutex_unlock(mutex);
  pollfd bell{self.bell, POLLIN, 0};
  const int ready = wait(&bell, 1, deadline, nullptr);
  ::pthread_mutex_lock(&sleepers_mutex);
  Sleeper** place = &sleepers;
  while (*place != &self) place = &(*place)->next;
  *place = self.next;
  ::pthread_mutex_unlock(&sleepers_mutex);
  ::close(self.bell);
  ::pthread_mutex_lock(mutex);
  return ready == 0 ? ETIMEDOUT : 0;
}

void wake_sleepers(const pthread_cond_t* condition) {
  if (board == nullptr) return;
  ::pthread_mutex_lock(&sleepers_mutex);
  for (const Sleeper* sleeper = sleepers; sleeper != nullptr; sleeper = sleeper->next) {
    if (sleeper->condition == condition) ::eventfd_write(sleeper->bell, 1);
  }
  ::pthread_mutex_unlock(&sleepers_mutex);
}

bool is_staged(clockid_t clock) {
  return board != nullptr && clock != CLOCK_REALTIME && clock < CLOCK_BOOTTIME && clock != CLOCK_PROCESS_CPUTIME_ID &&
         clock != CLOCK_THREAD_CPUTIME_ID;
}

[[gnu::constructor]] void enter() {
  const char* folder = ::getenv(kVariable);
  if (folder == nullptr || std::strlen(folder) + std::strlen(kSocket) >= sizeof stage_address.sun_path) return;
  char* path = stage_address.sun_path;
  std::strcat(std::strcpy(path, folder), kBoard);
  const int file = ::open(path, O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  void* mapped = ::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (mapped == MAP_FAILED) return;
  std::strcat(std::strcpy(path, folder), kSocket);
  stage_address.sun_family = AF_UNIX;
  ::pthread_key_create(&at_thread_end, leave_at_thread_end);
  ::pthread_atfork(nullptr, nullptr, leave);
  board = static_cast<Board*>(mapped);
}

}  // namespace
}  // namespace fencepost::stage

namespace stage = fencepost::stage;

extern "C" {

[[gnu::visibility("default")]] int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (!stage::is_staged(clock)) return static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  *now = stage::as_timespec(stage::now_ns());
  return 0;
}

[[gnu::visibility("default")]] int ppoll(pollfd* files, nfds_t count, const timespec* patience,
                                         const sigset_t* signals) {
  if (stage::board == nullptr) return stage::really_poll(files, count, patience, signals);
  return stage::wait(files, count, patience != nullptr ? stage::deadline_in(stage::ns(*patience)) : stage::kNever,
                     signals);
}

[[gnu::visibility("default")]] int poll(pollfd* files, nfds_t count, int patience_ms) {
  const timespec patience = stage::as_timespec(std::int64_t{patience_ms} * 1'000'000);
  return ppoll(files, count, patience_ms < 0 ? nullptr : &patience, nullptr);
}

// As Python asks.
[[gnu::visibility("default")]] int select(int end, fd_set* readable, fd_set* writable, fd_set* exceptions,
                                          timeval* patience) {
  std::array<pollfd, FD_SETSIZE> files;
  nfds_t count = 0;
  for (int fd = 0; fd < end; ++fd) {
    const bool reads = readable != nullptr && FD_ISSET(fd, readable);
    const bool writes = writable != nullptr && FD_ISSET(fd, writable);
    if (reads || writes) files[count++] = {fd, static_cast<short>((reads ? POLLIN : 0) | (writes ? POLLOUT : 0)), 0};
  }
  const timespec time = patience != nullptr ? timespec{patience->tv_sec, 1'000 * patience->tv_usec} : timespec{};
  const int ready = ppoll(files.data(), count, patience != nullptr ? &time : nullptr, nullptr);
  if (ready < 0) return ready;
  for (fd_set* set : {readable, writable, exceptions}) {
    if (set != nullptr) FD_ZERO(set);
  }
  int found = 0;
  for (nfds_t i = 0; i < count; ++i) {
    const auto& [fd, events, what] = files[i];
    const bool reads = (events & POLLIN) != 0 && (what & (POLLIN | POLLHUP | POLLERR)) != 0;
    const bool writes = (events & POLLOUT) != 0 && (what & (POLLOUT | POLLERR)) != 0;
    if (reads) FD_SET(fd, readable);
    if (writes) FD_SET(fd, writable);
    found += (reads ? 1 : 0) + (writes ? 1 : 0);
  }
  return found;
}

[[gnu::visibility("default")]] int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  if (!stage::is_staged(clock)) {
    return ::syscall(SYS_clock_nanosleep, clock, flags, time, left) == 0 ? 0 : errno;
  }
  const bool at = (flags & TIMER_ABSTIME) != 0;
  const std::int64_t deadline = at ? stage::ns(*time) : stage::deadline_in(stage::ns(*time));
  if (stage::sleep_until(deadline)) return 0;
  if (!at && left != nullptr) *left = stage::as_timespec(std::max<std::int64_t>(deadline - stage::now_ns(), 0));
  return EINTR;
}

[[gnu::visibility("default")]] ssize_t write(int fd, const void* bytes, std::size_t size) {
  const ssize_t written = ::syscall(SYS_write, fd, bytes, size);
  const int error = errno;
  if (stage::board != nullptr && written > 0 && ::isatty(fd) != 0) ++stage::board->written;
  errno = error;
  return written;
}

[[gnu::visibility("default")]] int nanosleep(const timespec* time, timespec* left) {
  const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, time, left);
  errno = error;
  return error == 0 ? 0 : -1;
}

[[gnu::visibility("default")]] int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                                          clockid_t clock, const timespec* time) {
  static const auto really = stage::next_of<decltype(&pthread_cond_clockwait)>("pthread_cond_clockwait");
  if (!stage::is_staged(clock)) return really(condition, mutex, clock, time);
  return stage::wait_condition(condition, mutex, stage::ns(*time));
}

[[gnu::visibility("default")]] int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  static const auto really = stage::next_of<decltype(&pthread_cond_signal)>("pthread_cond_signal");
  stage::wake_sleepers(condition);
  return really(condition);
}

[[gnu::visibility("default")]] int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  static const auto really = stage::next_of<decltype(&pthread_cond_broadcast)>("pthread_cond_broadcast");
  stage::wake_sleepers(condition);
  return really(condition);
}
}
