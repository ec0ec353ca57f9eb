#include "tests/boards/line.hpp"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fencepost::test {
namespace {

constexpr double kBurst = 64;  // bytes at once, after a moment without time
constexpr std::size_t kMax = 4096;
constexpr int kReceiveBuffer = 1;  // the kernel rounds up: a blocked line is soon full

}  // namespace

SocketLine::SocketLine(const std::string& path) : listening_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (listening_ < 0 || path.size() >= sizeof address.sun_path) throw std::runtime_error("no socket for " + path);
  std::copy(path.begin(), path.end(), std::begin(address.sun_path));
  ::setsockopt(listening_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  if (::bind(listening_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listening_, 1) != 0) {
    throw std::runtime_error("cannot listen at " + path);
  }
}

SocketLine::~SocketLine() {
  if (connected_ >= 0) ::close(connected_);
  ::close(listening_);
}

bool SocketLine::accept(std::chrono::milliseconds patience) {
  pollfd wait{listening_, POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(patience.count())) != 1) return false;
  connected_ = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  return connected_ >= 0;
}

bool SocketLine::await(std::chrono::milliseconds patience) {
  pollfd wait{connected_, POLLIN, 0};
  return ::poll(&wait, 1, static_cast<int>(patience.count())) == 1;
}

std::size_t SocketLine::put(std::string_view bytes) {
  const ssize_t sent = ::send(connected_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return sent > 0 ? static_cast<std::size_t>(sent) : 0;
}

std::string SocketLine::get(std::size_t most) {
  std::string bytes(most, '\0');
  const ssize_t count = ::recv(connected_, bytes.data(), bytes.size(), 0);
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return bytes;
}

void Line::pump(double now) {
  allowed_ = std::min(allowed_ + pace_ * (now - last_), std::max(kBurst, pace_ / 1000));
  last_ = now;
  const std::size_t count = std::min(waiting_.size(), static_cast<std::size_t>(allowed_));
  if (count > 0) {
    const std::size_t sent = put(std::string_view(waiting_).substr(0, count));
    allowed_ -= static_cast<double>(sent);
    waiting_.erase(0, sent);
  }
  for (bool more = !blocked_; more;) {
    const std::string bytes = get(kMax);
    heard_ += bytes;
    more = !bytes.empty();
  }
}

std::size_t SocketLine::unread() const {
  int bytes = 0;
  if (::ioctl(connected_, SIOCOUTQ, &bytes) != 0) return 0;
  return static_cast<std::size_t>(bytes);
}

std::size_t SocketLine::held() const {
  int bytes = 0;
  if (::ioctl(connected_, SIOCINQ, &bytes) != 0) return 0;
  return static_cast<std::size_t>(bytes);
}

std::string Line::take() { return std::exchange(heard_, {}); }

}  // namespace fencepost::test
