// The world, the two devices with their cables, and the events that happen to these.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "tests/studies/storm/plan.hpp"
#include "tests/studies/storm/ports.hpp"
#include "tests/studies/storm/watch.hpp"
#include "tests/studies/storm/world.hpp"

namespace fencepost::test {

class StormBench {
 public:
  explicit StormBench(const Plan& plan);

  /// As `fencepost run` opens them.
  host::Devices open_devices();
  void advance(base::Time now) { world_.advance(now); }
  void begin(const Event& event, base::Time now);
  void end_events(base::Time now);
  /// The loop was kept from looking.
  void note_busy(base::Time now) {
    for (End& end : ends_) end.line.disturbed = std::max(end.line.disturbed, now);
  }
  /// Times of the world.
  [[nodiscard]] Outside::Line line(Cable cable) const { return ends_[index(cable)].line; }

 private:
  struct End {
    std::optional<FarEnd> device;
    Outside::Line line;
    std::optional<base::Time> noise_ends;
    std::optional<base::Time> stall_ends;
    std::optional<base::Time> unplug_ends;
    std::optional<base::Time> reboot_ends;
    std::optional<base::Time> freeze_ends;
  };
  static std::size_t index(Cable cable) { return static_cast<std::size_t>(cable); }

  const Plan& plan_;
  Sockets sockets_;
  std::array<End, 2> ends_;
  World world_;
};

}  // namespace fencepost::test
