#include "hal/linux/usb_worker.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace fencepost::linux {
namespace {

/// Of one telegram: a working device takes it within milliseconds.
constexpr unsigned kWriteTimeoutMs = 1000;

}  // namespace

UsbWorker::UsbWorker(UsbSettings settings, SignalFlag readable)
    : settings_(std::move(settings)), readable_(std::move(readable)) {
  make_transfers();
  thread_ = std::thread([this] {
    run();
    end();
  });
}

UsbWorker::~UsbWorker() {
  if (thread_.joinable()) thread_.join();
}

bool UsbWorker::stop() {
  std::unique_lock lock(mutex_);
  stop_ = true;
  wake();
  if (tried_.wait_for(lock, timeout(), [this] { return finished_; })) return true;
  abandoned_ = true;
  thread_.detach();
  return false;
}

void UsbWorker::make_transfers() {
  reads_.clear();
  for (std::size_t i = 0; i < kReads; ++i)
    reads_.push_back(std::make_unique<UsbTransfer>([this](const UsbTransfer& done) { take_read(done); }));
  write_ = std::make_unique<UsbTransfer>([this](const UsbTransfer& done) { take_write(done); });
}

void UsbWorker::run() {
  while (!asked_to_stop()) {
    if (!device_.handle && take_request()) look_for_device();
    if (device_.handle) keep_transfers_going();
    if (gone_) {
      let_go();
      continue;
    }
    wait_for_events();
  }
  if (device_.handle) let_go();
  release_context();
}

// The owner destroys the worker once it is over, unless it has given up waiting for that.
void UsbWorker::end() {
  bool mine = false;
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    mine = abandoned_;
    tried_.notify_all();
  }
  if (mine) delete this;
}

bool UsbWorker::asked_to_stop() {
  const std::lock_guard lock(mutex_);
  return stop_;
}

bool UsbWorker::take_request() {
  const std::lock_guard lock(mutex_);
  return std::exchange(requested_, false) || std::exchange(arrived_, false);
}

void UsbWorker::look_for_device() {
  arrived_ = false;
  std::string problem = renew_context();
  Opened<UsbDevice> device =
      context_ ? open_usb_device(context_.get(), settings_) : Opened<UsbDevice>(Problem{std::move(problem)});
  const std::lock_guard lock(mutex_);
  problem_ = device ? std::string() : device.problem();
  if (device) {
    device_ = std::move(*device);
    packet_ = device_.packet;
    connected_ = true;
    failures_ = 0;
    readable_.raise();
  }
  first_try_done_ = true;
  tried_.notify_all();
}

// Where udev runs, libusb hears from it what came and went, and a context is kept. Elsewhere only a fresh context sees
// what is there.
std::string UsbWorker::renew_context() {
  if (context_ && udev_runs()) return {};
  release_context();
  Opened<UsbContext> context = open_usb();
  if (!context) return context.problem();
  context_ = std::move(*context);
  watch_plugging();
  const std::lock_guard lock(mutex_);
  to_wake_ = context_.get();
  return {};
}

void UsbWorker::release_context() {
  {
    const std::lock_guard lock(mutex_);
    to_wake_ = nullptr;
  }
  // It may be put aside for another worker, which must not hear of ours.
  if (context_ && watch_ != 0) libusb_hotplug_deregister_callback(context_.get(), std::exchange(watch_, 0));
  context_.reset();
}

// Where this fails, as without udev, tend() finds the device all the same.
void UsbWorker::watch_plugging() {
  constexpr int kEvents = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  const int error = libusb_hotplug_register_callback(context_.get(), kEvents, 0, settings_.vendor, settings_.product,
                                                     LIBUSB_HOTPLUG_MATCH_ANY, &on_plugging, this, &watch_);
  if (error != 0) watch_ = 0;
}

// Called by this thread, from within libusb.
int LIBUSB_CALL UsbWorker::on_plugging(libusb_context* /*context*/, libusb_device* device, libusb_hotplug_event event,
                                       void* worker) {
  auto* self = static_cast<UsbWorker*>(worker);
  if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED) self->arrived_ = true;
  libusb_device_handle* mine = self->device_.handle.get();
  if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT && mine != nullptr && libusb_get_device(mine) == device)
    self->gone_ = true;
  return 0;  // go on watching
}

void UsbWorker::keep_transfers_going() {
  restart_halted();
  if (!gone_) submit_reads();
  if (!gone_) submit_write();
  if (failures_ >= kFailuresInARow) gone_ = true;
}

void UsbWorker::submit_reads() {
  if (read_halted_) return;
  std::size_t room = 0;
  {
    const std::lock_guard lock(mutex_);
    const std::size_t used =
        inbox_.size() + static_cast<std::size_t>(
                            std::count_if(reads_.begin(), reads_.end(), [](const auto& r) { return r->in_flight(); }));
    room = kInbox - std::min(kInbox, used);
    starved_ = room < kReads;
  }
  for (auto& read : reads_) {
    if (read->in_flight() || room == 0) continue;
    --room;
    // One packet each: a transfer ends with its telegram, also with one that fills the packet.
    if (read->submit(device_.handle.get(), settings_.in_endpoint, Bytes(device_.packet), 0) != 0) gone_ = true;
    if (gone_) return;
  }
}

