#include "hal/linux/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace fencepost::linux {
namespace {

std::string can_remedy(int error, const std::string& interface) {
  switch (error) {
    case ENODEV: return "plug the adapter in; 'ip link show type can' lists what is there";
    case ENETDOWN: return "set it up with 'sudo ip link set " + interface + " up type can bitrate 500000'";
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT: return "this kernel lacks SocketCAN; try 'sudo modprobe can-raw'";
    case EINVAL: return "an interface name has 1 to 15 characters, such as can0";
    default: return "see 'ip -details link show " + interface + "' and the end of 'dmesg'";
  }
}

}  // namespace

Descriptor make_can_socket(int& error) {
  Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  error = socket.open() ? 0 : errno;
  return socket;
}

int bind_can_if_up(int fd, const std::string& interface) {
  ifreq request{};
  if (interface.empty() || interface.size() >= sizeof request.ifr_name) return EINVAL;
  std::memcpy(request.ifr_name, interface.data(), interface.size());
  if (::ioctl(fd, SIOCGIFFLAGS, &request) != 0) return errno;
  if ((static_cast<unsigned>(request.ifr_flags) & static_cast<unsigned>(IFF_UP)) == 0) return ENETDOWN;
  if (::ioctl(fd, SIOCGIFINDEX, &request) != 0) return errno;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = request.ifr_ifindex;
  const void* anything = &address;
  return ::bind(fd, static_cast<const sockaddr*>(anything), sizeof address) == 0 ? 0 : errno;
}

Problem can_problem(std::string_view what, const std::string& interface, int error) {
  return failure(what, interface, error, can_remedy(error, interface));
}

}  // namespace fencepost::linux
