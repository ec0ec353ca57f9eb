// A libgpiod 1 with one chip, for tests: linked into them, or loaded before all others by a program that they start.
// What is done with a line is appended to the file that FAKE_GPIO names: "SECONDS LEVEL", a line each.
#include <fcntl.h>
#include <gpiod.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

// The library's own names.
struct gpiod_line {
  bool busy = false;
};
struct gpiod_chip {
  std::array<gpiod_line, 8> lines{};
};

namespace {

constexpr unsigned kBusy = 7;
constexpr unsigned kNamed = 4;

gpiod_chip the_chip;

int note(int value) {
  const char* path = std::getenv("FAKE_GPIO");
  if (path == nullptr) return 0;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  std::array<char, 64> line{};
  const int size = std::snprintf(line.data(), line.size(), "%ld.%06ld %d\n", static_cast<long>(now.tv_sec),
                                 now.tv_nsec / 1'000, value);
  const int file = ::open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  const bool written = ::write(file, line.data(), static_cast<std::size_t>(size)) == size;
  ::close(file);
  if (written) return 0;
  errno = EIO;
  return -1;
}

}  // namespace

extern "C" {

gpiod_chip* gpiod_chip_open_lookup(const char* description) {
  if (std::strcmp(description, "gpiochip0") == 0) return &the_chip;
  errno = std::strcmp(description, "gpiochip1") == 0   ? EACCES
          : std::strcmp(description, "gpiochip2") == 0 ? EIO
                                                       : ENOENT;
  return nullptr;
}
void gpiod_chip_close(gpiod_chip* /*chip*/) {}

gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned int offset) {
  if (offset < chip->lines.size()) return &chip->lines[offset];
  errno = EINVAL;
  return nullptr;
}
gpiod_line* gpiod_chip_find_line(gpiod_chip* chip, const char* name) {
  if (std::strcmp(name, "GPIO4") == 0) return &chip->lines[kNamed];
  errno = ENOENT;
  return nullptr;
}

int gpiod_line_request_output(gpiod_line* line, const char* /*consumer*/, int value) {
  if (line != &the_chip.lines[kBusy]) return note(value);
  errno = EBUSY;
  return -1;
}
int gpiod_line_set_value(gpiod_line* /*line*/, int value) { return note(value); }

}  // extern "C"
