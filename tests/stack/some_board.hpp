// A bus that may answer anything, and a board of such buses, for the worst-case stack of the code that polls them.
#pragma once

#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"

namespace fencepost::probe {

// A bus that the optimiser cannot see through, or it would drop the driver's body. Its own stack is not the driver's.
[[gnu::noinline]] inline std::uint32_t unknown() {
  static volatile std::uint32_t value = 0;
  return value;
}
inline base::Result<std::size_t> some(std::span<std::uint8_t> in) {
  if (unknown() == 0) return unknown() == 1 ? base::Error::kGone : base::Error::kNotReady;
  for (std::uint8_t& byte : in) byte = static_cast<std::uint8_t>(unknown());
  return unknown() % (in.size() + 1);
}
inline base::Result<std::size_t> taken(std::span<const std::uint8_t> out) {
  if (unknown() == 0) return unknown() == 1 ? base::Error::kGone : base::Error::kFull;
  return unknown() % (out.size() + 1);
}

struct SomeBytes {
  static base::Result<std::size_t> read(std::span<std::uint8_t> in) { return some(in); }
  static base::Result<std::size_t> write(std::span<const std::uint8_t> out) { return taken(out); }
};
struct SomeI2c {
  static base::Result<std::size_t> begin(std::uint8_t /*address*/, std::span<const std::uint8_t> out, std::size_t) {
    return taken(out);
  }
  static base::Result<std::size_t> finish(std::span<std::uint8_t> in) { return some(in); }
};

template <class Driver, class Kept>
void keep_poll(Driver& driver, Kept& kept) {
  if (auto got = driver.poll(kept.t)) kept = *got;
}

}  // namespace fencepost::probe

namespace fencepost::board {

using Link = probe::SomeBytes;
using I2c = probe::SomeI2c;
inline Link& camera() {
  static constinit Link link;
  return link;
}
inline I2c& i2c() {
  static constinit I2c bus;
  return bus;
}
inline void start_camera(std::uint32_t /*baud*/) {}
inline void start_i2c() {}

}  // namespace fencepost::board
