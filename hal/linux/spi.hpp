// A device on SPI (spidev), as a stream of bytes.
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
#include "hal/linux/spi_pacing.hpp"

namespace fencepost::linux {

struct SpiSettings {
  std::string path;                 ///< such as /dev/spidev0.0
  std::uint32_t hertz = 2'000'000;  ///< rate of a Pixy2 (Pixy2 documentation, porting guide)
  std::uint8_t mode = 3;            ///< clock polarity and phase, 0 to 3
};

/// Full duplex: what comes in while bytes go out is kept for `read`; when nothing is kept, `read` clocks zeros out.
/// A master can always clock, so there would always be something to read: `tend` grants how much (see SpiPacing). A
/// transfer takes as long as its bytes take, and nothing else is waited for. Nobody can see whether a device is there;
/// kGone: the kernel has taken the bus away.
class Spi {
 public:
  /// errors: a sentence: missing, not allowed, no SPI device, mode or clock not possible.
  static Opened<Spi> open(SpiSettings settings);

  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

  /// Once per loop iteration.
  void tend(base::Time now);
  [[nodiscard]] bool connected() const { return fd_.open(); }
  /// Why the last try to open it again failed; empty when none did.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  Spi(SpiSettings settings, Descriptor fd) : settings_(std::move(settings)), fd_(std::move(fd)) {}
  bool transfer(std::span<const std::uint8_t> out, std::span<std::uint8_t> in);

  SpiSettings settings_;
  Descriptor fd_;
  SpiPacing pacing_;
  Retry retry_;
  std::string problem_;
};

static_assert(bus::ByteLink<Spi>);

}  // namespace fencepost::linux
