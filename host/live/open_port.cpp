#include "host/live/open_port.hpp"

#include <utility>

#include "hal/linux/i2c.hpp"
#include "hal/linux/spi.hpp"
#include "hal/linux/tcp.hpp"
#include "hal/linux/tty.hpp"
#include "hal/linux/usb_link.hpp"

namespace fencepost::host {
namespace {

/// Where the connection must be there it is waited for, else the name is looked up and the loop connects.
std::unique_ptr<BytePort> open_tcp(const Place& place, const std::string& what, bool wait) {
  using TcpPort = LinuxBytePort<linux::Tcp>;
  const linux::TcpSettings settings{place.name, place.port};
  if (wait) return opened(std::make_unique<TcpPort>([settings] { return linux::Tcp::later(settings); }), what, wait);
  return opened(std::make_unique<TcpPort>([settings] { return linux::Tcp::open(settings); }), what, wait);
}

linux::UsbSettings with_serial(linux::UsbSettings settings, const DeviceSpec& spec) {
  settings.serial = spec.option("serial", "");
  return settings;
}

}  // namespace

std::unique_ptr<BytePort> open_line(const Place& place, std::uint32_t baud, const std::string& what, bool wait) {
  if (place.kind == PlaceKind::kTcp) return open_tcp(place, what, wait);
  const linux::TtySettings settings{place.name, baud};
  return opened(std::make_unique<LinuxBytePort<linux::Tty>>([settings] { return linux::Tty::open(settings); }), what,
                wait);
}

std::unique_ptr<BytePort> open_byte_port(const DeviceSpec& spec, std::uint32_t baud, bool wait) {
  const std::string what(spec.kind_name());
  if (spec.place.kind == PlaceKind::kSpi) {
    linux::SpiSettings settings;
    settings.path = spec.place.name;
    settings.hertz = spec.number("hertz", settings.hertz);
    return opened(std::make_unique<LinuxBytePort<linux::Spi>>([settings] { return linux::Spi::open(settings); }), what,
                  wait);
  }
  if (spec.place.kind == PlaceKind::kUsb) {
    const linux::UsbSettings settings = with_serial(linux::kPixyUsb, spec);
    return opened(
        std::make_unique<LinuxBytePort<linux::UsbByteLink>>([settings] { return linux::UsbByteLink::open(settings); }),
        what, wait);
  }
  return open_line(spec.place, spec.number("baud", baud), what, wait);
}

std::unique_ptr<I2cPort> open_i2c_port(const DeviceSpec& spec, bool wait) {
  linux::I2cSettings settings;
  settings.path = spec.place.name;
  return opened(std::make_unique<LinuxI2cPort<linux::I2c>>([settings] { return linux::I2c::open(settings); }),
                std::string(spec.kind_name()), wait);
}

std::unique_ptr<PacketPort> open_brick_port(const DeviceSpec& spec, bool wait) {
  const linux::UsbSettings settings = with_serial(linux::kNxtUsb, spec);
  return opened(std::make_unique<LinuxPacketPort<linux::UsbPacketLink>>(
                    [settings] { return linux::UsbPacketLink::open(settings); }),
                std::string(spec.kind_name()), wait);
}

}  // namespace fencepost::host
