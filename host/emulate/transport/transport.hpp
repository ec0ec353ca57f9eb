// Where a host finds an emulated device: a pseudo-terminal, a TCP port, a CAN interface.
#pragma once

#include <memory>
#include <string>

#include "hal/linux/opened.hpp"
#include "host/emulate/models/bytes.hpp"

namespace fencepost::emulate {

/// No call waits.
class Transport {
 public:
  virtual ~Transport() = default;

  /// As a host names it: "/dev/pts/5", "127.0.0.1:7000", "vcan0".
  [[nodiscard]] virtual std::string place() const = 0;
  /// Looks for a host that came or went; whether one is there.
  virtual bool tend() = 0;
  /// The host's bytes; at most some kilobytes a call.
  virtual Bytes read() = 0;
  /// Bytes that do not fit are lost, as on a UART that nobody reads; out: how many were.
  virtual std::size_t write(const Bytes& bytes) = 0;
  /// As if the plug was pulled; `plug_in` answers a sentence when that fails.
  virtual void hang_up() = 0;
  virtual std::string plug_in() = 0;
  /// For WaitSet while a host is there.
  [[nodiscard]] virtual int descriptor() const = 0;
  /// Baud rate that a host finds when it opens the port, as if it had set it. 0: as the system has it.
  virtual void preset_baud(std::uint32_t /*baud*/) {}
  /// Baud rate that the host has set at its end; 0 where there is none.
  [[nodiscard]] virtual std::uint32_t host_baud() const { return 0; }
};

using OpenedTransport = linux::Opened<std::unique_ptr<Transport>>;

/// Raw. `link`: a symbolic link with a stable name, removed at the end; none if empty. A link of an earlier run that
/// points to nothing is replaced. A pty that was hung up comes back under another name; the link follows.
/// errors: no more ptys; the link's path is taken or cannot be written
OpenedTransport open_pty(const std::string& link);

/// `place`: [HOST:]PORT, by default on 127.0.0.1; port 0: any free one, kept when hung up. One host at a time; a second
/// one is turned away. errors: not a port, host unknown, port in use or not allowed
OpenedTransport open_tcp(const std::string& place);

/// Sends frames of 16 bytes (struct can_frame). A host cannot be seen there, and counts as connected.
/// errors: no such interface, down, no SocketCAN
OpenedTransport open_can(const std::string& interface);

}  // namespace fencepost::emulate
