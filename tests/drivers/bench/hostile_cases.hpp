// All drivers that run through hostile hours and keep the contract.
#pragma once

#include <cctype>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "tests/drivers/bench/hostile_figures.hpp"
#include "tests/drivers/bench/subject.hpp"

namespace fencepost::test {

struct HostileCase {
  std::string_view name;  ///< as devices are named on command lines, with what is behind the colon
  std::unique_ptr<Subject> (*make)(const Damage&);
  HostileLimits limits;
};

/// Steps of the loop in milliseconds, as coarse as the device allows.
template <class Rig, std::int64_t Step>
HostileCase hostile_case(std::string_view name, const HostileLimits& limits) {
  const auto make = [](const Damage& damage) -> std::unique_ptr<Subject> {
    return std::make_unique<RigSubject<Rig>>(base::milliseconds(Step), damage);
  };
  return {name, make, limits};
}

/// Adds a case, before `main`. Its source belongs to fencepost_hostile.
struct RegisteredCase {
  explicit RegisteredCase(const HostileCase& hostile_case);
};

std::span<const HostileCase> hostile_cases();

/// For INSTANTIATE_TEST_SUITE_P: the letters and digits of a case's name.
struct TestName {
  template <class Info>
  std::string operator()(const Info& driver) const {
    std::string name(driver.param.name);
    std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
    return name;
  }
};

/// A protocol without checksum, or whose checksum a cable stands for that is damaged here.
inline constexpr double kNoSum = 0.1;
/// The share of undetected damage that a protocol with sums of one byte may have.
inline constexpr double kSum8 = 1e-3;

}  // namespace fencepost::test
