#include "hal/linux/gpio_line.hpp"

#include <gpiod.h>

#include <cerrno>
#include <charconv>
#include <optional>

namespace fencepost::linux {
namespace {

constexpr const char* kConsumer = "fencepost";

struct CloseChip {
  void operator()(gpiod_chip* chip) const { ::gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

/// Closing the chip releases its line.
class GpioLine final : public OutputLine {
 public:
  GpioLine(Chip chip, gpiod_line* line) : chip_(std::move(chip)), line_(line) {}
  int set(bool high) override { return ::gpiod_line_set_value(line_, high ? 1 : 0) == 0 ? 0 : errno; }

 private:
  Chip chip_;
  gpiod_line* line_;
};

std::string place_of(const GpioSettings& settings) { return settings.chip + ":" + settings.line; }

std::string gpio_remedy(int error) {
  switch (error) {
    case EBUSY: return "another program, or the kernel, has it: 'gpioinfo' says who; choose another line";
    case EACCES:
    case EPERM: return "sudo usermod -aG gpio $USER, then log in again";
    case ENOENT:
    case ENODEV:
    case ENOTTY: return "'gpiodetect' lists the chips, 'gpioinfo' their lines";
    default: return "see 'gpioinfo' and the end of 'dmesg'";
  }
}

std::optional<unsigned> line_number(const std::string& text) {
  unsigned value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return value;
}

gpiod_line* find_line(gpiod_chip* chip, const std::string& line) {
  if (const auto offset = line_number(line)) return ::gpiod_chip_get_line(chip, *offset);
  return ::gpiod_chip_find_line(chip, line.c_str());
}

}  // namespace

Opened<std::unique_ptr<OutputLine>> open_gpio_line(const GpioSettings& settings) {
  errno = 0;
  Chip chip(::gpiod_chip_open_lookup(settings.chip.c_str()));
  if (!chip) return failure("open the GPIO chip", settings.chip, errno, gpio_remedy(errno));
  errno = 0;
  gpiod_line* line = find_line(chip.get(), settings.line);
  if (line == nullptr)
    return failure("find the GPIO line", place_of(settings), errno == 0 ? ENOENT : errno, gpio_remedy(ENOENT));
  if (::gpiod_line_request_output(line, kConsumer, settings.high ? 1 : 0) != 0)
    return failure("drive the GPIO line", place_of(settings), errno, gpio_remedy(errno));
  return std::unique_ptr<OutputLine>(std::make_unique<GpioLine>(std::move(chip), line));
}

}  // namespace fencepost::linux