void UsbWorker::submit_write() {
  if (write_halted_ || write_->in_flight()) return;
  Bytes next;
  {
    const std::lock_guard lock(mutex_);
    if (outbox_.empty()) return;
    next = std::move(outbox_.front());
    outbox_.pop_front();
  }
  if (write_->submit(device_.handle.get(), settings_.out_endpoint, std::move(next), kWriteTimeoutMs) != 0) gone_ = true;
}

// A halt is cleared on an idle pipe, so that host and device restart with the same packet.
void UsbWorker::restart_halted() {
  if (read_halted_) {
    for (auto& read : reads_) read->cancel();
    const bool idle = std::none_of(reads_.begin(), reads_.end(), [](const auto& r) { return r->in_flight(); });
    if (idle) read_halted_ = !restart(settings_.in_endpoint);
  }
  if (write_halted_ && !write_->in_flight()) write_halted_ = !restart(settings_.out_endpoint);
}

bool UsbWorker::restart(unsigned char endpoint) {
  gone_ = libusb_clear_halt(device_.handle.get(), endpoint) != 0;
  return !gone_;
}

void UsbWorker::take_read(const UsbTransfer& transfer) {
  if (!transfer.bytes().empty()) {
    const std::lock_guard lock(mutex_);
    inbox_.emplace_back(transfer.bytes().begin(), transfer.bytes().end());
    readable_.raise();
  }
  if (transfer.status() == LIBUSB_TRANSFER_STALL) read_halted_ = true;
  after_transfer(transfer);
}

void UsbWorker::take_write(const UsbTransfer& transfer) {
  if (transfer.status() == LIBUSB_TRANSFER_STALL) write_halted_ = true;
  after_transfer(transfer);
}

void UsbWorker::after_transfer(const UsbTransfer& transfer) {
  switch (transfer.status()) {
    case LIBUSB_TRANSFER_COMPLETED: failures_ = 0; return;
    case LIBUSB_TRANSFER_CANCELLED: return;
    case LIBUSB_TRANSFER_NO_DEVICE: gone_ = true; return;
    case LIBUSB_TRANSFER_STALL: count_failure(&UsbCounters::stalls); return;
    case LIBUSB_TRANSFER_TIMED_OUT: count_failure(&UsbCounters::out_timeouts); return;
    default: count_failure(&UsbCounters::errors); return;
  }
}

void UsbWorker::count_failure(std::uint32_t UsbCounters::*counter) {
  ++failures_;
  const std::lock_guard lock(mutex_);
  ++(counters_.*counter);
}

// The kernel gives every transfer back before its device may be closed; of one that it keeps nothing may be touched.
void UsbWorker::let_go() {
  if (take_transfers_back()) {
    device_.handle.reset();
  } else {
    abandon();
  }
  gone_ = read_halted_ = write_halted_ = false;
  const std::lock_guard lock(mutex_);
  connected_ = false;
  outbox_.clear();
  readable_.raise();
}

bool UsbWorker::take_transfers_back() {
  const auto busy = [this] {
    return write_->in_flight() ||
           std::any_of(reads_.begin(), reads_.end(), [](const auto& r) { return r->in_flight(); });
  };
  for (auto& read : reads_) read->cancel();
  write_->cancel();
  timeval slice{0, 10'000};
  const auto deadline = std::chrono::steady_clock::now() + timeout();
  while (busy() && std::chrono::steady_clock::now() < deadline) {
    libusb_handle_events_timeout_completed(context_.get(), &slice, nullptr);
  }
  return !busy();
}

// Nobody handles the events of an abandoned context: none of its transfers calls back any more.
void UsbWorker::abandon() {
  struct Abandoned {
    UsbContext context;
    UsbDevice device;
    std::vector<std::unique_ptr<UsbTransfer>> transfers;
  };
  static auto* const kept = new std::deque<Abandoned>;  // until the program ends, and the kernel takes all
  static std::mutex mutex;
  {
    const std::lock_guard lock(mutex_);
    to_wake_ = nullptr;
  }
  watch_ = 0;
  reads_.push_back(std::move(write_));
  {
    const std::lock_guard lock(mutex);
    kept->push_back({std::move(context_), std::move(device_), std::move(reads_)});
  }
  device_ = {};
  make_transfers();
}

void UsbWorker::wait_for_events() {
  constexpr int kSeconds = 1;  // wake() ends it at once
  if (context_) {
    timeval limit{kSeconds, 0};
    libusb_handle_events_timeout_completed(context_.get(), &limit, nullptr);
    return;
  }
  std::unique_lock lock(mutex_);
  tried_.wait_for(lock, std::chrono::seconds(kSeconds), [this] { return stop_ || requested_; });
}

}  // namespace fencepost::linux
