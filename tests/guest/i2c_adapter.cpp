#include "tests/guest/i2c_adapter.hpp"

#include <filesystem>
#include <fstream>
#include <utility>

#include "tests/guest/eventually.hpp"

namespace fencepost::guest {
namespace {

std::string node() {
  for (const auto& entry : std::filesystem::directory_iterator("/sys/bus/i2c/devices")) {
    std::string name;
    std::ifstream file(entry.path() / "name");
    std::getline(file, name);
    if (name.rfind("i2c-tiny-usb", 0) == 0) return "/dev/" + entry.path().filename().string();
  }
  return {};
}

}  // namespace

I2cAdapter::I2cAdapter(Bus bus) : bus_(std::move(bus)), device_(model()) {
  eventually([] { return node().empty(); });  // the last test's adapter may be there for another moment
  device_.plug();
}

std::string I2cAdapter::path() {
  std::string found;
  eventually([&found] {
    found = node();
    return !found.empty() && std::filesystem::exists(found);
  });
  return found;
}

UsbModel I2cAdapter::model() {
  UsbModel model;
  model.vendor = 0x0403;
  model.product = 0xC631;
  model.strings = {"Till Harbaum", "i2c-tiny-usb", "1"};
  model.interface_descriptors = {9, 4, 0, 0, 0, 0xFF, 0, 0, 0};
  model.on_control = [this](const UsbSetup& setup, const Bytes& out) { return request(setup, out); };
  return model;
}

std::optional<Bytes> I2cAdapter::request(const UsbSetup& setup, const Bytes& out) {
  enum : std::uint8_t { kEcho = 0, kFunctions = 1, kDelay = 2, kStatus = 3, kTransfer = 4, kLast = 7 };
  switch (setup.request) {
    case kEcho: return Bytes{static_cast<std::uint8_t>(setup.value), static_cast<std::uint8_t>(setup.value >> 8)};
    case kFunctions: return Bytes{0x01, 0x00, 0xFF, 0x0E};  // I2C_FUNC_I2C and the SMBus functions made of it
    case kDelay: return Bytes();
    case kStatus: return Bytes{acknowledged_ ? std::uint8_t{1} : std::uint8_t{2}};
    default: break;
  }
  if (setup.request > kLast) return std::nullopt;
  constexpr std::uint8_t kStop = 2;
  const bool reading = (setup.type & 0x80U) != 0;
  const bool last = (setup.request & kStop) != 0;
  std::optional<Bytes> in =
      bus_({static_cast<std::uint8_t>(setup.index), reading, last, reading ? setup.length : 0U, out});
  acknowledged_ = in.has_value();
  return in ? std::move(*in) : Bytes(reading ? setup.length : 0U);
}

}  // namespace fencepost::guest
