#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hal/linux/descriptor.hpp"
#include "host/emulate/transport/transport.hpp"

namespace fencepost::emulate {
namespace {

using linux::Descriptor;

constexpr const char* kWhat = "listen on";

struct Address {
  std::string host = "127.0.0.1";
  std::string port;
};

/// Nothing if the port is no number from 0 to 65535.
bool split(const std::string& place, Address& address) {
  const std::size_t colon = place.rfind(':');
  address.port = colon == std::string::npos ? place : place.substr(colon + 1);
  if (colon != std::string::npos && colon > 0) address.host = place.substr(0, colon);
  if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
    address.host = address.host.substr(1, address.host.size() - 2);
  }
  const bool digits = address.port.find_first_not_of("0123456789") == std::string::npos;
  return !address.port.empty() && address.port.size() <= 5 && digits && std::stoi(address.port) <= 65'535;
}

std::string remedy(int error) {
  switch (error) {
    case EADDRINUSE: return "choose another port, or 0 for any free one";
    case EACCES: return "ports below 1024 need root; choose a higher one";
    case EADDRNOTAVAIL: return "that is no address of this machine; leave it away for 127.0.0.1";
    default: return "choose another port or address";
  }
}

class TcpPort final : public Transport {
 public:
  explicit TcpPort(sockaddr_storage address, socklen_t size) : address_(address), size_(size) {}

  [[nodiscard]] std::string place() const override {
    char host[NI_MAXHOST] = {};
    char port[NI_MAXSERV] = {};
    (void)::getnameinfo(generic(), size_, host, sizeof host, port, sizeof port, NI_NUMERICHOST | NI_NUMERICSERV);
    return (address_.ss_family == AF_INET6 ? "[" + std::string(host) + "]" : std::string(host)) + ":" + port;
  }

  std::string plug_in() override {
    listener_ = Descriptor(::socket(address_.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int on = 1;
    const bool open = listener_.open() &&
                      ::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                      ::bind(listener_.get(), generic(), size_) == 0 && ::listen(listener_.get(), 1) == 0;
    if (!open) {
      const int error = errno;
      listener_.close();
      return linux::failure(kWhat, place(), error, remedy(error)).sentence;
    }
    ::getsockname(listener_.get(), generic(), &size_);  // the port that was chosen
    return {};
  }

  void hang_up() override {
    host_.close();
    listener_.close();
  }

  bool tend() override {
    if (!listener_.open()) return false;
    // Whoever calls when the last host has just gone waits until that was read to its end.
    if (leaving()) return true;
    // One cable has one host: the second one's connection is closed.
    Descriptor caller(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (caller.open() && !host_.open()) {
      const int on = 1;
      ::setsockopt(caller.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      host_ = std::move(caller);
    }
    return host_.open();
  }

  Bytes read() override {
    Bytes bytes(4'096);
    const ssize_t count = host_.open() ? ::recv(host_.get(), bytes.data(), bytes.size(), 0) : -1;
    const bool gone = host_.open() && (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR));
    if (gone) host_.close();
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

  std::size_t write(const Bytes& bytes) override {
    const ssize_t count = host_.open() ? ::send(host_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) : 0;
    return bytes.size() - (count > 0 ? static_cast<std::size_t>(count) : 0);
  }

  [[nodiscard]] int descriptor() const override { return host_.open() ? host_.get() : listener_.get(); }

 private:
  [[nodiscard]] bool leaving() const {
    pollfd state{host_.get(), POLLRDHUP, 0};
    return host_.open() && ::poll(&state, 1, 0) > 0;
  }
  sockaddr* generic() { return static_cast<sockaddr*>(static_cast<void*>(&address_)); }
  [[nodiscard]] const sockaddr* generic() const {
    return static_cast<const sockaddr*>(static_cast<const void*>(&address_));
  }

  sockaddr_storage address_;
  socklen_t size_;
  Descriptor listener_;
  Descriptor host_;
};

}  // namespace

OpenedTransport open_tcp(const std::string& place) {
  Address address;
  if (!split(place, address)) {
    return linux::Problem{"cannot listen on " + place + ": that is no port; give [HOST:]PORT, such as 7000 or 0"};
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
  if (error != 0) {
    return linux::Problem{"cannot listen on " + place + ": " + ::gai_strerror(error) +
                          "; give an address of this machine, or a port alone"};
  }
  sockaddr_storage storage{};
  std::memcpy(&storage, found->ai_addr, std::min<std::size_t>(found->ai_addrlen, sizeof storage));
  auto port = std::make_unique<TcpPort>(storage, found->ai_addrlen);
  ::freeaddrinfo(found);
  if (const std::string problem = port->plug_in(); !problem.empty()) return linux::Problem{problem};
  return OpenedTransport(std::move(port));
}

}  // namespace fencepost::emulate
