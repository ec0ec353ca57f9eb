// Measures of a part of the logs, written on one machine and joined with others on another. All digits are kept, so the
// means of the whole do not depend on how it was divided.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host/evaluate/evaluation.hpp"

namespace fencepost::host {

struct EvaluationPart {
  std::vector<std::uint32_t> views;
  std::vector<Evaluation> evaluations;
  std::vector<UnjudgedLog> unjudged;
};

std::string part_json(const EvaluationPart& part);

/// The message says what is wrong and what to try.
class NotAPart : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `name` is used in messages only. errors: NotAPart
EvaluationPart read_part(std::string_view text, const std::string& name);

/// In the order given. errors: NotAPart: they were measured at different numbers of views
EvaluationPart join_parts(std::vector<EvaluationPart> parts);

}  // namespace fencepost::host
