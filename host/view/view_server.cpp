#include "host/view/view_server.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <pthread.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

namespace fencepost::host {
namespace {

using linux::Descriptor;
using std::chrono::milliseconds;

constexpr milliseconds kLogInterval{40};  ///< between two looks at the log while somebody follows it
constexpr milliseconds kIdle{500};        ///< between two looks at visitors that do nothing

sockaddr* as_address(sockaddr_in& address) { return static_cast<sockaddr*>(static_cast<void*>(&address)); }

Descriptor listener_at(std::uint16_t port) {
  Descriptor fd(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!fd.open()) return {};
  const int on = 1;
  ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool listens = ::bind(fd.get(), as_address(address), sizeof address) == 0 && ::listen(fd.get(), SOMAXCONN) == 0;
  return listens ? std::move(fd) : Descriptor();
}

std::uint16_t port_of(int fd) {
  sockaddr_in own{};
  socklen_t size = sizeof own;
  return ::getsockname(fd, as_address(own), &size) == 0 ? ntohs(own.sin_port) : std::uint16_t{0};
}

}  // namespace

ViewServer::Opened ViewServer::open(std::string page, std::uint16_t port, std::size_t capacity) {
  Descriptor listener = listener_at(port);
  if (!listener.open()) {
    return linux::failure("show the run at", fmt::format("127.0.0.1:{}", port), errno,
                          "choose another port, or none: any that is free");
  }
  linux::Opened<linux::SignalFlag> flag = linux::SignalFlag::open();
  if (!flag) return linux::Problem{flag.problem()};
  const std::uint16_t bound = port_of(listener.get());
  return std::unique_ptr<ViewServer>(
      new ViewServer(std::move(page), std::move(listener), bound, std::move(*flag), capacity));
}

// Signals are handled by the thread that waits for them.
ViewServer::ViewServer(std::string page, Descriptor listener, std::uint16_t port, linux::SignalFlag stop,
                       std::size_t capacity)
    : page_(std::move(page)), listener_(std::move(listener)), port_(port), stop_(std::move(stop)), log_(capacity) {
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ViewServer::~ViewServer() { stop({}); }

void ViewServer::finish(milliseconds patience) {
  log_.end();
  stop(patience);
}

void ViewServer::stop(milliseconds patience) {
  if (!thread_.joinable()) return;
  leave_by_ = std::chrono::steady_clock::now() + patience;
  stop_.raise();
  thread_.join();
}

std::string ViewServer::address() const { return fmt::format("http://127.0.0.1:{}/", port_); }

void ViewServer::run() {
  while (true) {
    wait();
    const Visitor::Time now = std::chrono::steady_clock::now();
    if (!leaving_) welcome(now);
    for (Visitor& visitor : visitors_) visitor.serve(now);
    std::erase_if(visitors_, [this](const Visitor& v) { return v.over() || (leaving_ && v.idle()); });
    if (leaving_ && (visitors_.empty() || now >= leave_by_.load())) return;
  }
}

void ViewServer::wait() {
  std::vector<pollfd> watched;
  if (!leaving_) {
    watched.push_back({stop_.descriptor(), POLLIN, 0});
    watched.push_back({listener_.get(), POLLIN, 0});
  }
  bool follows = leaving_;
  for (const Visitor& visitor : visitors_) {
    const int events = POLLIN | (visitor.waits_to_write() ? POLLOUT : 0);
    watched.push_back({visitor.descriptor(), static_cast<short>(events), 0});
    follows = follows || visitor.follows_log();
  }
  const milliseconds patience = follows ? kLogInterval : kIdle;
  ::poll(watched.data(), watched.size(), static_cast<int>(patience.count()));
  if (!leaving_ && (watched.front().revents & POLLIN) != 0) leaving_ = true;
}

void ViewServer::welcome(Visitor::Time now) {
  while (true) {
    Descriptor next(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!next.open()) {
      // Without descriptors it would wake the thread again at once.
      if (errno == EMFILE || errno == ENFILE) std::this_thread::sleep_for(kLogInterval);
      return;
    }
    if (visitors_.size() >= kMaxVisitors + kMaxTurnedAway) continue;
    const int on = 1;
    ::setsockopt(next.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(next.get(), SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
    const auto served = std::ranges::count_if(visitors_, [](const Visitor& visitor) { return visitor.served(); });
    visitors_.emplace_back(std::move(next), page_, log_, now, static_cast<std::size_t>(served) < kMaxVisitors);
  }
}

}  // namespace fencepost::host
