#include "tests/hal/linux/fake_libusb.hpp"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

using fencepost::test::fake_libusb;

namespace {

void wait_while(const std::atomic<bool>& hanging) {
  while (hanging) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

// The library's own names: the linker takes these before the library's.
struct libusb_device {
  int unused = 0;
};
struct libusb_device_handle {
  libusb_context* context = nullptr;
};
struct libusb_context {
  std::mutex mutex;
  std::condition_variable news;
  bool interrupted = false;
  std::vector<libusb_transfer*> flying;
  std::vector<libusb_transfer*> cancelled;
  libusb_context() { ++fake_libusb().contexts; }
  ~libusb_context() { --fake_libusb().contexts; }
};

namespace {

libusb_device the_device;

// Not yet known to the handle: libusb distinguishes contexts by their device lists.
libusb_context* current = nullptr;

void finish(libusb_transfer* transfer, libusb_transfer_status status) {
  transfer->status = status;
  transfer->actual_length = 0;
  --fake_libusb().in_flight;
  transfer->callback(transfer);
}

}  // namespace

namespace fencepost::test {
FakeLibusb& fake_libusb() {
  static auto* const fake = new FakeLibusb;
  return *fake;
}
}  // namespace fencepost::test

extern "C" {

int LIBUSB_CALL libusb_init(libusb_context** context) {
  *context = current = new libusb_context;
  return 0;
}
void LIBUSB_CALL libusb_exit(libusb_context* context) {
  wait_while(fake_libusb().hang_in_exit);
  delete context;
}
ssize_t LIBUSB_CALL libusb_get_device_list(libusb_context* /*context*/, libusb_device*** list) {
  *list = new libusb_device* [2] { &the_device, nullptr };
  return fake_libusb().unplugged ? 0 : 1;
}
void LIBUSB_CALL libusb_free_device_list(libusb_device** list, int /*unref*/) { delete[] list; }
int LIBUSB_CALL libusb_get_device_descriptor(libusb_device* /*device*/, libusb_device_descriptor* descriptor) {
  *descriptor = {};
  descriptor->idVendor = 0x0694;
  descriptor->idProduct = 0x0002;
  return 0;
}
int LIBUSB_CALL libusb_open(libusb_device* /*device*/, libusb_device_handle** handle) {
  wait_while(fake_libusb().hang_in_open);
  *handle = new libusb_device_handle{current};
  ++fake_libusb().handles;
  return 0;
}
void LIBUSB_CALL libusb_close(libusb_device_handle* handle) {
  --fake_libusb().handles;
  delete handle;
}
libusb_device* LIBUSB_CALL libusb_get_device(libusb_device_handle* /*handle*/) { return &the_device; }
int LIBUSB_CALL libusb_set_auto_detach_kernel_driver(libusb_device_handle* /*handle*/, int /*on*/) { return 0; }
int LIBUSB_CALL libusb_get_configuration(libusb_device_handle* /*handle*/, int* number) { return *number = 1, 0; }
int LIBUSB_CALL libusb_claim_interface(libusb_device_handle* /*handle*/, int /*interface*/) { return 0; }
int LIBUSB_CALL libusb_get_max_packet_size(libusb_device* /*device*/, unsigned char /*endpoint*/) { return 64; }
int LIBUSB_CALL libusb_hotplug_register_callback(libusb_context* /*context*/, int /*events*/, int /*flags*/,
                                                 int /*vendor*/, int /*product*/, int /*device_class*/,
                                                 libusb_hotplug_callback_fn /*function*/, void* /*user*/,
                                                 libusb_hotplug_callback_handle* handle) {
  return *handle = 1, 0;
}
void LIBUSB_CALL libusb_hotplug_deregister_callback(libusb_context* /*context*/,
                                                    libusb_hotplug_callback_handle /*handle*/) {}

libusb_transfer* LIBUSB_CALL libusb_alloc_transfer(int /*packets*/) {
  ++fake_libusb().transfers;
  return new libusb_transfer{};
}
void LIBUSB_CALL libusb_free_transfer(libusb_transfer* transfer) {
  --fake_libusb().transfers;
  delete transfer;
}
int LIBUSB_CALL libusb_submit_transfer(libusb_transfer* transfer) {
  libusb_context* context = transfer->dev_handle->context;
  const std::lock_guard lock(context->mutex);
  context->flying.push_back(transfer);
  ++fake_libusb().in_flight;
  return 0;
}
int LIBUSB_CALL libusb_cancel_transfer(libusb_transfer* transfer) {
  libusb_context* context = transfer->dev_handle->context;
  const std::lock_guard lock(context->mutex);
  context->cancelled.push_back(transfer);
  return 0;
}
int LIBUSB_CALL libusb_handle_events_timeout_completed(libusb_context* context, timeval* limit, int* /*completed*/) {
  std::vector<libusb_transfer*> ended;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(limit->tv_sec) +
                   std::chrono::microseconds(limit->tv_usec);
  libusb_transfer_status status = LIBUSB_TRANSFER_CANCELLED;
  {
    std::unique_lock lock(context->mutex);
    // Polls: nothing here reports an unplug.
    while (!context->interrupted && std::chrono::steady_clock::now() < end && ended.empty()) {
      context->news.wait_for(lock, std::chrono::milliseconds(1));
      if (fake_libusb().keep_transfers) continue;
      ended = std::exchange(context->cancelled, {});
      if (fake_libusb().unplugged) {
        ended = context->flying;
        status = LIBUSB_TRANSFER_NO_DEVICE;
      }
      std::erase_if(context->flying,
                    [&](libusb_transfer* one) { return std::find(ended.begin(), ended.end(), one) != ended.end(); });
    }
    context->interrupted = false;
  }
  for (libusb_transfer* transfer : ended) finish(transfer, status);
  return 0;
}
void LIBUSB_CALL libusb_interrupt_event_handler(libusb_context* context) {
  const std::lock_guard lock(context->mutex);
  context->interrupted = true;
  context->news.notify_all();
}

}  // extern "C"
