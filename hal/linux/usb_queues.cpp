// The loop's side of UsbWorker: two queues under a lock.
#include <algorithm>
#include <utility>

#include "hal/linux/usb_worker.hpp"

namespace fencepost::linux {

using base::Error;
using base::Result;

bool UsbWorker::first_try() {
  std::unique_lock lock(mutex_);
  if (tried_.wait_for(lock, timeout(), [this] { return first_try_done_; })) return connected_;
  problem_ = "cannot open the USB device " + name_of(settings_) +
             ": the system did not come back from it; unplug it, plug it in again and look at the end of 'dmesg'";
  return false;
}

void UsbWorker::tend(base::Time now) {
  const std::lock_guard lock(mutex_);
  if (connected_ || !retry_.due(now)) return;
  requested_ = true;
  wake();
}

Result<std::size_t> UsbWorker::send(std::span<const std::uint8_t> out, bool whole) {
  const std::lock_guard lock(mutex_);
  if (!connected_) return Error::kGone;
  if (whole && out.size() > packet_) return Error::kRefused;
  if (outbox_.size() >= kOutbox) return Error::kFull;
  const std::span<const std::uint8_t> taken = out.first(std::min(out.size(), packet_));
  if (taken.empty()) return std::size_t{0};
  outbox_.emplace_back(taken.begin(), taken.end());
  wake();
  return taken.size();
}

Result<std::size_t> UsbWorker::receive(std::span<std::uint8_t> in) {
  const std::lock_guard lock(mutex_);
  if (inbox_.empty()) return nothing_to_read();
  const std::size_t size = inbox_.front().size();
  const bool fits = size <= in.size();
  if (fits) std::copy(inbox_.front().begin(), inbox_.front().end(), in.begin());
  drop_front();
  if (!fits) return Error::kBadInput;
  return size;
}

Result<std::size_t> UsbWorker::read(std::span<std::uint8_t> in) {
  const std::lock_guard lock(mutex_);
  if (inbox_.empty()) return nothing_to_read();
  std::size_t count = 0;
  while (count < in.size() && !inbox_.empty()) {
    const Bytes& front = inbox_.front();
    const std::size_t part = std::min(in.size() - count, front.size() - front_used_);
    std::copy_n(front.begin() + static_cast<std::ptrdiff_t>(front_used_), part,
                in.begin() + static_cast<std::ptrdiff_t>(count));
    count += part;
    front_used_ += part;
    if (front_used_ == front.size()) drop_front();
  }
  return count;
}

Error UsbWorker::nothing_to_read() {
  readable_.clear();
  return connected_ ? Error::kNotReady : Error::kGone;
}

void UsbWorker::drop_front() {
  inbox_.pop_front();
  front_used_ = 0;
  if (inbox_.empty() && connected_) readable_.clear();  // an unplug is reported by nothing_to_read()
  if (std::exchange(starved_, false)) wake();
}

bool UsbWorker::connected() const {
  const std::lock_guard lock(mutex_);
  return connected_;
}

std::string UsbWorker::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

UsbCounters UsbWorker::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

void UsbWorker::wake() {
  tried_.notify_all();
  if (to_wake_ != nullptr) libusb_interrupt_event_handler(to_wake_);
}

}  // namespace fencepost::linux
