// A Pixy2 on USB: its packets inside Chirp calls.
#pragma once

#include <cstdint>
#include <vector>

#include "host/emulate/models/pixy2.hpp"

namespace fencepost::emulate {

/// Answers INIT, ENUMERATE and CALL as transfers: 64 bytes filled up with old ones, then the rest.
class Pixy2Usb {
 public:
  /// Borrowed.
  explicit Pixy2Usb(Pixy2& camera) : camera_(camera) {}

  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time now);
  /// The camera forgets its connection when it is switched off.
  void restart(base::Time now);
  /// A pushed message that nobody asked for: pictures and blocks for the vendor's viewer.
  static std::vector<std::uint8_t> pushed(std::size_t length);

 private:
  using Bytes = std::vector<std::uint8_t>;
  static Bytes message(std::uint8_t type, std::uint16_t procedure, const Bytes& payload);
  Bytes answer(const Bytes& transfer, base::Time now);
  Bytes call(const Bytes& transfer, base::Time now);

  static constexpr std::uint8_t kProcedure = 37;

  Pixy2& camera_;
  bool initialised_ = false;
  Bytes received_;
};

}  // namespace fencepost::emulate
