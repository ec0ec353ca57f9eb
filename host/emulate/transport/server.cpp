#include "host/emulate/transport/server.hpp"

#include <algorithm>

#include "hal/linux/wait.hpp"

namespace fencepost::emulate {
namespace {

/// A host that opens a pty wakes nobody, so that is looked for.
constexpr base::Duration kLook = base::milliseconds(10);
/// What a device says goes out in portions of so long, as a USB adapter brings it; byte by byte would be ten thousand
/// turns a second.
constexpr base::Duration kPortion = base::milliseconds(1);

}  // namespace

Server::Server(Stage& stage, linux::MonotonicClock clock, Say say, Say moved)
    : stage_(stage), clock_(clock), say_(std::move(say)), moved_(std::move(moved)) {}

void Server::add(std::unique_ptr<Endpoint> endpoint) { places_.push_back({std::move(endpoint), false, false, 0}); }

bool Server::run(const std::function<bool()>& stop) {
  while (!stage_.over(clock_.now())) {
    if (stop()) return false;
    turn();
    wait();
  }
  return true;
}

void Server::turn() {
  const base::Time now = clock_.now();
  stage_.advance(now);
  for (std::size_t i = 0; i < places_.size(); ++i) tend(i, now);
  stage_.advance(now);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Bytes bytes = stage_.station(i).to_host(now);
    if (bytes.empty()) continue;
    const std::size_t lost = places_[i].endpoint->write(bytes);
    if (lost > 0 && places_[i].lost == 0 && places_[i].endpoint->tend()) {
      say_(stage_.station(i).name() + ": the host does not read fast enough; bytes are lost, as on a real line");
    }
    places_[i].lost += lost;
  }
  if (begun_ == stage_.begun().has_value()) return;
  begun_ = true;
  say_("time begins");
}

void Server::tend(std::size_t index, base::Time now) {
  Station& station = stage_.station(index);
  Endpoint& endpoint = *places_[index].endpoint;
  follow_plug(index);
  if (const bool there = endpoint.tend(); there != station.connected()) {
    say_(station.name() + (there ? ": host connected" : ": host gone"));
    station.connect(there, now);
  }
  const Bytes bytes = endpoint.read();
  if (bytes.empty()) return;
  check_baud(index);
  if (station.counts().commands == 0) say_(station.name() + ": first command");
  stage_.hear(index, bytes, now);
}

void Server::follow_plug(std::size_t index) {
  Place& place = places_[index];
  const Station& station = stage_.station(index);
  if (station.unplugged() && !place.hung_up) {
    place.endpoint->hang_up();
    place.hung_up = true;
    say_(station.name() + ": unplugged");
  } else if (!station.unplugged() && place.hung_up) {
    const std::string before = place.endpoint->place();
    const std::string problem = place.endpoint->plug_in();
    if (!problem.empty()) return;  // again next turn
    place.hung_up = false;
    say_(station.name() + ": plugged in again");
    if (place.endpoint->place() != before) moved_(station.name() + " on " + place.endpoint->place());
  }
}

void Server::check_baud(std::size_t index) {
  Place& place = places_[index];
  const DeviceSpec& device = stage_.station(index).device();
  if (std::exchange(place.baud_checked, true) || device.baud == 0) return;
  const std::uint32_t baud = place.endpoint->host_baud();
  if (baud == 0 || baud == device.baud) return;
  say_(stage_.station(index).name() + ": the host has set " + std::to_string(baud) + " Bd, the device " +
       std::to_string(device.baud) + "; a real cable would carry nothing sensible: set one as the other (--baud)");
}

void Server::wait() {
  linux::WaitSet set;
  for (const Place& place : places_) set.add_readable(place.endpoint->descriptor());
  const base::Time now = clock_.now();
  base::Time deadline = now + kLook;
  if (const auto next = stage_.next()) deadline = std::clamp(*next, now + kPortion, deadline);
  (void)set.wait_until(clock_, deadline);
}

}  // namespace fencepost::emulate
