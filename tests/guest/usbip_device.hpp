// A USB device made of software: the server side of USB/IP, attached to the kernel's vhci_hcd by a socket pair.
// Wire format: Documentation/usb/usbip_protocol.rst of the Linux kernel.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "hal/linux/descriptor.hpp"

namespace fencepost::guest {

using Bytes = std::vector<std::uint8_t>;

/// A control request's first eight bytes (USB 2.0, 9.3).
struct UsbSetup {
  std::uint8_t type = 0;
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;
};

/// The device's descriptors and behaviour.
struct UsbModel {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::uint8_t interfaces = 1;
  Bytes interface_descriptors;       ///< with their endpoints
  std::vector<std::string> strings;  ///< manufacturer, product, serial number
  /// A telegram that arrived on a bulk endpoint.
  std::function<void(Bytes)> on_bulk;
  /// Requests that are none of the standard; nothing: stall.
  std::function<std::optional<Bytes>(const UsbSetup&, const Bytes&)> on_control;
};

class UsbipDevice {
 public:
  explicit UsbipDevice(UsbModel model) : model_(std::move(model)) {}
  ~UsbipDevice() { unplug(); }
  UsbipDevice(const UsbipDevice&) = delete;
  UsbipDevice& operator=(const UsbipDevice&) = delete;

  void plug();
  void unplug();

  /// One transfer on an IN endpoint, now or when the host asks.
  void give(std::uint8_t endpoint, Bytes packet);
  /// Every transfer of the endpoint (0x80 set: IN) ends in a stall until the host clears the halt.
  void halt(std::uint8_t endpoint);
  /// The next `count` IN transfers fail as on a noisy wire.
  void garble(int count);
  /// Holds back: OUT transfers and control requests to the model are left unanswered until let go.
  void hold(bool on);
  /// IN transfers that wait for data.
  int waiting();
  /// Transfers that are held back.
  int held();
  /// Transfers that the host took back before they were answered.
  int taken_back();

 private:
  struct Urb {
    std::uint32_t number = 0;
    bool in = false;
    std::uint8_t endpoint = 0;  ///< with the direction bit
    std::uint32_t length = 0;
    UsbSetup setup;
    Bytes out;
  };
  void serve(int socket);
  bool serve_one(int socket);
  void submit(Urb urb);
  void act(const Urb& urb);
  void control(const Urb& urb);
  std::optional<Bytes> standard(const UsbSetup& setup);
  Bytes describe(std::uint16_t which) const;
  void unlink(std::uint32_t number, std::uint32_t victim);
  void answer(const Urb& urb, int status, const Bytes& in);
  void feed();

  UsbModel model_;
  std::recursive_mutex mutex_;  // the model's answers call give()
  linux::Descriptor socket_;
  std::thread server_;
  std::deque<Urb> waiting_;
  std::deque<Urb> held_;
  std::map<std::uint8_t, std::deque<Bytes>> ready_;
  std::set<std::uint8_t> halted_;
  int garbled_ = 0;
  bool holding_ = false;
  int taken_back_ = 0;
};

}  // namespace fencepost::guest
