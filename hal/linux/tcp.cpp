#include "hal/linux/tcp.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <variant>

namespace fencepost::linux {
namespace {

constexpr int kPatienceMs = 2'000;

std::string name_of(const TcpSettings& settings) { return settings.host + ":" + std::to_string(settings.port); }

std::string_view tcp_remedy(int error) {
  switch (error) {
    case ECONNREFUSED: return "nobody listens there; start the other program first, and compare the port";
    case ETIMEDOUT:
    case EHOSTUNREACH:
    case ENETUNREACH: return "see whether 'ping' gets there";
    default: return "check host and port";
  }
}

Problem tcp_problem(const TcpSettings& settings, int error) {
  return failure("connect to", name_of(settings), error, tcp_remedy(error));
}

struct FreeAddresses {
  void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};

std::variant<std::vector<TcpAddress>, Problem> look_up(const TcpSettings& settings) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int error = ::getaddrinfo(settings.host.c_str(), std::to_string(settings.port).c_str(), &hints, &list);
  const std::unique_ptr<addrinfo, FreeAddresses> owned(list);
  if (error != 0) {
    return Problem{"cannot find the host " + settings.host + ": " + ::gai_strerror(error) +
                   "; check its name, or give its address"};
  }
  std::vector<TcpAddress> addresses;
  for (const addrinfo* one = list; one != nullptr; one = one->ai_next) {
    TcpAddress& address = addresses.emplace_back();
    std::memcpy(&address.address, one->ai_addr, one->ai_addrlen);
    address.size = one->ai_addrlen;
  }
  return addresses;
}

void set(int fd, int level, int option, int value) { ::setsockopt(fd, level, option, &value, sizeof value); }

/// Under way, or done; with an error in errno otherwise.
Descriptor begin_connection(const TcpAddress& address) {
  Descriptor fd(::socket(address.address.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd.open()) return fd;
  set(fd.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  set(fd.get(), SOL_SOCKET, SO_KEEPALIVE, 1);
  set(fd.get(), IPPROTO_TCP, TCP_KEEPIDLE, 4);
  set(fd.get(), IPPROTO_TCP, TCP_KEEPINTVL, 2);
  set(fd.get(), IPPROTO_TCP, TCP_KEEPCNT, 3);
  set(fd.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, 10'000);
  const auto* where = static_cast<const sockaddr*>(static_cast<const void*>(&address.address));
  if (::connect(fd.get(), where, address.size) == 0 || errno == EINPROGRESS) return fd;
  const int error = errno;
  fd.close();
  errno = error;
  return fd;
}

/// 0 when connected, EINPROGRESS, or why not.
int state_of(int fd, int timeout_ms) {
  pollfd wait{fd, POLLOUT, 0};
  if (::poll(&wait, 1, timeout_ms) <= 0) return EINPROGRESS;
  int error = 0;
  socklen_t size = sizeof error;
  return ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

Opened<Tcp> Tcp::later(TcpSettings settings) {
  auto found = look_up(settings);
  if (const auto* problem = std::get_if<Problem>(&found)) return *problem;
  return Tcp(std::move(settings), std::move(*std::get_if<std::vector<TcpAddress>>(&found)));
}

Opened<Tcp> Tcp::open(TcpSettings settings) {
  Opened<Tcp> tcp = later(std::move(settings));
  if (!tcp) return tcp;
  int error = EHOSTUNREACH;
  for (tcp->next_ = 0; tcp->next_ < tcp->addresses_.size(); ++tcp->next_) {
    tcp->fd_ = begin_connection(tcp->addresses_[tcp->next_]);
    error = tcp->fd_.open() ? state_of(tcp->fd_.get(), kPatienceMs) : errno;
    if (error == 0) return tcp;
    if (error == EINPROGRESS) error = ETIMEDOUT;
  }
  return tcp_problem(tcp->settings_, error);
}

base::Result<std::size_t> Tcp::read(std::span<std::uint8_t> in) {
  if (!connected()) return base::Error::kGone;
  if (in.empty()) return std::size_t{0};
  const ssize_t count = ::recv(fd_.get(), in.data(), in.size(), 0);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return base::Error::kNotReady;
  fd_.close();
  return base::Error::kGone;
}

base::Result<std::size_t> Tcp::write(std::span<const std::uint8_t> out) {
  if (!connected()) return base::Error::kGone;
  if (out.empty()) return std::size_t{0};
  const ssize_t count = ::send(fd_.get(), out.data(), out.size(), MSG_NOSIGNAL);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0 || errno == EAGAIN || errno == EINTR) return base::Error::kFull;
  fd_.close();
  return base::Error::kGone;
}

void Tcp::tend(base::Time now) {
  if (connecting_since_) return await(now);
  if (!fd_.open() && retry_.due(now)) begin(now);
}

void Tcp::begin(base::Time now) {
  fd_ = begin_connection(addresses_[next_]);
  if (!fd_.open()) return fail(errno);
  connecting_since_ = now;
  await(now);
}

void Tcp::await(base::Time now) {
  const int error = state_of(fd_.get(), 0);
  if (error == 0) {
    connecting_since_.reset();
    problem_.clear();
  } else if (error != EINPROGRESS) {
    fail(error);
  } else if (now - *connecting_since_ > base::milliseconds(kPatienceMs)) {
    fail(ETIMEDOUT);
  }
}

void Tcp::fail(int error) {
  fd_.close();
  next_ = (next_ + 1) % addresses_.size();
  connecting_since_.reset();
  problem_ = tcp_problem(settings_, error).sentence;
}

}  // namespace fencepost::linux
