#include "hal/linux/can.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "hal/linux/can_socket.hpp"

namespace fencepost::linux {
namespace {

using base::Error;

constexpr std::string_view kListen = "listen on the CAN interface";

// A lost arbitration is normal for a sender, not a bus error.
constexpr can_err_mask_t kErrors = CAN_ERR_MASK & ~static_cast<can_err_mask_t>(CAN_ERR_LOSTARB);

/// Two megabytes hold seconds of a full bus, where the kernel allows them.
constexpr int kReceiveBuffer = 2'000'000;

template <class T>
int set_option(int fd, int level, int option, const T& value) {
  return ::setsockopt(fd, level, option, &value, sizeof value) == 0 ? 0 : errno;
}

can_filter as_kernel_filter(const CanFilter& filter) {
  const canid_t bits = filter.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
  const canid_t kind = filter.extended ? CAN_EFF_FLAG : 0U;
  return {(filter.id & bits) | kind, (filter.mask & bits) | CAN_EFF_FLAG};
}

int set_filters(int fd, const std::vector<CanFilter>& filters) {
  if (filters.empty()) return 0;
  std::vector<can_filter> kernel(filters.size());
  std::transform(filters.begin(), filters.end(), kernel.begin(), as_kernel_filter);
  const auto bytes = static_cast<socklen_t>(kernel.size() * sizeof(can_filter));
  return ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, kernel.data(), bytes) == 0 ? 0 : errno;
}

int set_options(int fd, const std::vector<CanFilter>& filters) {
  if (const int error = set_filters(fd, filters); error != 0) return error;
  if (const int error = set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors); error != 0) return error;
  set_option(fd, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
  if (const int error = set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, 1); error != 0) return error;
  return set_option(fd, SOL_SOCKET, SO_TIMESTAMP, 1);
}

Opened<Descriptor> open_socket(const CanSettings& settings) {
  int error = 0;
  Descriptor socket = make_can_socket(error);
  if (error == 0) error = set_options(socket.get(), settings.filters);
  if (error == 0) error = bind_can_if_up(socket.get(), settings.interface);
  if (error != 0) return can_problem(kListen, settings.interface, error);
  return socket;
}

/// The kernel's notes beside a frame.
struct Notes {
  std::optional<timeval> stamp;
  std::uint32_t lost = 0;
};

Notes read_notes(msghdr& message) {
  Notes notes;
  for (cmsghdr* note = CMSG_FIRSTHDR(&message); note != nullptr; note = CMSG_NXTHDR(&message, note)) {
    if (note->cmsg_level != SOL_SOCKET) continue;
    if (note->cmsg_type == SO_TIMESTAMP) {
      notes.stamp.emplace();
      std::memcpy(&*notes.stamp, CMSG_DATA(note), sizeof(timeval));
    } else if (note->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&notes.lost, CMSG_DATA(note), sizeof notes.lost);
    }
  }
  return notes;
}

/// 0, EAGAIN: nothing there, EBADMSG: not a classic frame, or what is wrong with the interface.
int read_message(int fd, can_frame& raw, Notes& notes) {
  iovec whole{&raw, sizeof raw};
  alignas(cmsghdr) std::array<std::byte, 128> note_bytes{};
  msghdr message{};
  message.msg_iov = &whole;
  message.msg_iovlen = 1;
  message.msg_control = note_bytes.data();
  message.msg_controllen = note_bytes.size();
  const ssize_t count = ::recvmsg(fd, &message, 0);
  if (count < 0) return errno == EINTR ? EAGAIN : errno;
  notes = read_notes(message);
  return count == static_cast<ssize_t>(sizeof raw) ? 0 : EBADMSG;
}

// The kernel stamps by the wall clock; a frame's age is the same by every clock, unless one was set in the meantime.
std::optional<base::Time> by_clock(const timeval& stamp, const MonotonicClock& clock) {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  constexpr std::int64_t kTicks = base::Time::kPerUnit;
  const std::int64_t age = (wall.tv_sec - stamp.tv_sec) * kTicks + wall.tv_nsec / 100'000 - stamp.tv_usec / 100;
  constexpr std::int64_t kOldest = 10 * kTicks;
  if (age < 0 || age > kOldest) return std::nullopt;
  return clock.now() - base::Duration{age};
}

bus::CanFrame as_frame(const can_frame& raw) {
  bus::CanFrame frame;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
  frame.id = raw.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(raw.can_dlc, CAN_MAX_DLEN);
  std::copy_n(static_cast<const std::uint8_t*>(raw.data), frame.length, frame.data.begin());
  return frame;
}

}  // namespace

Opened<Can> Can::open(CanSettings settings, MonotonicClock clock) {
  Opened<Descriptor> socket = open_socket(settings);
  if (!socket) return Problem{socket.problem()};
  return Can(std::move(settings), clock, std::move(*socket));
}

base::Result<bus::CanFrame> Can::receive() {
  if (held_) return *std::exchange(held_, std::nullopt);
  if (!socket_.open()) return Error::kGone;
  can_frame raw{};
  Notes notes;
  int error = read_message(socket_.get(), raw, notes);
  if (error != 0 && error != EAGAIN) {
    // The error of an interface that went down is delivered before frames received earlier; it is reported once and the
    // frames are kept.
    down_ = error != EBADMSG;
    if (down_) error = read_message(socket_.get(), raw, notes);
  }
  if (error != 0) return fail(error);
  if ((raw.can_id & CAN_ERR_FLAG) != 0) return take_error_frame(raw.can_id);
  bus_off_ = false;
  bus::CanFrame frame = as_frame(raw);
  if (notes.stamp) frame.received = by_clock(*notes.stamp, clock_);
  if (std::exchange(lost_, notes.lost) == notes.lost) return frame;
  held_ = frame;
  return Error::kBadInput;
}

// linux/can/error.h: the kind of error is in the bits of the id.
base::Result<bus::CanFrame> Can::take_error_frame(std::uint32_t what) {
  if ((what & CAN_ERR_RESTARTED) != 0) bus_off_ = false;
  if ((what & CAN_ERR_BUSOFF) != 0) bus_off_ = true;
  return bus_off_ ? Error::kGone : Error::kBadInput;
}

base::Result<bus::CanFrame> Can::fail(int error) {
  if (error == EBADMSG) return Error::kBadInput;
  if (error == EAGAIN && !down_) return bus_off_ ? Error::kGone : Error::kNotReady;
  socket_.close();
  down_ = bus_off_ = false;
  lost_ = 0;
  return Error::kGone;
}

void Can::tend(base::Time now) {
  if (socket_.open() || !retry_.due(now)) return;
  Opened<Descriptor> socket = open_socket(settings_);
  problem_ = socket ? std::string() : socket.problem();
  if (socket) socket_ = std::move(*socket);
}

}  // namespace fencepost::linux
