#include "host/live/open_port.hpp"

#include "hal/linux/i2c.hpp"
#include "hal/linux/spi.hpp"
#include "hal/linux/tcp.hpp"
#include "hal/linux/tty.hpp"
#include "hal/linux/usb_link.hpp"

namespace fencepost::host {
namespace {

/// Where the connection must be there it is waited for, else the name is looked up and the loop connects.
std::unique_ptr<BytePort> open_tcp(const Place& place, const PortRequest& request) {
  using TcpPort = LinuxBytePort<linux::Tcp>;
  const linux::TcpSettings settings{place.name, place.port};
  if (request.wait) {
    return opened(std::make_unique<TcpPort>([settings] { return linux::Tcp::later(settings); }), request);
  }
  return opened(std::make_unique<TcpPort>([settings] { return linux::Tcp::open(settings); }), request);
}

linux::UsbSettings with_serial(linux::UsbSettings settings, const std::string& serial) {
  settings.serial = serial;
  return settings;
}

}  // namespace

std::unique_ptr<BytePort> open_line(const Place& place, std::uint32_t baud, const PortRequest& request) {
  if (place.kind == PlaceKind::kTcp) return open_tcp(place, request);
  const linux::TtySettings settings{place.name, baud};
  return opened(std::make_unique<LinuxBytePort<linux::Tty>>([settings] { return linux::Tty::open(settings); }),
                request);
}

std::unique_ptr<BytePort> open_spi(const std::string& path, std::uint32_t hertz, const PortRequest& request) {
  linux::SpiSettings settings;
  settings.path = path;
  settings.hertz = hertz;
  return opened(std::make_unique<LinuxBytePort<linux::Spi>>([settings] { return linux::Spi::open(settings); }),
                request);
}

std::unique_ptr<BytePort> open_pixy_pipe(const std::string& serial, const PortRequest& request) {
  const linux::UsbSettings settings = with_serial(linux::kPixyUsb, serial);
  return opened(
      std::make_unique<LinuxBytePort<linux::UsbByteLink>>([settings] { return linux::UsbByteLink::open(settings); }),
      request);
}

std::unique_ptr<I2cPort> open_i2c(const std::string& path, const PortRequest& request) {
  linux::I2cSettings settings;
  settings.path = path;
  return opened(std::make_unique<LinuxI2cPort<linux::I2c>>([settings] { return linux::I2c::open(settings); }), request);
}

std::unique_ptr<PacketPort> open_brick_port(const std::string& serial, const PortRequest& request) {
  const linux::UsbSettings settings = with_serial(linux::kNxtUsb, serial);
  return opened(std::make_unique<LinuxPacketPort<linux::UsbPacketLink>>(
                    [settings] { return linux::UsbPacketLink::open(settings); }),
                request);
}

}  // namespace fencepost::host
