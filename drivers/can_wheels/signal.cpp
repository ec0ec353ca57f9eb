#include "drivers/can_wheels/signal.hpp"

#include "drivers/wire/endian.hpp"

namespace fencepost::can_wheels {

bool carries(const bus::CanFrame& frame, const Signal& signal) {
  return frame.id == signal.id && frame.extended == signal.extended && !frame.remote;
}

std::optional<std::int64_t> value_in(const bus::CanFrame& frame, const Signal& signal) {
  FENCEPOST_CHECK(signal.size >= 1 && signal.size <= 4);
  if (!carries(frame, signal) || frame.length > 8 || frame.length < signal.first_byte + signal.size)
    return std::nullopt;
  const std::uint64_t raw = signal.big_endian ? wire::big(frame.bytes(), signal.first_byte, signal.size)
                                              : wire::little(frame.bytes(), signal.first_byte, signal.size);
  const unsigned unused = 64U - 8U * signal.size;
  if (!signal.is_signed) return static_cast<std::int64_t>(raw);
  return static_cast<std::int64_t>(raw << unused) >> unused;
}

}  // namespace fencepost::can_wheels
