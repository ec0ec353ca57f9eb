// Measures of one log as JSON, for the whole document and for a part of it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "host/evaluate/evaluation.hpp"

namespace fencepost::host {

inline constexpr int kDecimals = 6;  ///< of shares and lengths that are shown

/// Null where it is not known.
template <class Number>
nlohmann::ordered_json known(const std::optional<Number>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

/// Digits of shares and lengths.
enum class Digits : unsigned char {
  kShown,  ///< to 1e-6
  kAll,    ///< read back they are the same; and the names of all models are there
};

nlohmann::ordered_json log_json(const Evaluation& evaluation, Digits digits);
nlohmann::ordered_json unjudged_json(std::span<const UnjudgedLog> logs);

}  // namespace fencepost::host
