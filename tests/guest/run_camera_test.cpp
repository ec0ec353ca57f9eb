// `fencepost run` with cameras on an I2C adapter and on USB; the odometry is typed on its console.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <mutex>
#include <thread>

#include "drivers/nxtcam/camera.hpp"
#include "drivers/pixy1/pixy1.hpp"
#include "drivers/pixy2/camera.hpp"
#include "firmware/record/encode.hpp"
#include "hal/base/crc16.hpp"
#include "hal/linux/usb_settings.hpp"
#include "host/emulate/models/nxtcam.hpp"
#include "host/emulate/models/pixy1.hpp"
#include "host/emulate/models/pixy1_usb.hpp"
#include "host/emulate/models/pixy2_usb.hpp"
#include "tests/guest/approach.hpp"
#include "tests/guest/i2c_adapter.hpp"
#include "tests/guest/live_run.hpp"

namespace fencepost::guest {
namespace {

constexpr base::Duration kLongAgo = base::milliseconds(10'000);

/// "$FPODO,,x,y,heading*crc": stamped on arrival.
std::string pose_line(double x) {
  sensor::OdometrySample sample;
  sample.x = base::Metres::nearest(x);
  std::array<char, record::kMaxLine> buffer{};
  const std::string line(buffer.data(), record::encode(sample, buffer));
  const std::size_t x_at = line.find(',', 7);
  const std::string body = "FPODO," + line.substr(x_at, line.find('*') - x_at);
  std::array<char, 8> crc{};
  std::snprintf(crc.data(), crc.size(), "*%04X", static_cast<unsigned>(base::crc16(body)));
  return "$" + body + crc.data() + "\r\n";
}

/// The first part of a transfer waits for the second: a device of the emulators answers to both at once.
class OnI2c {
 public:
  OnI2c(emulate::I2cDevice& device, const Approach& world) : device_(device), world_(world) {}
  std::optional<Bytes> operator()(const I2cMessage& message) {
    if (!message.last) {
      out_ = message.out;
      return Bytes();
    }
    const Bytes out = message.reading ? std::exchange(out_, {}) : message.out;
    return device_.transfer(message.address, out, message.length, world_.now());
  }

 private:
  emulate::I2cDevice& device_;
  const Approach& world_;
  Bytes out_;
};

class RunOnCamera : public LiveRun {
 protected:
  /// Types poses and shows pictures until the run has seen a post from several places.
  template <class Show>
  void expect_a_post(Show show) {
    ASSERT_TRUE(drives([&] { return count(log(), "$FPFRM,") >= 5; }, show)) << run->err();
    world.drive();
    EXPECT_TRUE(drives([&] { return log().find(",confirmed*") != std::string::npos && arrived(); }, show))
        << run->err() << log();
    expect_replays();
  }
  template <class Done, class Show>
  bool drives(Done done, Show show) {
    return host::testing::eventually([&] {
      run->type(pose_line(world.way()));
      show();
      std::this_thread::sleep_for(std::chrono::milliseconds(40));
      return done();
    });
  }
  [[nodiscard]] std::size_t said_absent(const std::string& path) const {
    return said("pixy2 at " + path + " is absent");
  }
  [[nodiscard]] bool arrived() const { return x() > Approach::kLength - 0.0005; }

  Approach world;
  std::mutex mutex;  ///< of the camera: it is asked on the wire's own thread
};

TEST_F(RunOnCamera, NxtCamOnI2c) {
  emulate::NxtCam camera(base::Time{} - kLongAgo);
  camera.teach(0xFF);
  OnI2c bus(camera, world);
  I2cAdapter adapter([&](const I2cMessage& message) {
    const std::lock_guard lock(mutex);
    return bus(message);
  });
  start("nxtcam:" + I2cAdapter::path(), "console");
  expect_a_post([&] {
    const std::lock_guard lock(mutex);
    camera.show({world.post(nxtcam::kProfile)});
  });
}

TEST_F(RunOnCamera, Pixy2OnI2cThatIsUnpluggedAndComesBack) {
  constexpr std::uint8_t kAddress = 0x54;
  emulate::Pixy2 camera(base::Time{} - kLongAgo);
  std::deque<std::uint8_t> waiting;
  I2cAdapter adapter([&](const I2cMessage& message) -> std::optional<Bytes> {
    const std::lock_guard lock(mutex);
    if (message.address != kAddress) return std::nullopt;
    for (const std::uint8_t byte : message.out) {
      for (const std::uint8_t answer : camera.take(byte, world.now())) waiting.push_back(answer);
    }
    Bytes in(message.length);  // zeros where it has nothing to say
    for (std::uint8_t& byte : in) {
      if (waiting.empty()) break;
      byte = waiting.front();
      waiting.pop_front();
    }
    return in;
  });
  const auto show = [&] {
    const std::lock_guard lock(mutex);
    camera.show({world.post(pixy2::kPixy2Profile)});
  };
  const std::string path = I2cAdapter::path();
  start("pixy2:" + path, "console");
  ASSERT_TRUE(drives([&] { return count(log(), "$FPFRM,") >= 5; }, show)) << run->err();
  adapter.wire().unplug();
  ASSERT_TRUE(drives([&] { return said_absent(path) == 1; }, show)) << run->err();
  adapter.wire().plug();
  expect_a_post(show);
  EXPECT_EQ(said_absent(path), 1U) << run->err();
}

TEST_F(RunOnCamera, Pixy1OnI2c) {
  emulate::Pixy1 camera(0);
  I2cAdapter adapter([&](const I2cMessage& message) -> std::optional<Bytes> {
    const std::lock_guard lock(mutex);
    if (message.address != pixy1::kAddress) return std::nullopt;
    return camera.pull(message.length, world.now());
  });
  start("pixy1:" + I2cAdapter::path(), "console");
  expect_a_post([&] {
    const std::lock_guard lock(mutex);
    camera.show({world.post(pixy1::kProfile)});
  });
}

/// The pipe of both Pixys.
UsbModel pixy_model(const std::string& name) {
  UsbModel model;
  model.vendor = linux::kPixyUsb.vendor;
  model.product = linux::kPixyUsb.product;
  model.strings = {"Charmed Labs", name, "1"};
  model.interfaces = 2;
  model.interface_descriptors = {9, 4,  0,
                                 0, 0,  0xFF,
                                 0, 0,  0,  // nothing of ours
                                 9, 4,  1,
                                 0, 2,  0xFF,
                                 0, 0,  0,  // interface 1
                                 7, 5,  linux::kPixyUsb.out_endpoint,
                                 2, 64, 0,
                                 0,  // bulk
                                 7, 5,  linux::kPixyUsb.in_endpoint,
                                 2, 64, 0,
                                 0};
  return model;
}

/// In packets, as the bus carries them.
void give(UsbipDevice& wire, const Bytes& bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += 64) {
    const std::size_t end = std::min(bytes.size(), at + 64);
    wire.give(linux::kPixyUsb.in_endpoint,
              Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(end)));
  }
}

TEST_F(RunOnCamera, Pixy1OnUsb) {
  emulate::Pixy1Usb camera(world.now() - kLongAgo);
  UsbModel model = pixy_model("Pixy");
  UsbipDevice* wire = nullptr;
  model.on_bulk = [&](const Bytes& transfer) {
    const std::lock_guard lock(mutex);
    for (const std::uint8_t byte : transfer) give(*wire, camera.take(byte, world.now()));
  };
  UsbipDevice device(model);
  wire = &device;
  device.plug();
  start("pixy1:usb", "console");
  expect_a_post([&] {
    const std::lock_guard lock(mutex);
    camera.show({world.post(pixy1::kProfile)});
    while (camera.next() <= world.now()) give(device, camera.step(camera.next()));
  });
}

TEST_F(RunOnCamera, Pixy2OnUsb) {
  emulate::Pixy2 camera(base::Time{} - kLongAgo);
  emulate::Pixy2Usb pipe(camera);
  UsbModel model = pixy_model("Pixy2");
  UsbipDevice* wire = nullptr;
  model.on_bulk = [&](const Bytes& transfer) {
    const std::lock_guard lock(mutex);
    for (const std::uint8_t byte : transfer) give(*wire, pipe.take(byte, world.now()));
  };
  UsbipDevice device(model);
  wire = &device;
  device.plug();
  start("pixy2:usb", "console");
  expect_a_post([&] {
    const std::lock_guard lock(mutex);
    camera.show({world.post(pixy2::kPixy2Profile)});
  });
}

}  // namespace
}  // namespace fencepost::guest
