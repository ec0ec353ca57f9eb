// An NXT brick on a port: its motors are the odometry, and a camera may be plugged into it.
#pragma once

#include <memory>
#include <utility>

#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "host/live/port.hpp"

namespace fencepost::host {

/// The odometry tends and polls it, the camera behind it only asks: the loop polls odometry first.
class SharedBrick {
 public:
  virtual ~SharedBrick() = default;
  virtual Port& port() = 0;
  virtual void poll(base::Time now) = 0;
  virtual nxt::Conversation& conversation() = 0;
  [[nodiscard]] virtual sensor::LinkState link() const = 0;
};

/// Over USB: a telegram is a transfer.
class UsbBrick final : public SharedBrick {
 public:
  explicit UsbBrick(std::unique_ptr<PacketPort> port) : port_(std::move(port)), brick_(*port_) {}
  Port& port() override { return *port_; }
  void poll(base::Time now) override { brick_.poll(now); }
  nxt::Conversation& conversation() override { return brick_.conversation(); }
  [[nodiscard]] sensor::LinkState link() const override { return brick_.link(); }

 private:
  std::unique_ptr<PacketPort> port_;
  nxt::Brick<PacketPort> brick_;
};

/// Over Bluetooth's serial port.
class SerialBrick final : public SharedBrick {
 public:
  explicit SerialBrick(std::unique_ptr<BytePort> port) : port_(std::move(port)), framed_(*port_), brick_(framed_) {}
  Port& port() override { return *port_; }
  void poll(base::Time now) override { brick_.poll(now); }
  nxt::Conversation& conversation() override { return brick_.conversation(); }
  [[nodiscard]] sensor::LinkState link() const override { return brick_.link(); }

 private:
  std::unique_ptr<BytePort> port_;
  nxt::FramedLink<BytePort> framed_;
  nxt::Brick<nxt::FramedLink<BytePort>> brick_;
};

}  // namespace fencepost::host
