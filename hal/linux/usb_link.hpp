// Two bulk endpoints of a USB device (libusb), as telegrams or as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/bus/packet_link.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/usb_settings.hpp"

namespace fencepost::linux {

class UsbWorker;

/// Ends its thread, and waits for that no longer than the settings' timeout. A thread that hangs in libusb or in the
/// kernel keeps the worker and destroys it when it returns.
struct EndUsbWorker {
  void operator()(UsbWorker* worker) const;
};
using UsbWorkerOwner = std::unique_ptr<UsbWorker, EndUsbWorker>;

/// Failures on a link that is still there, since it was opened.
struct UsbCounters {
  std::uint32_t stalls = 0;        ///< the device halted a pipe; it was started again
  std::uint32_t errors = 0;        ///< transfers that failed otherwise (noise, babble): their bytes are lost
  std::uint32_t out_timeouts = 0;  ///< telegrams that the device did not take within a second: lost
};

/// Shared by both links. All of libusb is done by a thread of its own: no call waits, whatever the device does. Both
/// directions queue a bounded number of transfers; a device is not asked for more while nobody reads. After an unplug,
/// `tend` finds the device again by its ids and serial number. Bytes that came before are read first.
class UsbPipes {
 public:
  UsbPipes(const UsbPipes&) = delete;
  UsbPipes& operator=(const UsbPipes&) = delete;

  /// Once per loop iteration; looks for a missing device, at most every kRetryInterval. One that is plugged in while
  /// udev runs is found without.
  void tend(base::Time now);
  [[nodiscard]] bool connected() const;
  /// Why the last try to open it again failed; empty when none did.
  [[nodiscard]] std::string problem() const;
  [[nodiscard]] UsbCounters counters() const;
  /// For WaitSet: readable when there is something to read, or after an unplug.
  [[nodiscard]] int descriptor() const;

 protected:
  explicit UsbPipes(UsbWorkerOwner worker);
  ~UsbPipes();
  UsbPipes(UsbPipes&&) noexcept;
  UsbPipes& operator=(UsbPipes&&) noexcept;

  UsbWorkerOwner worker_;
};

/// One transfer a telegram; one of at most an endpoint's packet (64 bytes at full speed, 512 at high speed).
class UsbPacketLink final : public UsbPipes {
 public:
  /// Waits for the first try to end, a few milliseconds where the device answers, at most the settings' timeout.
  /// errors: a sentence: no such device, not allowed, in use by another program, no answer.
  static Opened<UsbPacketLink> open(const UsbSettings& settings);

  /// errors also: kRefused: longer than a packet.
  base::Result<std::size_t> send(std::span<const std::uint8_t> out);
  base::Result<std::size_t> receive(std::span<std::uint8_t> in);

 private:
  using UsbPipes::UsbPipes;
};

/// The same as a stream; each write becomes one transfer, of at most one packet.
class UsbByteLink final : public UsbPipes {
 public:
  /// As UsbPacketLink::open.
  static Opened<UsbByteLink> open(const UsbSettings& settings);

  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

 private:
  using UsbPipes::UsbPipes;
};

static_assert(bus::PacketLink<UsbPacketLink>);
static_assert(bus::ByteLink<UsbByteLink>);

}  // namespace fencepost::linux
