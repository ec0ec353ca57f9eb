#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "hal/linux/descriptor.hpp"
#include "host/emulate/transport/transport.hpp"

namespace fencepost::emulate {
namespace {

using linux::Descriptor;

std::string remedy(int error, const std::string& interface) {
  switch (error) {
    case ENODEV:
      return "for a virtual one: 'sudo ip link add " + interface + " type vcan', 'sudo ip link set " + interface +
             " up'";
    case ENETDOWN: return "set it up with 'sudo ip link set " + interface + " up'";
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT: return "this kernel lacks SocketCAN; try 'sudo modprobe vcan'";
    default: return "see 'ip -details link show " + interface + "'";
  }
}

class CanPort final : public Transport {
 public:
  explicit CanPort(std::string interface) : interface_(std::move(interface)) {}

  [[nodiscard]] std::string place() const override { return interface_; }

  std::string plug_in() override {
    socket_ = Descriptor(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
    const int error = socket_.open() ? bind_to_interface() : errno;
    if (error == 0) return {};
    socket_.close();
    return linux::failure("send on the CAN interface", interface_, error, remedy(error, interface_)).sentence;
  }

  void hang_up() override { socket_.close(); }
  bool tend() override { return socket_.open(); }
  Bytes read() override { return {}; }

  std::size_t write(const Bytes& bytes) override {
    std::size_t lost = 0;
    for (std::size_t at = 0; at + sizeof(can_frame) <= bytes.size(); at += sizeof(can_frame)) {
      const ssize_t count = ::write(socket_.get(), bytes.data() + at, sizeof(can_frame));
      lost += count == static_cast<ssize_t>(sizeof(can_frame)) ? 0 : sizeof(can_frame);
    }
    return lost;
  }

  [[nodiscard]] int descriptor() const override { return -1; }

 private:
  int bind_to_interface() {
    ifreq request{};
    if (interface_.size() >= sizeof request.ifr_name) return ENODEV;
    std::memcpy(request.ifr_name, interface_.data(), interface_.size());
    if (::ioctl(socket_.get(), SIOCGIFFLAGS, &request) != 0) return errno;
    if ((static_cast<unsigned>(request.ifr_flags) & static_cast<unsigned>(IFF_UP)) == 0) return ENETDOWN;
    if (::ioctl(socket_.get(), SIOCGIFINDEX, &request) != 0) return errno;
    // Nothing is read here: without filters the kernel keeps nothing for us.
    ::setsockopt(socket_.get(), SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    const void* generic = &address;
    return ::bind(socket_.get(), static_cast<const sockaddr*>(generic), sizeof address) == 0 ? 0 : errno;
  }

  std::string interface_;
  Descriptor socket_;
};

}  // namespace

OpenedTransport open_can(const std::string& interface) {
  auto port = std::make_unique<CanPort>(interface);
  if (const std::string problem = port->plug_in(); !problem.empty()) return linux::Problem{problem};
  return OpenedTransport(std::move(port));
}

}  // namespace fencepost::emulate
