// A USB device, found and claimed (libusb). Its calls may wait for the device: for the thread of UsbWorker only.
#pragma once

#include <libusb-1.0/libusb.h>

#include <cstddef>
#include <memory>
#include <string>

#include "hal/linux/opened.hpp"
#include "hal/linux/usb_settings.hpp"

namespace fencepost::linux {

/// Where udev runs, a context is kept for the next open_usb() and never closed. The reason: libusb_exit races with the
/// hotplug thread and hung or crashed (libusb up to 1.0.26; its issues 1366 and 1445).
struct CloseUsbContext {
  void operator()(libusb_context* context) const;
};
using UsbContext = std::unique_ptr<libusb_context, CloseUsbContext>;

struct CloseUsbHandle {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using UsbHandle = std::unique_ptr<libusb_device_handle, CloseUsbHandle>;

/// Closing releases the interface. Its context must outlive it.
struct UsbDevice {
  UsbHandle handle;
  std::size_t packet = 0;  ///< bytes, the smaller of both endpoints' largest
};

/// "0694:0002 with serial number 0016530A1B2C".
std::string name_of(const UsbSettings& settings);

/// Whether libusb receives hotplug events from udev.
bool udev_runs();

/// A fresh context sees the devices of this moment; an old one sees later ones only where udev runs.
Opened<UsbContext> open_usb();

/// errors: a sentence: no such device, not allowed, in use by another program, no such endpoints.
Opened<UsbDevice> open_usb_device(libusb_context* context, const UsbSettings& settings);

}  // namespace fencepost::linux
