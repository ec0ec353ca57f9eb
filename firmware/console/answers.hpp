// Answers of one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/config/devices.hpp"
#include "firmware/config/settings.hpp"
#include "firmware/console/console_state.hpp"
#include "firmware/console/help.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::console {

/// The facts that the answers report.
struct AnswerFacts {
  Mode mode = Mode::kText;
  bool alerts = true;
  bool whole = true;  ///< all inputs of this run were used in mode log
  SettingsInForce in_force;
  const record::Header* header = nullptr;
  std::uint64_t digest = 0;
  std::uint64_t expected_digest = 0;
  std::string_view note;  ///< of the image, part of `version`
};

/// Answers that are lists (help, status, objects, map, all settings) are not known here.
std::size_t write_answer(const Answer& answer, const AnswerFacts& facts, std::span<char> out);

}  // namespace fencepost::console
