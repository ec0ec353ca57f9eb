// The calls of POSIX that mingw lacks (posix/), by those of Windows.
#include <fcntl.h>
#include <io.h>
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace {

HANDLE handle_of(int fd) { return reinterpret_cast<HANDLE>(::_get_osfhandle(fd)); }

bool is_console(HANDLE handle) {
  DWORD mode = 0;
  return ::GetConsoleMode(handle, &mode) != 0;
}

/// A key that gives a character; the console tells of the mouse, too, and reading that would wait.
bool has_key(HANDLE console) {
  INPUT_RECORD event{};
  DWORD count = 0;
  while (::PeekConsoleInputA(console, &event, 1, &count) != 0 && count == 1) {
    if (event.EventType == KEY_EVENT && event.Event.KeyEvent.bKeyDown != 0 &&
        event.Event.KeyEvent.uChar.UnicodeChar != 0) {
      return true;
    }
    ::ReadConsoleInputA(console, &event, 1, &count);
  }
  return false;
}

bool has_line(HANDLE console) {
  DWORD mode = 0;
  ::GetConsoleMode(console, &mode);
  return (mode & ENABLE_LINE_INPUT) == 0 ? has_key(console) : ::WaitForSingleObject(console, 0) == WAIT_OBJECT_0;
}

bool has_bytes(HANDLE handle) {
  if (is_console(handle)) return has_line(handle);
  COMSTAT state{};
  DWORD errors = 0;
  if (::ClearCommError(handle, &errors, &state) != 0) return state.cbInQue > 0;
  if (::GetFileType(handle) != FILE_TYPE_PIPE) return true;
  DWORD waiting = 0;
  // Without a writer there is an end to be read.
  return ::PeekNamedPipe(handle, nullptr, 0, nullptr, &waiting, nullptr) == 0 || waiting > 0;
}

int look(pollfd* watched, unsigned long count) {
  int ready = 0;
  for (unsigned long i = 0; i < count; ++i) {
    pollfd& one = watched[i];
    one.revents = 0;
    if (one.fd < 0) continue;
    if ((one.events & POLLOUT) != 0) one.revents = POLLOUT;
    if ((one.events & POLLIN) != 0 && has_bytes(handle_of(one.fd))) one.revents |= POLLIN;
    if (one.revents != 0) ++ready;
  }
  return ready;
}

}  // namespace

// No one call waits for all of these: it looks again and again.
int poll(pollfd* watched, unsigned long count, int timeout_ms) {
  constexpr DWORD kBetweenMs = 2;  // half of what a camera's frame may be late
  const ULONGLONG begun = ::GetTickCount64();
  while (true) {
    const int ready = look(watched, count);
    const ULONGLONG passed = ::GetTickCount64() - begun;
    if (ready > 0 || (timeout_ms >= 0 && passed >= static_cast<ULONGLONG>(timeout_ms))) return ready;
    const DWORD left = timeout_ms < 0 ? kBetweenMs : static_cast<DWORD>(timeout_ms - passed);
    ::Sleep(std::min(kBetweenMs, left));
  }
}

int ppoll(pollfd* watched, unsigned long count, const timespec* timeout, const void* /*mask*/) {
  constexpr long long kNsPerMs = 1'000'000;
  if (timeout == nullptr) return poll(watched, count, -1);
  return poll(watched, count,
              static_cast<int>(std::min<long long>(timeout->tv_sec, 1'000'000) * 1'000 +
                               (timeout->tv_nsec + kNsPerMs - 1) / kNsPerMs));
}

int tcgetattr(int fd, termios* mode) {
  DWORD now = 0;
  if (::GetConsoleMode(handle_of(fd), &now) == 0) return -1;
  *mode = {};
  if ((now & ENABLE_LINE_INPUT) != 0) mode->c_lflag |= ICANON;
  if ((now & ENABLE_ECHO_INPUT) != 0) mode->c_lflag |= ECHO;
  return 0;
}

int tcsetattr(int fd, int /*when*/, const termios* mode) {
  DWORD now = 0;
  if (::GetConsoleMode(handle_of(fd), &now) == 0) return -1;
  now &= ~static_cast<DWORD>(ENABLE_LINE_INPUT | ENABLE_ECHO_INPUT);
  if ((mode->c_lflag & ICANON) != 0) now |= ENABLE_LINE_INPUT;
  if ((mode->c_lflag & ECHO) != 0) now |= ENABLE_ECHO_INPUT;
  return ::SetConsoleMode(handle_of(fd), now) != 0 ? 0 : -1;
}

int ioctl(int fd, int /*request*/, winsize* size) {
  CONSOLE_SCREEN_BUFFER_INFO about{};
  if (::GetConsoleScreenBufferInfo(handle_of(fd), &about) == 0) return -1;
  size->ws_col = static_cast<unsigned short>(about.srWindow.Right - about.srWindow.Left + 1);
  size->ws_row = static_cast<unsigned short>(about.srWindow.Bottom - about.srWindow.Top + 1);
  return 0;
}

int fencepost_isatty(int fd) { return is_console(handle_of(fd)) ? 1 : 0; }

ssize_t pread(int fd, void* bytes, std::size_t size, off_t at) {
  if (::_lseeki64(fd, at, SEEK_SET) < 0) return -1;
  return ::_read(fd, bytes, static_cast<unsigned>(size));
}

ssize_t pwrite(int fd, const void* bytes, std::size_t size, off_t at) {
  if (::_lseeki64(fd, at, SEEK_SET) < 0) return -1;
  return ::_write(fd, bytes, static_cast<unsigned>(size));
}

// A pipe or a device has nothing to bring to a disk.
int fsync(int fd) { return ::GetFileType(handle_of(fd)) == FILE_TYPE_DISK ? ::_commit(fd) : 0; }

int mkostemp(char* name, int flags) {
  if (::_mktemp(name) == nullptr) return -1;
  return ::_open(name, flags | _O_RDWR | _O_CREAT | _O_EXCL | _O_TEMPORARY | _O_BINARY, S_IREAD | S_IWRITE);
}

int fcntl(int fd, int request, int /*value*/) {
  if (request == F_DUPFD_CLOEXEC) return ::_dup(fd);
  return ::_get_osfhandle(fd) == -1 ? -1 : 0;
}

// C's own signals; the others have no handler and never come.
int sigaction(int number, const struct sigaction* wanted, struct sigaction* before) {
  if (before != nullptr) before->sa_handler = SIG_DFL;
  if (number != SIGINT && number != SIGTERM) return 0;
  void (*const was)(int) = ::signal(number, wanted != nullptr ? wanted->sa_handler : SIG_DFL);
  if (wanted == nullptr) ::signal(number, was);
  if (before != nullptr && was != SIG_ERR) before->sa_handler = was;
  return 0;
}
