// Opens serial ports only: for the others see hal/windows/README.md.
#include "host/live/open_port.hpp"

#include "hal/linux/tty.hpp"

namespace fencepost::host {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw DeviceFailure{true, what + " is not in the program for Windows, which has serial ports, such as COM3"};
}

}  // namespace

std::unique_ptr<BytePort> open_line(const Place& place, std::uint32_t baud, const PortRequest& request) {
  if (place.kind == PlaceKind::kTcp) refuse("a connection (tcp:)");
  const linux::TtySettings settings{place.name, baud};
  return opened(std::make_unique<LinuxBytePort<linux::Tty>>([settings] { return linux::Tty::open(settings); }),
                request);
}

std::unique_ptr<BytePort> open_spi(const std::string&, std::uint32_t, const PortRequest&) { refuse("SPI"); }
std::unique_ptr<BytePort> open_pixy_pipe(const std::string&, const PortRequest&) { refuse("a camera's own USB port"); }
std::unique_ptr<I2cPort> open_i2c(const std::string&, const PortRequest&) { refuse("I2C"); }
std::unique_ptr<PacketPort> open_brick_port(const std::string&, const PortRequest&) { refuse("a brick's USB port"); }

}  // namespace fencepost::host
