// libusb without USB: one present device that accepts transfers and completes only those of its script. It also has the
// hangs of the real library.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace fencepost::test {

/// Each may be set and cleared at any time; a call that waits in there continues when it is cleared.
struct FakeLibusb {
  std::atomic<bool> hang_in_open = false;
  std::atomic<bool> hang_in_exit = false;
  std::atomic<bool> keep_transfers = false;  ///< a cancelled one is not given back
  std::atomic<bool> unplugged = false;       ///< transfers end, where they are not kept
  std::atomic<int> contexts = 0;             ///< that are not closed
  std::atomic<int> handles = 0;
  std::atomic<int> transfers = 0;  ///< allocated
  std::atomic<int> in_flight = 0;

  // Errors of libusb, 0: none.
  std::atomic<int> init_error = 0;
  std::atomic<int> list_error = 0;
  std::atomic<int> open_error = 0;
  std::atomic<int> claim_error = 0;
  std::atomic<int> configuration_error = 0;
  std::atomic<int> submit_error = 0;
  std::atomic<int> clear_halt_error = 0;
  std::atomic<int> watch_error = 0;
  std::atomic<int> configuration = 1;  ///< 0: none is chosen yet
  std::atomic<int> packet = 64;        ///< bytes
  std::atomic<int> resets = 0;
  std::atomic<int> halts_cleared = 0;
  std::atomic<int> event = 0;  ///< of hotplug, reported once

  // The device's treatment of the next transfers, under the lock.
  struct Read {
    int status = 0;  ///< a libusb_transfer_status
    std::vector<std::uint8_t> bytes;
  };
  std::mutex mutex;
  std::deque<Read> reads;                        ///< each ends one transfer of the input
  std::deque<int> write_statuses;                ///< each ends one of the output
  std::vector<std::vector<std::uint8_t>> heard;  ///< contents of completed outputs
  std::string serial = "0016530A1B2C";

  /// As it begins; call it where nothing runs.
  void restore();
};

FakeLibusb& fake_libusb();

}  // namespace fencepost::test
