#include "hal/mcu/rp2/usb_serial.hpp"

#include <algorithm>

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "hal/mcu/rp2/timer_clock.hpp"
#include "hal/mcu/rp2/usb_buffers.hpp"

namespace fencepost::mcu::rp2 {
namespace {

// A packet of less than 64 bytes ends a transfer (USB 2.0 5.8.3): hosts then hand it on at once.
constexpr std::size_t kShort = usb::kPacket - 1;
constexpr std::uint16_t kToHost = 0x80;  // in an endpoint's address
constexpr std::uint32_t kLoaderBaud = 1200;

// Erratum RP2040-E15: behind some hubs a bulk buffer that is handed over at a frame's end can lock the controller up.
// An interrupt that was held tells of a frame too late: the one before is too long. All in us.

constexpr std::uint32_t kFrame = 1'000;   // USB 2.0 7.1.12
constexpr std::uint32_t kFrameEnd = 200;  // in which nothing is handed over
constexpr std::uint32_t kLate = 50;       // an interrupt, at most
constexpr std::uint32_t kFilling = 20;    // a buffer, with its handing over

}  // namespace

void UsbSerial::start(std::uint64_t id) {
  if (id != 0 && ~id != 0) {
    device_[usb::kSerialIndexAt] = usb::kSerialIndex;
    serial_number_ = usb::serial_number(id);
  }
  bring_up(kResetUsb);
  usb::clear_memory();
  reg(kUsbMux) = kUsbToPhy;
  reg(kUsbPower) = kUsbForcePowered;
  reg(kUsbControl) = kUsbControllerOn;
  reg(kUsbSieControl) = kUsbTellEachEp0Buffer;
  usb::set_up_endpoints();
  reg(kUsbInterruptEnable) = kUsbTellBuffers | kUsbTellBusReset | kUsbTellSetup | kUsbTellSuspend | kUsbTellResume;
  cortex_m::enable_interrupt(kInterruptUsb);
  raise_bits(kUsbSieControl, kUsbPullUp);
}

base::Result<std::size_t> UsbSerial::read(std::span<std::uint8_t> in) {
  const base::Result<std::size_t> got = rings_.read(in);
  const cortex_m::InterruptsHeld held;
  if (configured_ && !asking_) ask_for_data();
  if (!got && got.error() == base::Error::kNotReady && !open()) return base::Error::kGone;
  return got;
}

base::Result<std::size_t> UsbSerial::write(std::span<const std::uint8_t> out) {
  if (!open()) return base::Error::kGone;
  const base::Result<std::size_t> taken = rings_.write(out);
  const cortex_m::InterruptsHeld held;
  if (!sending_) send_data();
  return taken;
}

void UsbSerial::on_interrupt() {
  const std::uint32_t what = reg(kUsbInterruptStatus);
  if ((what & kUsbTellSuspend) != 0) {
    lower_bits(kUsbSieStatus, kUsbSuspended);
    if (open()) gone_ = true;
    suspended_ = true;
  }
  if ((what & ~kUsbTellSuspend) != 0) suspended_ = false;
  if ((what & kUsbTellResume) != 0) lower_bits(kUsbSieStatus, kUsbResumed);
  if ((what & kUsbTellFrame) != 0) begin_frame();
  // A buffer that is done belongs to the request before the one that has come meanwhile: it is taken first.
  take_buffers();
  if ((what & kUsbTellBusReset) != 0) bus_reset();
  if ((what & kUsbTellSetup) != 0) take_setup();
}

void UsbSerial::begin_frame() {
  [[maybe_unused]] const std::uint32_t number = reg(kUsbFrame);
  const std::uint32_t now = TimerClock::microseconds();
  const std::uint32_t length = now - frame_began_;
  steady_ = length >= kFrame - kLate && length <= kFrame + kLate;
  frame_began_ = now;
  if (waits_) hand_over();
}

void UsbSerial::take_buffers() {
  const std::uint32_t buffers = reg(kUsbBufferStatus);
  lower_bits(kUsbBufferStatus, buffers);
  if ((buffers & usb::buffer_bit(0, usb::kIn)) != 0) control_sent();
  if ((buffers & usb::buffer_bit(0, usb::kOut)) != 0) control_received();
  if ((buffers & usb::buffer_bit(usb::kDataEndpoint, usb::kIn)) != 0) send_data();
  if ((buffers & usb::buffer_bit(usb::kDataEndpoint, usb::kOut)) != 0) take_data();
}

void UsbSerial::bus_reset() {
  lower_bits(kUsbSieStatus, kUsbBusReset);
  reg(kUsbAddress) = 0;
  address_ = 0;
  configured_ = false;
  close();
}

void UsbSerial::take_setup() {
  lower_bits(kUsbSieStatus, kUsbSetupReceived);
  line_coding_due_ = false;
  // A host may give a request up: what was to be sent and received of it is not of this one.
  static_cast<void>(usb::withdraw(0, usb::kIn));
  static_cast<void>(usb::withdraw(0, usb::kOut));
  const std::uint32_t first = reg(kUsbMemory);
  const std::uint32_t second = reg(kUsbMemory + 4);
  const Setup setup = {static_cast<std::uint8_t>(first & 0xFF), static_cast<std::uint8_t>((first >> 8) & 0xFF),
                       static_cast<std::uint16_t>(first >> 16), static_cast<std::uint16_t>(second & 0xFFFF),
                       static_cast<std::uint16_t>(second >> 16)};
  if (!obey(setup)) refuse();
}

bool UsbSerial::obey(const Setup& setup) {
  constexpr std::uint8_t kFromDevice = 0x80;
  constexpr std::uint8_t kOfEndpoint = 0x02;
  const bool of_class = (setup.type & 0x60) == 0x20;
  if (of_class && setup.request == usb::kSetControlLineState) {
    set_ready((setup.value & 1U) != 0);
  } else if (of_class && setup.request == usb::kSetLineCoding) {
    line_coding_due_ = true;
    usb::arm(0, usb::kOut, usb::kPacket, true);
    return true;
  } else if (of_class && setup.request == usb::kGetLineCoding) {
    answer(line_coding_, setup.length);
    return true;
  } else if (setup.type == 0 && setup.request == usb::kSetAddress) {
    address_ = static_cast<std::uint8_t>(setup.value & 0x7F);
  } else if (setup.type == 0 && setup.request == usb::kSetConfiguration) {
    configure();
  } else if (setup.type == kOfEndpoint && setup.request == usb::kClearFeature) {
    clear_halt(setup.index);
  } else if (setup.type == kFromDevice) {
    return describe(setup);
  } else if ((setup.type & kFromDevice) != 0 || setup.length != 0) {
    return false;
  }
  acknowledge();
  return true;
}

bool UsbSerial::describe(const Setup& setup) {
  static constexpr std::array<std::uint8_t, 2> kOne = {1, 0};
  static constexpr std::array<std::uint8_t, 2> kNothing = {0, 0};
  const std::uint32_t kind = setup.value >> 8;
  if (setup.request == usb::kGetConfiguration) {
    answer(std::span(configured_ ? kOne : kNothing).first(1), setup.length);
  } else if (setup.request == 0) {  // get status: nothing to tell
    answer(kNothing, setup.length);
  } else if (setup.request != usb::kGetDescriptor) {
    return false;
  } else if (kind == 1) {
    answer(device_, setup.length);
  } else if (kind == 2) {
    answer(usb::kConfiguration, setup.length);
  } else if (setup.value == (3U << 8)) {
    answer(usb::kLanguage, setup.length);
  } else if (kind == 3 && (setup.value & 0xFF) <= 2) {  // maker, product
    answer(usb::kName, setup.length);
  } else if (setup.value == (3U << 8 | usb::kSerialIndex) && device_[usb::kSerialIndexAt] != 0) {
    answer(serial_number_, setup.length);
  } else {
    return false;
  }
  return true;
}

void UsbSerial::configure() {
  close();
  static_cast<void>(usb::withdraw(usb::kDataEndpoint, usb::kOut));  // of the configuration before
  second_in_ = second_out_ = false;
  configured_ = true;
  ask_for_data();
}

void UsbSerial::set_ready(bool ready) {
  const std::uint32_t baud = static_cast<std::uint32_t>(line_coding_[0]) |
                             static_cast<std::uint32_t>(line_coding_[1]) << 8 |
                             static_cast<std::uint32_t>(line_coding_[2]) << 16;
  if (!ready && ready_ && baud == kLoaderBaud) loader_wanted_ = true;
  if (!ready) close();
  if (ready && !ready_) {
    opened_ = true;
    [[maybe_unused]] const std::uint32_t number = reg(kUsbFrame);  // one of long ago
    raise_bits(kUsbInterruptEnable, kUsbTellFrame);
  }
  ready_ = ready;
}

// The port is closed, or was: a program that opens it starts afresh. A packet that nobody has fetched is taken back,
// and its number in the sequence is the next one's.
void UsbSerial::close() {
  if (ready_) gone_ = true;
  ready_ = false;
  if (sending_ && usb::withdraw(usb::kDataEndpoint, usb::kIn)) second_in_ = !second_in_;
  sending_ = waits_ = false;
  lower_bits(kUsbInterruptEnable, kUsbTellFrame);
  std::uint8_t byte = 0;
  while (rings_.next(byte)) {
  }
}

// The sequence begins anew (USB 2.0 9.4.5), that of a packet that waits, too.
void UsbSerial::clear_halt(std::uint16_t endpoint) {
  if (endpoint == (kToHost | usb::kDataEndpoint)) {
    const bool again = sending_ && usb::withdraw(usb::kDataEndpoint, usb::kIn);
    second_in_ = false;
    if (again) hand_over();
  } else if (endpoint == usb::kDataEndpoint) {
    const bool again = asking_ && usb::withdraw(usb::kDataEndpoint, usb::kOut);
    if (again) usb::arm(usb::kDataEndpoint, usb::kOut, usb::kPacket, false);
    second_out_ = again;
  }
}

void UsbSerial::answer(std::span<const std::uint8_t> bytes, std::size_t wanted) {
  answer_ = bytes.first(std::min(bytes.size(), wanted));
  second_answer_ = true;  // the first packet after a setup is a DATA1 (USB 2.0 8.5.3)
  usb::arm(0, usb::kOut, usb::kPacket, true);
  answer_more();
}

// A full last packet is followed by an empty one, unless the host knows the length. No answer here is a multiple of 64.
void UsbSerial::answer_more() {
  const auto part = answer_.first(std::min<std::size_t>(answer_.size(), usb::kPacket));
  answer_ = answer_.subspan(part.size());
  more_to_answer_ = !answer_.empty();
  usb::fill(0, usb::kIn, part);
  usb::arm(0, usb::kIn, part.size(), second_answer_);
  second_answer_ = !second_answer_;
}

void UsbSerial::acknowledge() {
  more_to_answer_ = false;
  usb::arm(0, usb::kIn, 0, true);
}

void UsbSerial::refuse() {
  more_to_answer_ = false;
  reg(kUsbStallArm) = 3;
  usb::stall(0);
}

void UsbSerial::control_sent() {
  if (address_ != 0) {
    reg(kUsbAddress) = address_;
    address_ = 0;
  } else if (more_to_answer_) {
    answer_more();
  }
}

void UsbSerial::control_received() {
  if (!line_coding_due_) return;
  line_coding_due_ = false;
  usb::copy_out(0, usb::kOut, line_coding_);
  acknowledge();
}

void UsbSerial::take_data() {
  asking_ = false;
  usb::for_each_byte(usb::kDataEndpoint, usb::kOut, [this](std::uint8_t byte) { rings_.received(byte); });
  ask_for_data();
}

// The host waits while there is no room.
void UsbSerial::ask_for_data() {
  if (rings_.receive_room() < usb::kPacket) return;
  asking_ = true;
  usb::arm(usb::kDataEndpoint, usb::kOut, usb::kPacket, second_out_);
  second_out_ = !second_out_;
}

void UsbSerial::send_data() {
  sending_ = false;
  if (!open()) return;
  std::array<std::uint8_t, kShort> packet{};
  std::size_t count = 0;
  while (count < packet.size() && rings_.next(packet[count])) ++count;
  if (count == 0) return;
  sending_ = true;
  packet_ = count;
  usb::fill(usb::kDataEndpoint, usb::kIn, std::span(packet).first(count));
  hand_over();
}

// Now, or when the next frame begins.
void UsbSerial::hand_over() {
  const std::uint32_t in_frame = TimerClock::microseconds() - frame_began_;
  waits_ = !steady_ || in_frame > kFrame - kFrameEnd - kLate - kFilling;
  if (waits_) return;
  usb::arm(usb::kDataEndpoint, usb::kIn, packet_, second_in_);
  second_in_ = !second_in_;
}

}  // namespace fencepost::mcu::rp2
