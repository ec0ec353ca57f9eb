// The thread behind a USB link: the only one that calls libusb.
#pragma once

#include <libusb-1.0/libusb.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/linux/retry.hpp"
#include "hal/linux/signal_flag.hpp"
#include "hal/linux/usb_device.hpp"
#include "hal/linux/usb_link.hpp"
#include "hal/linux/usb_transfer.hpp"

namespace fencepost::linux {

class UsbWorker {
 public:
  using Bytes = std::vector<std::uint8_t>;

  UsbWorker(UsbSettings settings, SignalFlag readable);
  /// After stop().
  ~UsbWorker();
  UsbWorker(const UsbWorker&) = delete;
  UsbWorker& operator=(const UsbWorker&) = delete;

  // The loop's side; none of these waits but the first two.
  /// Asks for a try and waits for its end, no longer than the timeout; whether the device is there.
  bool first_try();
  /// Asks the thread to end and waits likewise. False: it hangs, and destroys this worker when it comes back.
  [[nodiscard]] bool stop();
  void tend(base::Time now);
  base::Result<std::size_t> send(std::span<const std::uint8_t> out, bool whole);
  base::Result<std::size_t> receive(std::span<std::uint8_t> in);
  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  [[nodiscard]] bool connected() const;
  [[nodiscard]] std::string problem() const;
  [[nodiscard]] UsbCounters counters() const;
  [[nodiscard]] int descriptor() const { return readable_.descriptor(); }

 private:
  // The thread's side.
  void run();
  void end();
  bool asked_to_stop();
  bool take_request();
  void look_for_device();
  std::string renew_context();
  void release_context();
  void watch_plugging();
  void keep_transfers_going();
  void submit_reads();
  void submit_write();
  void restart_halted();
  bool restart(unsigned char endpoint);
  void let_go();
  bool take_transfers_back();
  void abandon();
  void make_transfers();
  void wait_for_events();
  void after_transfer(const UsbTransfer& transfer);
  void take_read(const UsbTransfer& transfer);
  void take_write(const UsbTransfer& transfer);
  void count_failure(std::uint32_t UsbCounters::*counter);
  static int LIBUSB_CALL on_plugging(libusb_context* context, libusb_device* device, libusb_hotplug_event event,
                                     void* worker);

  // Both sides.
  void wake();
  [[nodiscard]] base::Error nothing_to_read();
  void drop_front();
  [[nodiscard]] std::chrono::microseconds timeout() const {
    return std::chrono::microseconds(settings_.timeout.raw * 100);
  }

  static constexpr std::size_t kReads = 4;    ///< in flight: the device never waits for the thread to ask again
  static constexpr std::size_t kInbox = 64;   ///< telegrams; beyond it the device is not asked for more
  static constexpr std::size_t kOutbox = 8;   ///< telegrams
  static constexpr int kFailuresInARow = 10;  ///< then the device is closed, and opened again by tend()

  const UsbSettings settings_;

  mutable std::mutex mutex_;  ///< of the members below, up to `readable_`
  std::condition_variable tried_;
  std::deque<Bytes> inbox_;
  std::size_t front_used_ = 0;  ///< bytes of the front telegram that read() has taken
  std::deque<Bytes> outbox_;
  std::string problem_;
  UsbCounters counters_;
  std::size_t packet_ = 0;
  bool connected_ = false;
  bool requested_ = true;
  bool first_try_done_ = false;
  bool stop_ = false;
  bool finished_ = false;   ///< the thread has ended
  bool abandoned_ = false;  ///< the thread hung and owns the worker now
  bool starved_ = false;    ///< reads wait for room in the inbox
  libusb_context* to_wake_ = nullptr;
  SignalFlag readable_;

  Retry retry_;  ///< the loop's

  // The thread's, from here on.
  UsbContext context_;
  libusb_hotplug_callback_handle watch_ = 0;
  UsbDevice device_;
  std::vector<std::unique_ptr<UsbTransfer>> reads_;
  std::unique_ptr<UsbTransfer> write_;
  bool gone_ = false;
  bool arrived_ = false;
  bool read_halted_ = false;
  bool write_halted_ = false;
  int failures_ = 0;
  std::thread thread_;  ///< last, so that it starts when the others are there
};

}  // namespace fencepost::linux
