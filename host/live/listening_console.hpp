// A console that waits for people: it listens, one of them at a time is connected.
#pragma once

#include <memory>
#include <string>

#include "host/live/console_port.hpp"

namespace fencepost::host {

/// A second visitor is refused with a message while another is connected. Output while nobody is connected is discarded
/// by PatientConsole, as on a line that is unplugged.
class ListeningConsole final : public ConsolePort {
 public:
  /// `host`: of this machine, an address or a name; port 0: any that is free. errors: DeviceFailure
  static std::unique_ptr<ListeningConsole> open(const std::string& host, std::uint16_t port);
  /// "tcp:127.0.0.1:4000", for who connects.
  [[nodiscard]] const std::string& address() const { return address_; }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) override;
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override;
  void tend(base::Time now) override;
  [[nodiscard]] bool connected() const override { return client_.open(); }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return client_.get(); }
  void watch(linux::WaitSet& set, bool output_waits) const override;

 private:
  ListeningConsole(linux::Descriptor listener, std::string address)
      : listener_(std::move(listener)), address_(std::move(address)) {}

  linux::Descriptor listener_;
  linux::Descriptor client_;
  std::string address_;
};

}  // namespace fencepost::host
