// Buses chosen at run time, open or waiting for their device: the drivers' buses on a Linux brain.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "hal/bus/byte_link.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/bus/packet_link.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::host {

/// The interface of ports of any kind.
class Port {
 public:
  virtual ~Port() = default;
  /// Once per loop iteration: looks for a device that is missing, at most four times a second.
  virtual void tend(base::Time now) = 0;
  [[nodiscard]] virtual bool connected() const = 0;
  /// Why it is not connected; may be empty.
  [[nodiscard]] virtual std::string problem() const = 0;
  /// For WaitSet; -1: there is nothing to wait for, the device has to be asked.
  [[nodiscard]] virtual int descriptor() const = 0;
};

class BytePort : public Port {
 public:
  virtual base::Result<std::size_t> read(std::span<std::uint8_t> in) = 0;
  virtual base::Result<std::size_t> write(std::span<const std::uint8_t> out) = 0;
};
static_assert(bus::ByteLink<BytePort>);

class I2cPort : public Port {
 public:
  virtual base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out,
                                          std::size_t expected) = 0;
  virtual base::Result<std::size_t> finish(std::span<std::uint8_t> in) = 0;
};
static_assert(bus::I2cBus<I2cPort>);

class PacketPort : public Port {
 public:
  virtual base::Result<std::size_t> send(std::span<const std::uint8_t> out) = 0;
  virtual base::Result<std::size_t> receive(std::span<std::uint8_t> in) = 0;
};
static_assert(bus::PacketLink<PacketPort>);

/// A bus of hal/linux that is there, or that will be opened once its device is.
template <class Bus>
class Awaited {
 public:
  using Open = std::function<linux::Opened<Bus>()>;
  explicit Awaited(Open open) : open_(std::move(open)) {}

  /// Tries once, now; true if it is there.
  bool try_open() {
    linux::Opened<Bus> opened = open_();
    problem_ = opened ? std::string() : opened.problem();
    if (opened) bus_.emplace(std::move(*opened));
    return bus_.has_value();
  }
  void tend(base::Time now) {
    if (bus_) {
      bus_->tend(now);
    } else if (retry_.due(now)) {
      static_cast<void>(try_open());
    }
  }

  [[nodiscard]] Bus* get() { return bus_ ? &*bus_ : nullptr; }
  [[nodiscard]] bool connected() const { return bus_ && bus_->connected(); }
  [[nodiscard]] std::string problem() const { return bus_ ? std::string(bus_->problem()) : problem_; }
  [[nodiscard]] int descriptor() const {
    if constexpr (requires(const Bus& bus) { bus.descriptor(); }) {
      return bus_ ? bus_->descriptor() : -1;
    } else {
      return -1;
    }
  }

 private:
  Open open_;
  std::optional<Bus> bus_;
  linux::Retry retry_;
  std::string problem_;
};

/// The calls of Port, on an Awaited bus.
template <class Base, class Bus>
class AwaitedPort : public Base {
 public:
  explicit AwaitedPort(typename Awaited<Bus>::Open open) : bus_(std::move(open)) {}
  bool try_open() { return bus_.try_open(); }

  void tend(base::Time now) override { bus_.tend(now); }
  [[nodiscard]] bool connected() const override { return bus_.connected(); }
  [[nodiscard]] std::string problem() const override { return bus_.problem(); }
  [[nodiscard]] int descriptor() const override { return bus_.descriptor(); }

 protected:
  [[nodiscard]] Bus* bus() { return bus_.get(); }

 private:
  Awaited<Bus> bus_;
};

template <class Bus>
class LinuxBytePort final : public AwaitedPort<BytePort, Bus> {
 public:
  using AwaitedPort<BytePort, Bus>::AwaitedPort;
  base::Result<std::size_t> read(std::span<std::uint8_t> in) override {
    if (this->bus() == nullptr) return base::Error::kGone;
    return this->bus()->read(in);
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override {
    if (this->bus() == nullptr) return base::Error::kGone;
    return this->bus()->write(out);
  }
};

template <class Bus>
class LinuxI2cPort final : public AwaitedPort<I2cPort, Bus> {
 public:
  using AwaitedPort<I2cPort, Bus>::AwaitedPort;
  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out,
                                  std::size_t expected) override {
    if (this->bus() == nullptr) return base::Error::kGone;
    return this->bus()->begin(address, out, expected);
  }
  base::Result<std::size_t> finish(std::span<std::uint8_t> in) override {
    if (this->bus() == nullptr) return base::Error::kGone;
    return this->bus()->finish(in);
  }
};

template <class Bus>
class LinuxPacketPort final : public AwaitedPort<PacketPort, Bus> {
 public:
  using AwaitedPort<PacketPort, Bus>::AwaitedPort;
  base::Result<std::size_t> send(std::span<const std::uint8_t> out) override {
    if (this->bus() == nullptr) return base::Error::kGone;
    return this->bus()->send(out);
  }
  base::Result<std::size_t> receive(std::span<std::uint8_t> in) override {
    if (this->bus() == nullptr) return base::Error::kGone;
    return this->bus()->receive(in);
  }
};

}  // namespace fencepost::host
