#include "host/emulate/scene/server.hpp"

#include <algorithm>

#include "hal/linux/wait.hpp"

namespace fencepost::emulate {
namespace {

/// Opening a pty wakes no waiter, so it is polled.
constexpr base::Duration kLook = base::milliseconds(10);
/// Output is sent in portions of this length, as a USB adapter does; byte by byte would be ten thousand iterations a
/// second.
constexpr base::Duration kPortion = base::milliseconds(1);

/// A receiver at another rate reads arbitrary bytes; these are the same in each run.
void garble(Bytes& bytes, std::uint32_t& state) {
  for (std::uint8_t& byte : bytes) {
    state = state * 1'664'525U + 1'013'904'223U;
    byte = static_cast<std::uint8_t>(state >> 24U);
  }
}

}  // namespace

Server::Server(Playback& playback, linux::MonotonicClock clock, Say say, Say moved)
    : playback_(playback), clock_(clock), say_(std::move(say)), moved_(std::move(moved)) {}

void Server::add(std::unique_ptr<Transport> transport) {
  transport->preset_baud(playback_.endpoint(places_.size()).device().baud);
  places_.push_back({std::move(transport)});
}

bool Server::run(const std::function<bool()>& stop) {
  while (!playback_.over(clock_.now())) {
    if (stop()) return false;
    const base::Time before = clock_.now();
    turn();
    late_ = std::max(late_, clock_.now() - before);
    wait();
  }
  return true;
}

void Server::turn() {
  const base::Time now = clock_.now();
  playback_.advance(now);
  for (std::size_t i = 0; i < places_.size(); ++i) tend(i, now);
  playback_.advance(now);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Bytes bytes = playback_.endpoint(i).to_host(now);
    if (bytes.empty()) continue;
    if (other_baud(i)) garble(bytes, places_[i].garbage);
    const std::size_t lost = places_[i].transport->write(bytes);
    if (lost > 0 && places_[i].lost == 0 && places_[i].transport->tend()) {
      say_(playback_.endpoint(i).name() + ": the host does not read fast enough; bytes are lost, as on a real line");
    }
    places_[i].lost += lost;
  }
  if (begun_ == playback_.begun().has_value()) return;
  begun_ = true;
  say_("time begins");
}

void Server::tend(std::size_t index, base::Time now) {
  Endpoint& endpoint = playback_.endpoint(index);
  Transport& transport = *places_[index].transport;
  follow_plug(index);
  if (const bool there = transport.tend(); there != endpoint.connected()) {
    say_(endpoint.name() + (there ? ": host connected" : ": host gone"));
    endpoint.connect(there, now);
    places_[index].baud = 0;
  }
  if (endpoint.full()) return;  // a host that floods its line is slowed down by it
  const Bytes bytes = transport.read();
  if (bytes.empty()) return;
  check_baud(index);
  if (other_baud(index)) return;
  if (endpoint.counts().commands == 0) say_(endpoint.name() + ": first command");
  playback_.hear(index, bytes, now);
}

void Server::follow_plug(std::size_t index) {
  Place& place = places_[index];
  const Endpoint& endpoint = playback_.endpoint(index);
  if (endpoint.unplugged() && !place.hung_up) {
    place.transport->hang_up();
    place.hung_up = true;
    say_(endpoint.name() + ": unplugged");
  } else if (!endpoint.unplugged() && place.hung_up) {
    const std::string before = place.transport->place();
    const std::string problem = place.transport->plug_in();
    if (!problem.empty()) return;  // again next turn
    place.hung_up = false;
    say_(endpoint.name() + ": plugged in again");
    if (place.transport->place() != before) moved_(endpoint.name() + " on " + place.transport->place());
  }
}

void Server::check_baud(std::size_t index) {
  Place& place = places_[index];
  const std::uint32_t own = playback_.endpoint(index).baud();
  if (own == 0) return;
  const std::uint32_t baud = place.transport->host_baud();
  if (std::exchange(place.baud, baud) == baud || baud == 0 || baud == own) return;
  say_(playback_.endpoint(index).name() + ": the host has set " + std::to_string(baud) + " Bd, the device " +
       std::to_string(own) + "; as on a real cable nothing sensible gets through: set one as the other (--baud)");
}

bool Server::other_baud(std::size_t index) const {
  const std::uint32_t own = playback_.endpoint(index).baud();
  if (own == 0) return false;
  const std::uint32_t host = places_[index].transport->host_baud();
  return host != 0 && host != own;
}

void Server::wait() {
  linux::WaitSet set;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!playback_.endpoint(i).full()) set.add_readable(places_[i].transport->descriptor());
  }
  const base::Time now = clock_.now();
  base::Time deadline = now + kLook;
  if (const auto next = playback_.next()) deadline = std::clamp(*next, now + kPortion, deadline);
  (void)set.wait_until(clock_, deadline);
  late_ = std::max(late_, clock_.now() - deadline);
}

}  // namespace fencepost::emulate
