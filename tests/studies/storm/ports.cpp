#include "tests/studies/storm/ports.hpp"

#include <linux/can.h>

#include <array>
#include <cstring>

#include "drivers/can_wheels/odometry.hpp"
#include "host/devices/ported.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::test {
namespace {

thread_local Sockets* sockets = nullptr;

class MemoryLine final : public host::BytePort {
 public:
  explicit MemoryLine(FarEnd& device) : device_(device) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) override {
    if (!device_.plugged()) return base::Error::kGone;
    const std::size_t count = device_.read(in);
    if (count == 0) return base::Error::kNotReady;
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override {
    if (!device_.plugged()) return base::Error::kGone;
    if (device_.stalled()) return base::Error::kFull;
    device_.write(out);
    return out.size();
  }
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return device_.plugged(); }
  [[nodiscard]] std::string problem() const override { return connected() ? "" : "it is unplugged"; }
  [[nodiscard]] int descriptor() const override { return -1; }

 private:
  FarEnd& device_;
};

/// Frames as SocketCAN has them, one after the other.
class MemoryCan final : public host::Port {
 public:
  explicit MemoryCan(FarEnd& device) : device_(device) {}

  base::Result<bus::CanFrame> receive() {
    if (!device_.plugged()) return have_ = 0, base::Error::kGone;
    have_ += device_.read(std::span(bytes_).subspan(have_));
    if (have_ < bytes_.size()) return base::Error::kNotReady;
    have_ = 0;
    can_frame raw{};
    std::memcpy(&raw, bytes_.data(), sizeof raw);
    bus::CanFrame frame;
    frame.id = raw.can_id & CAN_EFF_MASK;
    frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.length = std::min<std::uint8_t>(raw.can_dlc, 8);
    std::memcpy(frame.data.data(), raw.data, frame.length);
    return frame;
  }
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return device_.plugged(); }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }

 private:
  FarEnd& device_;
  std::array<std::uint8_t, sizeof(can_frame)> bytes_{};
  std::size_t have_ = 0;
};

}  // namespace

Sockets::Sockets() { sockets = this; }
Sockets::~Sockets() { sockets = nullptr; }

FarEnd& Sockets::at(const std::string& place) {
  if (sockets == nullptr || !sockets->devices_.contains(place)) {
    throw host::DeviceFailure{true, "nothing is plugged into " + place};
  }
  return *sockets->devices_[place];
}

std::unique_ptr<host::OdometryDevice> open_can_wheels(const std::string& place, const can_wheels::Mapping& mapping) {
  using Wheels = devices::Ported<can_wheels::Odometry<MemoryCan>, MemoryCan>;
  return std::make_unique<host::PortedOdometry<Wheels>>(devices::kTalks,
                                                        std::make_unique<MemoryCan>(Sockets::at(place)), mapping);
}

}  // namespace fencepost::test

namespace fencepost::host {

std::unique_ptr<BytePort> open_line(const Place& place, std::uint32_t /*baud*/, const PortRequest& /*request*/) {
  return std::make_unique<test::MemoryLine>(test::Sockets::at(place.name));
}
std::unique_ptr<BytePort> open_spi(const std::string& path, std::uint32_t /*hertz*/, const PortRequest& /*request*/) {
  return std::make_unique<test::MemoryLine>(test::Sockets::at(path));
}
std::unique_ptr<BytePort> open_pixy_pipe(const std::string& /*serial*/, const PortRequest& /*request*/) {
  throw DeviceFailure{true, "no pipe on USB here"};
}
std::unique_ptr<I2cPort> open_i2c(const std::string& /*path*/, const PortRequest& /*request*/) {
  throw DeviceFailure{true, "no two-wire bus here"};
}
std::unique_ptr<PacketPort> open_brick_port(const std::string& /*serial*/, const PortRequest& /*request*/) {
  throw DeviceFailure{true, "no brick on USB here"};
}

}  // namespace fencepost::host
