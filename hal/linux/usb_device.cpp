#include "hal/linux/usb_device.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <string>
#include <vector>

namespace fencepost::linux {
namespace {

std::string hexadecimal(std::uint16_t value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4) text += kDigits[static_cast<std::size_t>(value >> shift) & 0xFU];
  return text;
}

std::string usb_remedy(int error, const UsbSettings& settings) {
  switch (error) {
    case LIBUSB_ERROR_ACCESS:
      return "let udev allow it: SUBSYSTEM==\"usb\", ATTR{idVendor}==\"" + hexadecimal(settings.vendor) +
             "\", MODE=\"0666\" in /etc/udev/rules.d/70-fencepost.rules, then plug it in again";
    case LIBUSB_ERROR_BUSY: return "another program has it; close that one";
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND: return "plug it in and switch it on; 'lsusb' lists what is there";
    default: return "unplug it, plug it in again and look at the end of 'dmesg'";
  }
}

Problem usb_problem(const UsbSettings& settings, int error) {
  return {"cannot open the USB device " + name_of(settings) + ": " + libusb_strerror(error) + "; " +
          usb_remedy(error, settings)};
}

/// Contexts kept for reuse. Hotplug events queue in them meanwhile, some bytes each.
class Shelf {
 public:
  void put(libusb_context* context) {
    const std::lock_guard lock(mutex_);
    contexts_.push_back(context);
  }
  libusb_context* take() {
    const std::lock_guard lock(mutex_);
    if (contexts_.empty()) return nullptr;
    libusb_context* context = contexts_.back();
    contexts_.pop_back();
    return context;
  }

 private:
  std::mutex mutex_;
  std::vector<libusb_context*> contexts_;
};

Shelf& shelf() {
  static auto* const kept = new Shelf;  // never destroyed: threads may outlive the end of main
  return *kept;
}

struct FreeList {
  void operator()(libusb_device** list) const { libusb_free_device_list(list, 1); }
};

bool has_ids(libusb_device* device, const UsbSettings& settings) {
  libusb_device_descriptor descriptor{};
  return libusb_get_device_descriptor(device, &descriptor) == 0 && descriptor.idVendor == settings.vendor &&
         descriptor.idProduct == settings.product;
}

bool has_serial(libusb_device_handle* handle, const std::string& serial) {
  if (serial.empty()) return true;
  libusb_device_descriptor descriptor{};
  if (libusb_get_device_descriptor(libusb_get_device(handle), &descriptor) != 0) return false;
  std::array<unsigned char, 256> text{};
  const int length = libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber, text.data(), text.size());
  return length >= 0 && std::equal(serial.begin(), serial.end(), text.begin(), text.begin() + length);
}

/// A device that no driver wanted is left without a configuration.
int configure(libusb_device_handle* handle) {
  int configuration = 0;
  if (const int error = libusb_get_configuration(handle, &configuration); error != 0) return error;
  return configuration == 0 ? libusb_set_configuration(handle, 1) : 0;
}

int claim(libusb_device_handle* handle, const UsbSettings& settings) {
  libusb_set_auto_detach_kernel_driver(handle, 1);  // fails only where there are no kernel drivers
  if (const int error = configure(handle); error != 0) return error;
  if (const int error = libusb_claim_interface(handle, settings.interface); error != 0) return error;
  return settings.reset ? libusb_reset_device(handle) : 0;
}

Opened<UsbDevice> use(UsbHandle handle, const UsbSettings& settings) {
  if (const int error = claim(handle.get(), settings); error != 0) return usb_problem(settings, error);
  libusb_device* device = libusb_get_device(handle.get());
  const int in = libusb_get_max_packet_size(device, settings.in_endpoint);
  const int out = libusb_get_max_packet_size(device, settings.out_endpoint);
  const int packet = std::min(in, out);
  if (packet > 0) return UsbDevice{std::move(handle), static_cast<std::size_t>(packet)};
  return Problem{"cannot use the USB device " + name_of(settings) +
                 ": it lacks the expected endpoints; check its firmware, or that it is not in an update mode"};
}

}  // namespace

std::string name_of(const UsbSettings& settings) {
  std::string name = hexadecimal(settings.vendor) + ":" + hexadecimal(settings.product);
  if (!settings.serial.empty()) name += " with serial number " + settings.serial;
  return name;
}

bool udev_runs() { return ::access("/run/udev/control", F_OK) == 0; }

void CloseUsbContext::operator()(libusb_context* context) const {
  if (udev_runs()) {
    shelf().put(context);
  } else {
    libusb_exit(context);
  }
}

Opened<UsbContext> open_usb() {
  if (libusb_context* kept = udev_runs() ? shelf().take() : nullptr) return UsbContext(kept);
  libusb_context* context = nullptr;
  const int error = libusb_init(&context);
  if (error == 0) return UsbContext(context);
  return Problem{std::string("cannot start libusb: ") + libusb_strerror(error) +
                 "; see whether /dev/bus/usb exists and may be read"};
}

Opened<UsbDevice> open_usb_device(libusb_context* context, const UsbSettings& settings) {
  libusb_device** devices = nullptr;
  const ssize_t count = libusb_get_device_list(context, &devices);
  if (count < 0) return usb_problem(settings, static_cast<int>(count));
  const std::unique_ptr<libusb_device*, FreeList> list(devices);
  int failed = LIBUSB_ERROR_NOT_FOUND;
  for (ssize_t i = 0; i < count; ++i) {
    if (!has_ids(devices[i], settings)) continue;
    libusb_device_handle* handle = nullptr;
    if (const int error = libusb_open(devices[i], &handle); error != 0) {
      failed = error;
      continue;
    }
    UsbHandle owned(handle);
    if (has_serial(handle, settings.serial)) return use(std::move(owned), settings);
  }
  return usb_problem(settings, failed);
}

}  // namespace fencepost::linux
