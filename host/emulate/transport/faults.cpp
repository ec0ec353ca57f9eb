#include "host/emulate/transport/faults.hpp"

#include <cstdlib>
#include <vector>

namespace fencepost::emulate {
namespace {

enum class Shape : std::uint8_t { kProbability, kProbabilityAndTime, kPeriod, kPeriodAndTime };

struct Known {
  std::string_view name;
  Shape shape;
  std::string_view example;
};

constexpr Known kKnown[] = {{"drop", Shape::kProbability, "drop=0.01"},
                            {"corrupt", Shape::kProbability, "corrupt=0.01"},
                            {"stall", Shape::kProbabilityAndTime, "stall=0.001:2.0"},
                            {"late", Shape::kProbabilityAndTime, "late=0.05:0.2"},
                            {"reboot", Shape::kPeriod, "reboot=30"},
                            {"unplug", Shape::kPeriodAndTime, "unplug=20:3"}};

/// A plain positive number and nothing else.
std::optional<double> number_in(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789.") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

struct Values {
  double first = 0;
  base::Duration first_time;
  base::Duration second_time;
};

std::optional<Values> values_in(const std::string& text, Shape shape) {
  const std::vector<std::string> parts = split(text, ':');
  const bool two = shape == Shape::kProbabilityAndTime || shape == Shape::kPeriodAndTime;
  const bool probability = shape == Shape::kProbability || shape == Shape::kProbabilityAndTime;
  if (parts.size() != (two ? 2U : 1U)) return std::nullopt;
  const std::optional<double> first = number_in(parts[0]);
  const std::optional<double> second = two ? number_in(parts[1]) : 0.0;
  constexpr double kLongest = 86'400;
  if (!first || !second || *first > (probability ? 1 : kLongest) || *second > kLongest) return std::nullopt;
  if (!probability && *first < 0.1) return std::nullopt;  // it would never be up
  return Values{*first, base::Duration::nearest(*first), base::Duration::nearest(*second)};
}

void set(FaultSettings& settings, std::string_view name, const Values& values) {
  if (name == "drop") settings.drop = values.first;
  if (name == "corrupt") settings.corrupt = values.first;
  if (name == "stall") settings.stall = values.first, settings.stall_time = values.second_time;
  if (name == "late") settings.late = values.first, settings.late_time = values.second_time;
  if (name == "reboot") settings.reboot = values.first_time;
  if (name == "unplug") settings.unplug = values.first_time, settings.unplug_time = values.second_time;
}

}  // namespace

ParsedFaults parse_faults(std::string_view text, const FaultSettings& start) {
  ParsedFaults parsed{start, {}};
  for (const std::string& part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const Known* known = nullptr;
    for (const Known& candidate : kKnown) {
      if (candidate.name == name) known = &candidate;
    }
    if (known == nullptr) {
      parsed.problem = "no fault \"" + name + "\"; there are drop, corrupt, stall, late, reboot and unplug";
      return parsed;
    }
    const auto values = equals == std::string::npos ? std::nullopt : values_in(part.substr(equals + 1), known->shape);
    if (!values) {
      parsed.problem = "fault \"" + part + "\" is not as in " + std::string(known->example) +
                       " (probabilities 0 to 1, times in seconds, periods from 0.1)";
      return parsed;
    }
    set(parsed.settings, name, *values);
  }
  return parsed;
}

bool Dice::chance(double probability) {
  if (probability <= 0) return false;
  return static_cast<double>(random_() >> 11U) * 0x1.0p-53 < probability;
}

std::uint8_t Dice::another(std::uint8_t byte) { return static_cast<std::uint8_t>(byte ^ (1U + random_() % 255U)); }

std::optional<std::uint8_t> damaged(std::uint8_t byte, const FaultSettings& faults, Dice& dice, FaultCounts& counts) {
  ++counts.bytes;
  const bool lost = dice.chance(faults.drop);
  const bool other = dice.chance(faults.corrupt);
  counts.dropped += lost ? 1U : 0U;
  if (lost) return std::nullopt;
  counts.corrupted += other ? 1U : 0U;
  return other ? dice.another(byte) : byte;
}

}  // namespace fencepost::emulate
