#include "hal/linux/i2c_adapter.hpp"

#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <cerrno>

namespace fencepost::linux {
namespace {

constexpr std::string_view kOpenI2c = "open the I2C adapter";

std::string_view i2c_remedy(int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV: return "try 'sudo modprobe i2c-dev' and, on a Raspberry Pi, raspi-config; 'ls /dev/i2c-*' lists them";
    case EACCES:
    case EPERM: return "add yourself to its group with 'sudo usermod -aG i2c $USER' and log in again";
    case ENOTTY: return "name an I2C adapter, such as /dev/i2c-1";
    case EOPNOTSUPP: return "it speaks SMBus only, without repeated starts; use another adapter";
    default: return "look at the end of 'dmesg'";
  }
}

Problem i2c_problem(const std::string& path, int error) { return failure(kOpenI2c, path, error, i2c_remedy(error)); }

// The kernel may report an unplug like any other failure (EIO); the device node is gone by then.
bool still_there(int fd, const std::string& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(fd, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_rdev == named.st_rdev;
}

}  // namespace

Opened<Descriptor> open_i2c_adapter(const I2cSettings& settings) {
  Descriptor fd(::open(settings.path.c_str(), O_RDWR | O_CLOEXEC));
  if (!fd.open()) return i2c_problem(settings.path, errno == EISDIR ? ENOTTY : errno);
  unsigned long functions = 0;
  if (::ioctl(fd.get(), I2C_FUNCS, &functions) != 0) return i2c_problem(settings.path, ENOTTY);
  if ((functions & I2C_FUNC_I2C) == 0) return i2c_problem(settings.path, EOPNOTSUPP);
  constexpr auto kStep = std::chrono::milliseconds(10);
  const auto steps = static_cast<unsigned long>((settings.timeout + kStep - std::chrono::milliseconds(1)) / kStep);
  if (::ioctl(fd.get(), I2C_TIMEOUT, steps) != 0) return i2c_problem(settings.path, errno);
  return fd;
}

base::Result<std::size_t> run_i2c_transfer(int fd, const std::string& path, I2cTransfer& transfer) {
  base::FixedVector<std::uint8_t, bus::kMaxI2cTransfer> out = transfer.out;
  std::array<i2c_msg, 2> messages{};
  unsigned count = 0;
  // A transfer of no bytes either way only asks whether somebody is there.
  if (!out.empty() || transfer.expected == 0)
    messages[count++] = {transfer.address, 0, static_cast<std::uint16_t>(out.size()), out.empty() ? nullptr : &out[0]};
  if (transfer.expected != 0)
    messages[count++] = {transfer.address, I2C_M_RD, static_cast<std::uint16_t>(transfer.expected), transfer.in.data()};
  i2c_rdwr_ioctl_data all{messages.data(), count};
  int done = 0;
  do done = ::ioctl(fd, I2C_RDWR, &all);
  while (done < 0 && errno == EINTR);
  if (done == static_cast<int>(count)) return transfer.expected;
  return still_there(fd, path) ? base::Error::kRefused : base::Error::kGone;
}

}  // namespace fencepost::linux
