// The loop of each profile, instantiated so that its worst-case stack can be read off the call graph.

#include "firmware/loop/loop.hpp"

namespace fencepost::probe {

struct NoCamera {
  base::Result<sensor::BlobFrame> poll(base::Time) { return base::Error::kNotReady; }
  [[nodiscard]] sensor::LinkState link() const { return sensor::LinkState::kAbsent; }
  [[nodiscard]] std::uint32_t dropped() const { return 0; }
};
struct NoOdometry {
  base::Result<sensor::OdometrySample> poll(base::Time) { return base::Error::kNotReady; }
  [[nodiscard]] sensor::LinkState link() const { return sensor::LinkState::kAbsent; }
};
struct NoLink {
  base::Result<std::size_t> read(std::span<std::uint8_t>) { return base::Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t>) { return base::Error::kFull; }
};

// Sensors that the optimiser cannot see through, or it would drop the loop's body.
[[gnu::noinline]] bool opaque() {
  static volatile bool value = false;
  return value;
}
struct SomeCamera : NoCamera {
  base::Result<sensor::BlobFrame> poll(base::Time) {
    return opaque() ? base::Result<sensor::BlobFrame>(sensor::BlobFrame{}) : base::Error::kNotReady;
  }
};
struct SomeOdometry : NoOdometry {
  base::Result<sensor::OdometrySample> poll(base::Time) {
    return opaque() ? base::Result<sensor::OdometrySample>(sensor::OdometrySample{}) : base::Error::kNotReady;
  }
};
struct SomeLink : NoLink {
  base::Result<std::size_t> read(std::span<std::uint8_t> bytes) {
    if (!opaque()) return base::Error::kNotReady;
    bytes[0] = opaque() ? '$' : '\n';
    return std::size_t{1};
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> bytes) {
    return opaque() ? base::Result<std::size_t>(bytes.size()) : base::Error::kFull;
  }
};

template <class Profile>
using ProbedLoop = loop::Loop<Profile, SomeCamera, SomeOdometry, SomeLink>;

}  // namespace fencepost::probe

// The roots that the stack check starts from.
extern "C" {
void stack_root_micro(fencepost::probe::ProbedLoop<fencepost::config::Micro>& loop) { loop.step({}); }
void stack_root_small(fencepost::probe::ProbedLoop<fencepost::config::Small>& loop) { loop.step({}); }
void stack_root_full(fencepost::probe::ProbedLoop<fencepost::config::Full>& loop) { loop.step({}); }
}
