// A server in a thread, and a host's end of a TCP port.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/linux/descriptor.hpp"
#include "host/emulate/scene/server.hpp"
#include "tests/host/emulate/scene/rig.hpp"

namespace fencepost::emulate {

inline constexpr base::Duration kPatience = base::milliseconds(20'000);

/// A quarter of a second a frame of ten a second: a busy machine that sleeps for less loses none.
inline PlaybackSettings unhurried() {
  PlaybackSettings settings;
  settings.speed = 0.4;
  return settings;
}

/// A server in a thread of its own.
class Running {
 public:
  explicit Running(const Feed& feed, const PlaybackSettings& settings = {})
      : playback_(feed, settings, clock_.now()),
        server_(
            playback_, clock_, [this](const std::string& line) { said_.push_back(line); }, [](const std::string&) {}) {}
  ~Running() { stop(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void add(const std::string& device, OpenedTransport transport, const FaultSettings& faults = {}) {
    ASSERT_TRUE(transport.ok()) << transport.problem();
    playback_.add({device, emulated_device(device), faults, 1, {}});
    server_.add(std::move(*transport));
  }
  void start() {
    thread_ = std::thread([this] { finished_ = server_.run([this] { return stop_.load(); }); });
  }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// Waits for the end; whether it came by itself.
  bool join() {
    thread_.join();
    return finished_;
  }
  /// The show is over.
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] std::string place(std::size_t index) const { return server_.place(index); }
  [[nodiscard]] const linux::MonotonicClock& clock() const { return clock_; }
  /// After the end.
  Endpoint& endpoint(std::size_t index) { return playback_.endpoint(index); }
  [[nodiscard]] const std::vector<std::string>& said() const { return said_; }

 private:
  linux::MonotonicClock clock_;
  Playback playback_;
  std::vector<std::string> said_;
  Server server_;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> finished_ = false;
  std::thread thread_;
};

/// Whether the boxes seen are some of those shown, in order and to the pixel. In real time a machine that was busy
/// elsewhere may miss some: that none is missed is tested in stepped time.
inline testing::AssertionResult in_order(const std::vector<sensor::Blob>& seen, const Feed& feed) {
  constexpr std::size_t kFewest = 3;
  std::size_t at = 0;
  for (const sensor::Blob& blob : seen) {
    const auto same = [&](const sensor::Blob& shown) {
      return shown.x1 == blob.x1 && shown.x2 == blob.x2 && shown.y1 == blob.y1 && shown.y2 == blob.y2;
    };
    while (at < feed.frames.size() && !same(feed.frames[at].blobs[0])) ++at;
    if (at == feed.frames.size()) return testing::AssertionFailure() << "never shown: columns " << blob.x1;
  }
  if (seen.size() < kFewest) return testing::AssertionFailure() << "only " << seen.size() << " frames seen";
  return testing::AssertionSuccess();
}

template <class Condition>
bool eventually(const linux::MonotonicClock& clock, Condition condition) {
  const base::Time deadline = clock.now() + kPatience;
  while (clock.now() < deadline) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// A host's end of a TCP port, for the test alone.
class Socket {
 public:
  explicit Socket(const std::string& place) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1))));
    connected_ = ::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::fcntl(fd_.get(), F_SETFL, O_NONBLOCK);
  }
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    const ssize_t count = ::recv(fd_.get(), in.data(), in.size(), 0);
    if (count > 0) return static_cast<std::size_t>(count);
    return count < 0 && errno == EAGAIN ? base::Error::kNotReady : base::Error::kGone;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    const ssize_t count = ::send(fd_.get(), out.data(), out.size(), MSG_NOSIGNAL);
    if (count > 0) return static_cast<std::size_t>(count);
    return base::Error::kGone;
  }
  [[nodiscard]] bool connected() const { return connected_; }

 private:
  linux::Descriptor fd_;
  bool connected_ = false;
};
static_assert(bus::ByteLink<Socket>);

}  // namespace fencepost::emulate
