#include "tests/boards/line.hpp"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace fencepost::test {
namespace {

constexpr double kBurst = 64;      // bytes at once, after a moment without time
constexpr int kReceiveBuffer = 1;  // the kernel rounds up: a blocked line is soon full

}  // namespace

Line::Line(const std::string& path) : listening_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
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

Line::~Line() {
  if (connected_ >= 0) ::close(connected_);
  ::close(listening_);
}

bool Line::accept(std::chrono::milliseconds patience) {
  pollfd wait{listening_, POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(patience.count())) != 1) return false;
  connected_ = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  last_ = WallClock::now();
  return connected_ >= 0;
}

void Line::pump() {
  write_some();
  if (!blocked_) read_all();
}

void Line::write_some() {
  const auto now = WallClock::now();
  allowed_ =
      std::min(allowed_ + pace_ * std::chrono::duration<double>(now - last_).count(), std::max(kBurst, pace_ / 1000));
  last_ = now;
  const bool unpaced = pace_ > 1e9;
  const std::size_t count = unpaced ? waiting_.size() : std::min(waiting_.size(), static_cast<std::size_t>(allowed_));
  if (count == 0) return;
  const ssize_t sent = ::send(connected_, waiting_.data(), count, MSG_NOSIGNAL);
  if (sent <= 0) return;
  allowed_ -= static_cast<double>(sent);
  waiting_.erase(0, static_cast<std::size_t>(sent));
}

void Line::read_all() {
  std::array<char, 4096> bytes{};
  for (;;) {
    const ssize_t count = ::recv(connected_, bytes.data(), bytes.size(), 0);
    if (count <= 0) return;
    heard_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

std::size_t Line::unread() const {
  int bytes = 0;
  if (::ioctl(connected_, SIOCOUTQ, &bytes) != 0) return 0;
  return static_cast<std::size_t>(bytes);
}

std::size_t Line::held() const {
  int bytes = 0;
  if (::ioctl(connected_, SIOCINQ, &bytes) != 0) return 0;
  return static_cast<std::size_t>(bytes);
}

std::string Line::take() { return std::exchange(heard_, {}); }

}  // namespace fencepost::test
