// Look-ups in a result document.
#pragma once

#include <string>
#include <string_view>

#include "host/result/result.hpp"

namespace fencepost::host {

/// The model of that name, or null.
const ModelResult* find_model(const ObjectResult& object, std::string_view name);

/// The names of all models in the document, in order of first appearance.
std::vector<std::string> model_names(const ResultDocument& document);

/// Models that carry a centre and a radius: those whose name starts with "cylinder".
bool is_cylinder(const ModelResult& model);

/// The object's circle: `cylinder`, else any model's.
const Circle* object_circle(const ObjectResult& object);

/// The signature's entry in the log's table, or null.
const record::Signature* find_signature(const ResultDocument& document, std::uint8_t signature);

/// Its name; `sig 7` where the log has none.
std::string signature_name(const ResultDocument& document, std::uint8_t signature);

/// 16 lower-case hex digits.
std::string digest_text(std::uint64_t digest);

}  // namespace fencepost::host
