#include "tests/hal/linux/fake_libusb.hpp"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
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
  libusb_hotplug_callback_fn watcher = nullptr;
  void* watching = nullptr;
  libusb_context() { ++fake_libusb().contexts; }
  ~libusb_context() { --fake_libusb().contexts; }
};

namespace {

libusb_device the_device;

// Not yet known to the handle: libusb distinguishes contexts by their device lists.
libusb_context* current = nullptr;

struct Ended {
  libusb_transfer* transfer;
  int status;
};

void finish(const Ended& ended) {
  ended.transfer->status = static_cast<libusb_transfer_status>(ended.status);
  if (ended.status == LIBUSB_TRANSFER_CANCELLED || ended.status == LIBUSB_TRANSFER_NO_DEVICE)
    ended.transfer->actual_length = 0;
  --fake_libusb().in_flight;
  ended.transfer->callback(ended.transfer);
}

bool is_input(const libusb_transfer* transfer) { return (transfer->endpoint & LIBUSB_ENDPOINT_IN) != 0; }

/// Of those that fly, each that the device answers next, in order.
std::vector<Ended> answered(const std::vector<libusb_transfer*>& flying) {
  auto& fake = fake_libusb();
  const std::lock_guard lock(fake.mutex);
  std::vector<Ended> ended;
  for (libusb_transfer* transfer : flying) {
    transfer->actual_length = 0;
    if (is_input(transfer) && !fake.reads.empty()) {
      const fencepost::test::FakeLibusb::Read read = fake.reads.front();
      fake.reads.pop_front();
      transfer->actual_length = static_cast<int>(read.bytes.size());
      std::copy(read.bytes.begin(), read.bytes.end(), transfer->buffer);
      ended.push_back({transfer, read.status});
    } else if (!is_input(transfer) && !fake.write_statuses.empty()) {
      const int status = fake.write_statuses.front();
      fake.write_statuses.pop_front();
      if (status == LIBUSB_TRANSFER_COMPLETED) {
        transfer->actual_length = transfer->length;
        fake.heard.emplace_back(transfer->buffer, transfer->buffer + transfer->length);
      }
      ended.push_back({transfer, status});
    }
  }
  return ended;
}

/// Those that have ended by now; none while they are kept.
std::vector<Ended> take_ended(libusb_context& context) {
  if (fake_libusb().keep_transfers) return {};
  std::vector<Ended> ended;
  for (libusb_transfer* one : std::exchange(context.cancelled, {})) ended.push_back({one, LIBUSB_TRANSFER_CANCELLED});
  if (fake_libusb().unplugged) {
    ended.clear();
    for (libusb_transfer* one : context.flying) ended.push_back({one, LIBUSB_TRANSFER_NO_DEVICE});
  } else if (ended.empty()) {
    ended = answered(context.flying);
  }
  std::erase_if(context.flying, [&](libusb_transfer* one) {
    return std::any_of(ended.begin(), ended.end(), [one](const Ended& each) { return each.transfer == one; });
  });
  return ended;
}

}  // namespace

namespace fencepost::test {
FakeLibusb& fake_libusb() {
  static auto* const fake = new FakeLibusb;
  return *fake;
}

void FakeLibusb::restore() {
  hang_in_open = hang_in_exit = keep_transfers = unplugged = false;
  init_error = list_error = open_error = claim_error = configuration_error = 0;
  submit_error = clear_halt_error = watch_error = 0;
  configuration = 1;
  packet = 64;
  resets = halts_cleared = event = 0;
  const std::lock_guard lock(mutex);
  reads.clear();
  write_statuses.clear();
  heard.clear();
}
}  // namespace fencepost::test

