#include "host/live/listening_console.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "host/live/open_port.hpp"

namespace fencepost::host {
namespace {

using base::Error;
using linux::Descriptor;

struct FreeAddresses {
  void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};

std::unique_ptr<addrinfo, FreeAddresses> addresses_of(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* list = nullptr;
  const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (error != 0) {
    throw DeviceFailure{false, "console: " + host + ": " + ::gai_strerror(error) +
                                   "; name an address of this machine, such as 127.0.0.1, or 0.0.0.0 for all"};
  }
  return std::unique_ptr<addrinfo, FreeAddresses>(list);
}

Descriptor listener_at(const addrinfo& address) {
  Descriptor fd(::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  if (!fd.open()) return {};
  ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const bool listens = ::bind(fd.get(), address.ai_addr, address.ai_addrlen) == 0 && ::listen(fd.get(), SOMAXCONN) == 0;
  return listens ? std::move(fd) : Descriptor();
}

/// With the port that the system chose.
std::string address_of(int fd) {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  auto* const address = static_cast<sockaddr*>(static_cast<void*>(&own));
  if (::getsockname(fd, address, &size) != 0 || ::getnameinfo(address, size, host.data(), host.size(), port.data(),
                                                              port.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return "tcp:?";
  }
  const std::string name = host.data();
  return "tcp:" + (name.find(':') == std::string::npos ? name : "[" + name + "]") + ":" + port.data();
}

}  // namespace

std::unique_ptr<ListeningConsole> ListeningConsole::open(const std::string& host, std::uint16_t port) {
  const auto addresses = addresses_of(host, port);
  int error = EADDRNOTAVAIL;
  for (const addrinfo* one = addresses.get(); one != nullptr; one = one->ai_next) {
    if (Descriptor fd = listener_at(*one); fd.open()) {
      std::string address = address_of(fd.get());
      return std::unique_ptr<ListeningConsole>(new ListeningConsole(std::move(fd), std::move(address)));
    }
    error = errno;
  }
  throw DeviceFailure{false, linux::failure("listen at", "tcp:" + host + ":" + std::to_string(port), error,
                                            "choose another port, or an address of this machine")
                                 .sentence};
}

void ListeningConsole::tend(base::Time /*now*/) {
  while (true) {
    Descriptor next(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!next.open()) return;
    if (client_.open()) {
      constexpr std::string_view kBusy = "error: somebody else is at this console; try again later\r\n";
      static_cast<void>(::send(next.get(), kBusy.data(), kBusy.size(), MSG_NOSIGNAL));
      continue;
    }
    const int on = 1;
    ::setsockopt(next.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(next.get(), SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);  // one that went without a word frees its place
    client_ = std::move(next);
  }
}

base::Result<std::size_t> ListeningConsole::read(std::span<std::uint8_t> in) {
  if (!client_.open() || in.empty()) return Error::kNotReady;
  const ssize_t count = ::recv(client_.get(), in.data(), in.size(), 0);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0 || (errno != EAGAIN && errno != EINTR)) client_.close();
  return Error::kNotReady;
}

base::Result<std::size_t> ListeningConsole::write(std::span<const std::uint8_t> out) {
  if (!client_.open()) return Error::kGone;
  const ssize_t count = ::send(client_.get(), out.data(), out.size(), MSG_NOSIGNAL);
  if (count > 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return Error::kFull;
  client_.close();
  return Error::kGone;
}

void ListeningConsole::watch(linux::WaitSet& set, bool output_waits) const {
  set.add_readable(listener_.get());
  set.add_readable(client_.get());
  if (output_waits && client_.open()) set.add_writable(client_.get());
}

}  // namespace fencepost::host
