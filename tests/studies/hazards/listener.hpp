// A listener hears the robot's sensors and says stop: Fencepost's own loop, or a rule as users write it.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/result/result.hpp"
#include "tests/studies/hazards/in_force.hpp"

namespace fencepost::test {

class Listener {
 public:
  virtual ~Listener() = default;
  /// One record of the stream, line end included.
  virtual void hear(std::string_view line) = 0;
  virtual void finish() {}
  /// The map.
  [[nodiscard]] virtual std::vector<host::ObjectResult> objects() const { return {}; }
  /// m/s that the robot may have; infinite where that is not said.
  [[nodiscard]] virtual double speed_limit() const { return std::numeric_limits<double>::infinity(); }
  /// Its complaints about its own input.
  [[nodiscard]] virtual std::vector<std::string> complaints() const { return {}; }

  /// All that was said, in order.
  [[nodiscard]] const std::vector<record::AlertReport>& alerts() const { return alerts_; }
  [[nodiscard]] bool says_stop() const { return in_force_.any(record::AlertLevel::kStop); }

 protected:
  void say(const record::AlertReport& alert);

 private:
  std::vector<record::AlertReport> alerts_;
  InForce in_force_;
};

/// Fencepost, `range` or `width`: share/doc has the first, peer_rules.hpp the others.
enum class Rule : unsigned char { kFencepost, kRange, kWidth };

std::string_view name(Rule rule);
/// errors: throws std::runtime_error for an unknown profile
std::unique_ptr<Listener> make_listener(Rule rule, const std::string& profile,
                                        const std::vector<record::Setting>& settings);

}  // namespace fencepost::test
