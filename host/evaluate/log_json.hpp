// What was measured on one log as JSON, for the whole document and for a part of it.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "host/evaluate/evaluation.hpp"

namespace fencepost::host {

/// Of shares and lengths.
enum class Digits : unsigned char {
  kShown,  ///< to 1e-6
  kAll,    ///< read back they are the same; and the names of all models are there
};

nlohmann::ordered_json log_json(const Evaluation& evaluation, Digits digits);
nlohmann::ordered_json unjudged_json(std::span<const UnjudgedLog> logs);

}  // namespace fencepost::host
