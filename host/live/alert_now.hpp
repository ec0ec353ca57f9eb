// The alert in force, for outputs beside the console: commands, a line, frames of a bus.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/records.hpp"
#include "hal/base/units.hpp"

namespace fencepost::host {

struct AlertNow {
  /// Before the first input, and after the last one, nothing can be known.
  record::Heartbeat beat{{}, record::AlertLevel::kBlind, sensor::LinkState::kAbsent, sensor::LinkState::kAbsent};
  bool may_move = false;                  ///< by loop::MotionPermit
  record::SpeedLimit speed_limit;         ///< while it may
  std::optional<record::AlertReport> of;  ///< of those at that level the nearest, where it has a place
  std::string colour;                     ///< the name of its signature, or the signature's number
};

/// Which alerts are in force, by the records of the run's own stream.
class AlertFollower {
 public:
  /// Whole lines of the stream.
  void take(std::string_view lines);
  /// `alert` with what is in force at the level of its heartbeat.
  void complete(AlertNow& alert) const;

  void accept(const record::Header& header);
  void accept(const record::Signature& signature);
  void accept(const record::AlertReport& alert);
  template <class Record>
  void accept(const Record& /*tells nothing of alerts*/) {}

 private:
  [[nodiscard]] std::string name_of(std::uint8_t signature) const;

  std::map<std::uint32_t, record::AlertReport> in_force_;  ///< by object
  std::map<std::uint8_t, std::string> names_;
};

/// Something outside that follows the alert in force.
class AlertOutput {
 public:
  virtual ~AlertOutput() = default;
  /// Once a turn of the loop. Never waits.
  virtual void show(const AlertNow& alert, base::Time now) = 0;
  /// The run is over: what moves has to stop. May take a few seconds.
  virtual void end(base::Time now) = 0;
  /// Its messages, a sentence each; asked once a turn.
  virtual std::vector<std::string> messages() { return {}; }
};

/// Maximum interval at which an output repeats the state in force.
inline constexpr base::Duration kShowInterval = base::milliseconds(40);

}  // namespace fencepost::host
