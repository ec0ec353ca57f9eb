// A connection to a serial server, an emulator or another program (TCP).
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::linux {

struct TcpSettings {
  std::string host;  ///< a name, or an address of IPv4 or IPv6
  std::uint16_t port = 0;
};

/// Where a name leads, as connect(2) takes it.
struct TcpAddress {
  sockaddr_storage address{};
  socklen_t size = 0;
};

/// Bytes as they come, without delay. A peer that vanishes without a word is noticed after some ten seconds. After a
/// loss `tend` connects again, which may take several calls; meanwhile reads answer kGone.
class Tcp {
 public:
  /// Looks the name up, which may take the resolver's time, and waits for the connection, two seconds an address.
  /// errors: a sentence: unknown name, nobody listens there, no way there.
  static Opened<Tcp> open(TcpSettings settings);

  /// Looks the name up and connects with `tend`. errors: a sentence: unknown name.
  static Opened<Tcp> later(TcpSettings settings);

  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

  /// Once per loop iteration; tries to connect again, at most every kRetryInterval, each address in turn.
  void tend(base::Time now);
  [[nodiscard]] bool connected() const { return fd_.open() && !connecting_since_; }
  /// Why the last try to connect again failed; empty when none did.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// For WaitSet; -1 while there is no connection.
  [[nodiscard]] int descriptor() const { return connected() ? fd_.get() : -1; }

 private:
  Tcp(TcpSettings settings, std::vector<TcpAddress> addresses)
      : settings_(std::move(settings)), addresses_(std::move(addresses)) {}
  void begin(base::Time now);
  void await(base::Time now);
  void fail(int error);

  TcpSettings settings_;
  std::vector<TcpAddress> addresses_;  ///< at least one
  std::size_t next_ = 0;               ///< the one to try, or that is connected
  Descriptor fd_;
  std::optional<base::Time> connecting_since_;
  Retry retry_;
  std::string problem_;
};

static_assert(bus::ByteLink<Tcp>);

}  // namespace fencepost::linux