extern "C" {

const char* LIBUSB_CALL libusb_strerror(int /*error*/) { return "as the test has it"; }
int LIBUSB_CALL libusb_init(libusb_context** context) {
  if (fake_libusb().init_error != 0) return fake_libusb().init_error;
  *context = current = new libusb_context;
  return 0;
}
void LIBUSB_CALL libusb_exit(libusb_context* context) {
  wait_while(fake_libusb().hang_in_exit);
  delete context;
}
ssize_t LIBUSB_CALL libusb_get_device_list(libusb_context* /*context*/, libusb_device*** list) {
  if (fake_libusb().list_error != 0) return fake_libusb().list_error;
  *list = new libusb_device* [2] { &the_device, nullptr };
  return fake_libusb().unplugged ? 0 : 1;
}
void LIBUSB_CALL libusb_free_device_list(libusb_device** list, int /*unref*/) { delete[] list; }
int LIBUSB_CALL libusb_get_device_descriptor(libusb_device* /*device*/, libusb_device_descriptor* descriptor) {
  *descriptor = {};
  descriptor->idVendor = 0x0694;
  descriptor->idProduct = 0x0002;
  descriptor->iSerialNumber = 3;
  return 0;
}
int LIBUSB_CALL libusb_open(libusb_device* /*device*/, libusb_device_handle** handle) {
  wait_while(fake_libusb().hang_in_open);
  if (fake_libusb().open_error != 0) return fake_libusb().open_error;
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
int LIBUSB_CALL libusb_get_configuration(libusb_device_handle* /*handle*/, int* number) {
  *number = fake_libusb().configuration;
  return fake_libusb().configuration_error;
}
int LIBUSB_CALL libusb_set_configuration(libusb_device_handle* /*handle*/, int number) {
  fake_libusb().configuration = number;
  return 0;
}
int LIBUSB_CALL libusb_claim_interface(libusb_device_handle* /*handle*/, int /*interface*/) {
  return fake_libusb().claim_error;
}
int LIBUSB_CALL libusb_reset_device(libusb_device_handle* /*handle*/) { return ++fake_libusb().resets, 0; }
int LIBUSB_CALL libusb_clear_halt(libusb_device_handle* /*handle*/, unsigned char /*endpoint*/) {
  ++fake_libusb().halts_cleared;
  return fake_libusb().clear_halt_error;
}
int LIBUSB_CALL libusb_get_max_packet_size(libusb_device* /*device*/, unsigned char /*endpoint*/) {
  return fake_libusb().packet;
}
int LIBUSB_CALL libusb_get_string_descriptor_ascii(libusb_device_handle* /*handle*/, std::uint8_t index,
                                                   unsigned char* data, int length) {
  const std::string& serial = fake_libusb().serial;
  if (index != 3 || length < static_cast<int>(serial.size())) return LIBUSB_ERROR_NOT_FOUND;
  std::copy(serial.begin(), serial.end(), data);
  return static_cast<int>(serial.size());
}
int LIBUSB_CALL libusb_hotplug_register_callback(libusb_context* context, int /*events*/, int /*flags*/, int /*vendor*/,
                                                 int /*product*/, int /*device_class*/,
                                                 libusb_hotplug_callback_fn function, void* user,
                                                 libusb_hotplug_callback_handle* handle) {
  if (fake_libusb().watch_error != 0) return fake_libusb().watch_error;
  context->watcher = function;
  context->watching = user;
  return *handle = 1, 0;
}
void LIBUSB_CALL libusb_hotplug_deregister_callback(libusb_context* context,
                                                    libusb_hotplug_callback_handle /*handle*/) {
  context->watcher = nullptr;
}

libusb_transfer* LIBUSB_CALL libusb_alloc_transfer(int /*packets*/) {
  ++fake_libusb().transfers;
  return new libusb_transfer{};
}
void LIBUSB_CALL libusb_free_transfer(libusb_transfer* transfer) {
  --fake_libusb().transfers;
  delete transfer;
}
int LIBUSB_CALL libusb_submit_transfer(libusb_transfer* transfer) {
  if (fake_libusb().submit_error != 0) return fake_libusb().submit_error;
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
  std::vector<Ended> ended;
  int event = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(limit->tv_sec) +
                   std::chrono::microseconds(limit->tv_usec);
  {
    std::unique_lock lock(context->mutex);
    while (!context->interrupted && std::chrono::steady_clock::now() < end && ended.empty() && event == 0) {
      context->news.wait_for(lock, std::chrono::milliseconds(1));
      ended = take_ended(*context);
      if (context->watcher != nullptr) event = fake_libusb().event.exchange(0);
    }
    context->interrupted = false;
  }
  if (event != 0) context->watcher(context, &the_device, static_cast<libusb_hotplug_event>(event), context->watching);
  for (const Ended& one : ended) finish(one);
  return 0;
}
void LIBUSB_CALL libusb_interrupt_event_handler(libusb_context* context) {
  const std::lock_guard lock(context->mutex);
  context->interrupted = true;
  context->news.notify_all();
}

}  // extern "C"
