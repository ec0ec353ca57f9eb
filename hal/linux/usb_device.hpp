// A USB device, found and claimed (libusb). Its calls may wait for the device: for the thread of UsbWorker only.
#pragma once

#include <libusb-1.0/libusb.h>

#include <cstddef>
#include <memory>

#include "hal/linux/opened.hpp"
#include "hal/linux/usb_settings.hpp"

namespace fencepost::linux {

struct CloseUsbContext {
  void operator()(libusb_context* context) const { libusb_exit(context); }
};
using UsbContext = std::unique_ptr<libusb_context, CloseUsbContext>;

struct CloseUsbHandle {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using UsbHandle = std::unique_ptr<libusb_device_handle, CloseUsbHandle>;

/// Closing releases the interface. It has to go before its context.
struct UsbDevice {
  UsbHandle handle;
  std::size_t packet = 0;  ///< bytes, the smaller of both endpoints' largest
};

/// A fresh context sees the devices of this moment; an old one sees later ones only where udev runs.
Opened<UsbContext> open_usb();

/// errors: a sentence: no such device, not allowed, in use by another program, no such endpoints.
Opened<UsbDevice> open_usb_device(libusb_context* context, const UsbSettings& settings);

}  // namespace fencepost::linux
