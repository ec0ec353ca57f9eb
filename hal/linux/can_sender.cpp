#include "hal/linux/can_sender.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "hal/linux/can_socket.hpp"

namespace fencepost::linux {
namespace {

constexpr std::string_view kSend = "send on the CAN interface";

Opened<Descriptor> open_socket(const std::string& interface) {
  int error = 0;
  Descriptor socket = make_can_socket(error);
  // Nothing is read here: without filters the kernel keeps nothing for us.
  if (error == 0 && ::setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) != 0) error = errno;
  if (error == 0) error = bind_can_if_up(socket.get(), interface);
  if (error != 0) return can_problem(kSend, interface, error);
  return socket;
}

can_frame as_kernel_frame(const bus::CanFrame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U);
  raw.can_dlc = frame.length;
  std::copy_n(frame.data.begin(), frame.length, static_cast<std::uint8_t*>(raw.data));
  return raw;
}

}  // namespace

Opened<CanSender> CanSender::open(std::string interface) {
  Opened<Descriptor> socket = open_socket(interface);
  if (!socket) return Problem{socket.problem()};
  return CanSender(std::move(interface), std::move(*socket));
}

bool CanSender::send(const bus::CanFrame& frame) {
  if (!socket_.open()) return false;
  const can_frame raw = as_kernel_frame(frame);
  if (::write(socket_.get(), &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw)) {
    problem_.clear();
    return true;
  }
  const int error = errno;
  if (error == EAGAIN || error == ENOBUFS) {
    problem_ = failure(kSend, interface_, error,
                       "frames wait in vain: is another node on the bus, with the same bit rate and a terminator?")
                   .sentence;
  } else if (error != EINTR) {
    problem_ = can_problem(kSend, interface_, error).sentence;
    socket_.close();
  }
  return false;
}

void CanSender::tend(base::Time now) {
  if (socket_.open() || !retry_.due(now)) return;
  Opened<Descriptor> socket = open_socket(interface_);
  problem_ = socket ? std::string() : socket.problem();
  if (socket) socket_ = std::move(*socket);
}

}  // namespace fencepost::linux
