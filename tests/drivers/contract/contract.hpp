// The contract that every driver keeps, whatever its protocol. Each case breaks one thing, many times, on a good cable.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/drivers/bench/subject.hpp"

namespace fencepost::test {

/// Figures of one case. What a driver can notice, and how soon it goes on, is its protocol's: contract.csv has them.
struct Kept {
  std::uint32_t tries = 0;
  std::uint32_t unnoticed = 0;      ///< samples that the device did not send
  base::Duration longest;           ///< from a fault to the second right sample after it
  base::Duration total;             ///< of all these times
  std::vector<std::string> broken;  ///< promises that hold for all drivers, in words
};

struct ContractCase {
  std::string_view name;
  Kept (*run)(Subject&);
  bool one_fault;  ///< of which a checksum tells
};

/// Each is run with a subject of its own.
std::span<const ContractCase> contract_cases();

}  // namespace fencepost::test
