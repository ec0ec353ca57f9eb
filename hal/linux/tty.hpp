// A serial port, USB serial adapter, Bluetooth rfcomm or pseudo-terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::linux {

struct TtySettings {
  std::string path;  ///< preferably under /dev/serial/by-id, which does not depend on the order of plugging in
  std::uint32_t baud = 115'200;
};

/// Raw 8N1, for this process alone. After an unplug `tend` opens the path again once it is back.
class Tty {
 public:
  /// errors: a sentence: missing, not allowed, no serial port, in use by another program, baud not possible.
  static Opened<Tty> open(TtySettings settings);
  ~Tty();
  Tty(Tty&&) noexcept = default;
  Tty& operator=(Tty&&) = delete;
  Tty(const Tty&) = delete;
  Tty& operator=(const Tty&) = delete;

  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

  /// Once per loop iteration; looks for a missing device, at most every kRetryInterval.
  void tend(base::Time now);
  [[nodiscard]] bool connected() const { return fd_.open(); }
  /// Why the last try to open it again failed; empty when none did.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// For WaitSet; -1 while unplugged.
  [[nodiscard]] int descriptor() const { return fd_.get(); }

 private:
  Tty(TtySettings settings, Descriptor fd) : settings_(std::move(settings)), fd_(std::move(fd)) {}
  void release();

  TtySettings settings_;
  Descriptor fd_;
  Retry retry_;
  std::string problem_;
};

static_assert(bus::ByteLink<Tty>);

}  // namespace fencepost::linux
