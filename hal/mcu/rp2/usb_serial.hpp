// A serial line on USB: the part's own device controller, fed by its interrupt.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/rings.hpp"
#include "hal/mcu/rp2/usb_descriptors.hpp"

namespace fencepost::mcu::rp2 {

/// kGone unless a program on the host has the port open: DTR is set, the cable is in, the host is awake. Bytes still
/// queued when it closes are discarded.
class UsbSerial {
 public:
  /// Once, before all else here, with a clock of 48 MHz running. `id`: the serial number; 0 or all ones: it has none.
  void start(std::uint64_t id);

  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);
  /// Bytes that write() would take now.
  [[nodiscard]] std::size_t room() const { return open() ? rings_.room() : 0; }
  [[nodiscard]] bool open() const { return configured_ && ready_ && !suspended_; }
  [[nodiscard]] bool waiting() const { return rings_.waiting(); }
  /// Once, after a program has opened it.
  [[nodiscard]] bool take_opened() {
    const bool opened = opened_;
    if (opened) opened_ = false;
    return opened;
  }

  /// Once, after it was open and no longer is.
  [[nodiscard]] bool take_gone() {
    const bool gone = gone_;
    if (gone) gone_ = false;
    return gone;
  }

  /// Once, after a program has opened it at 1200 baud and closed it, as Arduino's tools ask for the boot loader.
  [[nodiscard]] bool take_loader_wanted() {
    const bool wanted = loader_wanted_;
    if (wanted) loader_wanted_ = false;
    return wanted;
  }

  /// The controller's interrupt.
  void on_interrupt();

 private:
  struct Setup {
    std::uint8_t type = 0;
    std::uint8_t request = 0;
    std::uint16_t value = 0;
    std::uint16_t index = 0;
    std::uint16_t length = 0;
  };

  void begin_frame();
  void take_buffers();
  void bus_reset();
  void take_setup();
  [[nodiscard]] bool obey(const Setup& setup);
  [[nodiscard]] bool describe(const Setup& setup);
  void configure();
  void set_ready(bool ready);
  void close();
  void clear_halt(std::uint16_t endpoint);

  void answer(std::span<const std::uint8_t> bytes, std::size_t wanted);
  void answer_more();
  void acknowledge();
  void refuse();
  void control_sent();
  void control_received();

  void take_data();
  void ask_for_data();
  void send_data();
  void hand_over();

  Rings<1024, 2048> rings_;
  volatile bool configured_ = false;
  volatile bool ready_ = false;  ///< the other side's program is
  volatile bool suspended_ = false;
  volatile bool opened_ = false;
  volatile bool gone_ = false;
  volatile bool loader_wanted_ = false;

  std::array<std::uint8_t, 18> device_ = usb::kDevice;
  usb::SerialNumber serial_number_{};

  // Of the control pipe, in one request.
  std::span<const std::uint8_t> answer_;
  bool more_to_answer_ = false;
  bool second_answer_ = false;    ///< its packet is a DATA1
  std::uint8_t address_ = 0;      ///< to be used after the acknowledgement
  bool line_coding_due_ = false;  ///< comes next, and is kept as it came

  bool asking_ = false;  ///< for data; else the ring had no room
  bool sending_ = false;
  bool waits_ = false;             ///< the packet, for the next frame
  bool steady_ = false;            ///< the last two frames were as long as a frame is
  std::uint32_t frame_began_ = 0;  ///< us
  std::size_t packet_ = 0;         ///< bytes of what is being sent
  bool second_in_ = false;         ///< the next packet is a DATA1
  bool second_out_ = false;
  std::array<std::uint8_t, 7> line_coding_ = {0x00, 0xC2, 0x01, 0x00, 0, 0, 8};  ///< 115200 8N1, and of no effect
};

static_assert(bus::ByteLink<UsbSerial>);

}  // namespace fencepost::mcu::rp2
