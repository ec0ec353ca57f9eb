#include "tests/studies/storm/ports.hpp"

#include <linux/can.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

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

/// A master clocks as many bytes as it likes; where the camera has none, filler comes, and without power ones.
class MemorySpi final : public host::BytePort {
 public:
  explicit MemorySpi(FarEnd& device) : device_(device) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) override {
    if (!device_.plugged()) return base::Error::kGone;
    const std::size_t count = std::min(in.size(), granted_);
    if (count == 0) return base::Error::kNotReady;
    granted_ -= count;
    const std::size_t said = device_.read(in.first(count));
    std::fill(in.begin() + static_cast<std::ptrdiff_t>(said), in.begin() + static_cast<std::ptrdiff_t>(count),
              device_.powered() ? kFiller : std::uint8_t{0xFF});
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override {
    if (!device_.plugged()) return base::Error::kGone;
    if (!device_.stalled()) device_.write(out);
    return out.size();
  }
  void tend(base::Time /*now*/) override { granted_ = kATurn; }
  [[nodiscard]] bool connected() const override { return device_.plugged(); }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }

 private:
  static constexpr std::uint8_t kFiller = 0x01;  // a Pixy2's
  static constexpr std::size_t kATurn = 256;

  FarEnd& device_;
  std::size_t granted_ = 0;
};

/// Unplugged, the adapter is gone; a camera without power does not acknowledge.
class MemoryI2c final : public host::I2cPort {
 public:
  explicit MemoryI2c(FarEnd& device) : device_(device) {}

  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out,
                                  std::size_t expected) override {
    if (!device_.plugged()) return end(base::Error::kGone);
    if (ends_ || out.size() > bus::kMaxI2cTransfer || expected > bus::kMaxI2cTransfer) return base::Error::kFull;
    done_ = device_.transfer(address, out, expected);
    constexpr std::int64_t kBitsOfAByte = 9;
    const std::int64_t bits = kBitsOfAByte * static_cast<std::int64_t>(out.size() + expected + 2);
    constexpr std::int64_t kTicksASecond = base::Duration::kPerUnit;
    const base::Duration takes{bits * kTicksASecond / device_.wires.hertz + 1};
    if (done_.stretched > kLongest) done_ = {std::nullopt, kLongest};
    began_ = device_.now();
    ends_ = began_ + takes + done_.stretched;
    return out.size();
  }
  base::Result<std::size_t> finish(std::span<std::uint8_t> in) override {
    if (!device_.plugged()) return end(base::Error::kGone);
    if (!ends_) return base::Error::kNotReady;
    if (device_.stalled()) {
      const bool over = device_.wires.gives_up && device_.now() - began_ >= kLongest;
      return over ? end(base::Error::kRefused) : base::Error::kNotReady;
    }
    if (device_.now() < *ends_) return base::Error::kNotReady;
    if (!done_.in) return end(base::Error::kRefused);
    ends_.reset();
    const std::size_t count = std::min(in.size(), done_.in->size());
    std::copy_n(done_.in->begin(), count, in.begin());
    return count;
  }
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return device_.plugged(); }
  [[nodiscard]] std::string problem() const override { return connected() ? "" : "it is unplugged"; }
  [[nodiscard]] int descriptor() const override { return -1; }

 private:
  static constexpr base::Duration kLongest = base::milliseconds(100);  // as linux::I2cSettings has it

  base::Error end(base::Error error) {
    ends_.reset();
    return error;
  }

  FarEnd& device_;
  Transferred done_;
  base::Time began_;
  std::optional<base::Time> ends_;  ///< of the transfer under way
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
  return std::make_unique<test::MemorySpi>(test::Sockets::at(path));
}
std::unique_ptr<BytePort> open_pixy_pipe(const std::string& /*serial*/, const PortRequest& /*request*/) {
  return std::make_unique<test::MemoryLine>(test::Sockets::at("usb"));
}
std::unique_ptr<I2cPort> open_i2c(const std::string& path, const PortRequest& /*request*/) {
  return std::make_unique<test::MemoryI2c>(test::Sockets::at(path));
}
std::unique_ptr<PacketPort> open_brick_port(const std::string& /*serial*/, const PortRequest& /*request*/) {
  throw DeviceFailure{true, "no brick on USB here"};
}

}  // namespace fencepost::host
