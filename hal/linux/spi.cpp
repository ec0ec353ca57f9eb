#include "hal/linux/spi.hpp"

#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace fencepost::linux {
namespace {

constexpr std::string_view kOpenSpi = "open the SPI device";

std::string_view spi_remedy(int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV: return "enable SPI (on a Raspberry Pi with raspi-config); 'ls /dev/spidev*' lists what is there";
    case EACCES:
    case EPERM: return "add yourself to its group with 'sudo usermod -aG spi $USER' and log in again";
    case ENOTTY: return "name an SPI device, such as /dev/spidev0.0";
    case EINVAL: return "choose another mode or a slower clock";
    default: return "look at the end of 'dmesg'";
  }
}

Problem spi_problem(const std::string& path, int error) { return failure(kOpenSpi, path, error, spi_remedy(error)); }

int configure(int fd, const SpiSettings& settings) {
  std::uint8_t mode = settings.mode;
  constexpr std::uint8_t kLastMode = 3;
  if (mode > kLastMode) return EINVAL;
  if (::ioctl(fd, SPI_IOC_WR_MODE, &mode) != 0) return errno == ENOTTY ? ENOTTY : EINVAL;
  std::uint8_t bits = 8;
  if (::ioctl(fd, SPI_IOC_WR_BITS_PER_WORD, &bits) != 0) return errno;
  std::uint32_t hertz = settings.hertz;
  return ::ioctl(fd, SPI_IOC_WR_MAX_SPEED_HZ, &hertz) == 0 ? 0 : EINVAL;
}

Opened<Descriptor> open_device(const SpiSettings& settings) {
  Descriptor fd(::open(settings.path.c_str(), O_RDWR | O_CLOEXEC));
  if (!fd.open()) return spi_problem(settings.path, errno == EISDIR ? ENOTTY : errno);
  if (const int error = configure(fd.get(), settings); error != 0) return spi_problem(settings.path, error);
  return fd;
}

// The kernel takes addresses as numbers, the same on 32 and 64 bits.
std::uint64_t address_of(const void* bytes) {
  return reinterpret_cast<std::uintptr_t>(bytes);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

}  // namespace

Opened<Spi> Spi::open(SpiSettings settings) {
  Opened<Descriptor> device = open_device(settings);
  if (!device) return Problem{device.problem()};
  return Spi(std::move(settings), std::move(*device));
}

base::Result<std::size_t> Spi::read(std::span<std::uint8_t> in) {
  if (!fd_.open()) return base::Error::kGone;
  if (const std::size_t kept = pacing_.take(in); kept > 0) return kept;
  const std::size_t count = pacing_.use(in.size());
  if (count == 0) return base::Error::kNotReady;
  const std::array<std::uint8_t, SpiPacing::kGrant> zeros{};
  if (!transfer({zeros.data(), count}, in)) return base::Error::kGone;
  return count;
}

base::Result<std::size_t> Spi::write(std::span<const std::uint8_t> out) {
  if (!fd_.open()) return base::Error::kGone;
  const std::size_t count = std::min(out.size(), pacing_.room());
  if (count == 0 && !out.empty()) return base::Error::kFull;
  std::array<std::uint8_t, SpiPacing::kGrant> in{};
  if (!transfer(out.first(count), in)) return base::Error::kGone;
  pacing_.keep({in.data(), count});
  return count;
}

/// Both directions at once; `in` is at least as long as `out`. On failure the device counts as gone.
bool Spi::transfer(std::span<const std::uint8_t> out, std::span<std::uint8_t> in) {
  spi_ioc_transfer both{};
  both.tx_buf = address_of(out.data());
  both.rx_buf = address_of(in.data());
  both.len = static_cast<std::uint32_t>(out.size());
  both.speed_hz = settings_.hertz;
  both.bits_per_word = 8;
  if (::ioctl(fd_.get(), SPI_IOC_MESSAGE(1), &both) == static_cast<int>(out.size())) return true;
  fd_.close();
  pacing_.forget();
  return false;
}

void Spi::tend(base::Time now) {
  pacing_.tend(now);
  if (fd_.open() || !retry_.due(now)) return;
  Opened<Descriptor> device = open_device(settings_);
  problem_ = device ? std::string() : device.problem();
  if (device) fd_ = std::move(*device);
}

}  // namespace fencepost::linux
