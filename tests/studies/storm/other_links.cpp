#include "tests/studies/storm/other_links.hpp"

#include <deque>
#include <stdexcept>
#include <vector>

#include "drivers/huskylens/huskylens.hpp"
#include "drivers/nxtcam/registers.hpp"
#include "drivers/pixy1/pixy1.hpp"
#include "host/emulate/models/camera_adapters.hpp"
#include "host/emulate/models/grove.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "host/emulate/models/huskylens2.hpp"
#include "host/emulate/models/nxtcam.hpp"
#include "host/emulate/models/pixy1.hpp"
#include "host/emulate/models/pixy1_usb.hpp"
#include "host/emulate/models/pixy2.hpp"
#include "host/emulate/models/pixy2_usb.hpp"

namespace fencepost::test {
namespace {

using emulate::Bytes;

constexpr std::uint8_t kPixy2Address = 0x54;  // as its row has it

std::vector<sensor::Blob> list_of(const sensor::BlobFrame& frame) { return {frame.blobs.begin(), frame.blobs.end()}; }

/// One whose serial line and bus carry the same bytes: what it has to say waits to be read, then comes filler.
class StreamOnWires final : public WiredModel {
 public:
  StreamOnWires(std::unique_ptr<emulate::DeviceModel> device, std::uint8_t address, std::uint8_t filler)
      : device_(std::move(device)), address_(address), filler_(filler) {}

  Bytes power_up(base::Time now) override {
    waiting_.clear();
    keep(device_->power_up(now));
    return {};
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override {
    keep(device_->see(frame, now));
    return {};
  }
  std::optional<Bytes> transfer(std::uint8_t address, const Bytes& out, std::size_t expected, base::Time now) override {
    if (address != address_) return std::nullopt;
    for (const std::uint8_t byte : out) keep(device_->take(byte, now));
    Bytes in;
    while (in.size() < expected) {
      in.push_back(waiting_.empty() ? filler_ : waiting_.front());
      if (!waiting_.empty()) waiting_.pop_front();
    }
    return in;
  }

 private:
  void keep(const Bytes& said) { waiting_.insert(waiting_.end(), said.begin(), said.end()); }

  std::unique_ptr<emulate::DeviceModel> device_;
  std::uint8_t address_;
  std::uint8_t filler_;
  std::deque<std::uint8_t> waiting_;
};

class Pixy1OnWires final : public WiredModel {
 public:
  Bytes power_up(base::Time now) override { return camera_.power_up(now); }
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override { return camera_.see(frame, now); }
  std::optional<Bytes> transfer(std::uint8_t address, const Bytes& /*out*/, std::size_t expected,
                                base::Time now) override {
    if (address != pixy1::kAddress) return std::nullopt;
    return camera_.pull(expected, now);
  }

 private:
  emulate::Pixy1 camera_{0};
};

class GroveOnWires final : public WiredModel {
 public:
  Bytes power_up(base::Time now) override {
    wires_.restart();
    wires_.say(camera_.power_up(now));
    return {};
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override {
    wires_.say(camera_.see(frame, now));
    return {};
  }
  std::optional<Bytes> transfer(std::uint8_t address, const Bytes& out, std::size_t expected, base::Time now) override {
    return wires_.transfer(address, out, expected, now);
  }

 private:
  emulate::Grove camera_;
  emulate::GroveOnI2c wires_{camera_};
};

class NxtCamOnWires final : public WiredModel {
 public:
  NxtCamOnWires() { camera_.teach(0xFF); }
  Bytes power_up(base::Time now) override {
    camera_.restart(now);
    return {};
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time /*now*/) override {
    camera_.show(list_of(frame));
    return {};
  }
  std::optional<Bytes> transfer(std::uint8_t address, const Bytes& out, std::size_t expected, base::Time now) override {
    return camera_.transfer(address, out, expected, now);
  }

 private:
  emulate::NxtCam camera_{base::Time{}};
};

class Pixy2OnUsb final : public emulate::DeviceModel {
 public:
  Bytes power_up(base::Time now) override {
    pipe_.restart(now);
    return {};
  }
  Bytes take(std::uint8_t byte, base::Time now) override { return pipe_.take(byte, now); }
  Bytes see(const sensor::BlobFrame& frame, base::Time /*now*/) override {
    camera_.show(list_of(frame));
    return {};
  }
  [[nodiscard]] bool in_use() const override { return camera_.asked(); }

 private:
  emulate::Pixy2 camera_{base::Time{}};
  emulate::Pixy2Usb pipe_{camera_};
};

class Pixy1OnUsb final : public emulate::DeviceModel {
 public:
  Bytes power_up(base::Time now) override { return camera_.power_up(now); }
  Bytes take(std::uint8_t byte, base::Time now) override { return camera_.take(byte, now); }
  Bytes see(const sensor::BlobFrame& frame, base::Time /*now*/) override {
    camera_.show(list_of(frame));
    return {};
  }
  [[nodiscard]] std::optional<base::Time> next() const override { return camera_.next(); }
  Bytes step(base::Time now) override { return camera_.step(now); }
  [[nodiscard]] bool in_use() const override { return true; }

 private:
  emulate::Pixy1Usb camera_{base::Time{}};
};

}  // namespace

std::unique_ptr<emulate::DeviceModel> on_two_wires(const std::string& row) {
  const auto stream = [](std::unique_ptr<emulate::DeviceModel> device, std::uint8_t address, std::uint8_t filler) {
    return std::make_unique<StreamOnWires>(std::move(device), address, filler);
  };
  if (row == "pixy2" || row == "pixy2.1") return stream(emulate::make_pixy2_model(), kPixy2Address, 0);
  if (row == "huskylens") return stream(std::make_unique<emulate::HuskyLens>(), huskylens::kAddress, 0xFF);
  if (row == "huskylens2") return stream(std::make_unique<emulate::HuskyLens2>(), huskylens::kAddress2, 0xFF);
  if (row == "pixy1") return std::make_unique<Pixy1OnWires>();
  if (row == "grove") return std::make_unique<GroveOnWires>();
  if (row == "nxtcam") return std::make_unique<NxtCamOnWires>();
  throw std::runtime_error("no model of " + row + " on two wires");
}

std::unique_ptr<emulate::DeviceModel> on_usb(const std::string& row) {
  if (row == "pixy2" || row == "pixy2.1") return std::make_unique<Pixy2OnUsb>();
  if (row == "pixy1") return std::make_unique<Pixy1OnUsb>();
  throw std::runtime_error("no model of " + row + " on USB");
}

}  // namespace fencepost::test
