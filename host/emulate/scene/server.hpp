// A playback in real time: its devices on their transports.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hal/linux/clock.hpp"
#include "host/emulate/scene/playback.hpp"
#include "host/emulate/transport/transport.hpp"

namespace fencepost::emulate {

class Server {
 public:
  /// `playback` is borrowed, and was started by `clock`. `say` reports hosts that come and go; `moved` a device
  /// that is found at another place than before.
  Server(Playback& playback, linux::MonotonicClock clock, Say say, Say moved);

  /// In the order of the playback's endpoints.
  void add(std::unique_ptr<Transport> transport);
  [[nodiscard]] std::string place(std::size_t index) const { return places_.at(index).transport->place(); }

  /// Serves until the playback is over (true), or `stop` says so (false); it is asked at least ten times a second.
  bool run(const std::function<bool()>& stop);
  /// The longest time by which something was late because this machine was busy.
  [[nodiscard]] base::Duration late() const { return late_; }
  /// One iteration: reads what has arrived, sends what is due.
  void turn();

 private:
  struct Place {
    std::unique_ptr<Transport> transport;
    bool hung_up = false;
    std::uint32_t baud = 0;  ///< of the host, as last compared with the device's
    std::uint64_t lost = 0;
    std::uint32_t garbage = 1;  ///< state of the random bytes for a host at another baud rate
  };
  void tend(std::size_t index, base::Time now);
  void follow_plug(std::size_t index);
  void check_baud(std::size_t index);
  [[nodiscard]] bool other_baud(std::size_t index) const;
  void wait();

  Playback& playback_;
  linux::MonotonicClock clock_;
  Say say_;
  Say moved_;
  std::vector<Place> places_;
  bool begun_ = false;
  base::Duration late_;
};

}  // namespace fencepost::emulate
