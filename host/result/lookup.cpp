#include "host/result/lookup.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fencepost::host {

const ModelResult* find_model(const ObjectResult& object, std::string_view name) {
  const auto found = std::find_if(object.models.begin(), object.models.end(),
                                  [&](const ModelResult& model) { return model.name == name; });
  return found == object.models.end() ? nullptr : &*found;
}

std::vector<std::string> model_names(const ResultDocument& document) {
  std::vector<std::string> names;
  for (const ObjectResult& object : document.objects) {
    for (const ModelResult& model : object.models) {
      if (std::find(names.begin(), names.end(), model.name) == names.end()) names.push_back(model.name);
    }
  }
  return names;
}

bool is_cylinder(const ModelResult& model) { return model.name.rfind("cylinder", 0) == 0; }

const Circle* object_circle(const ObjectResult& object) {
  const ModelResult* cylinder = find_model(object, "cylinder");
  if (cylinder != nullptr && cylinder->circle) return &*cylinder->circle;
  for (const ModelResult& model : object.models) {
    if (model.circle) return &*model.circle;
  }
  return nullptr;
}

const record::Signature* find_signature(const ResultDocument& document, std::uint8_t signature) {
  const auto found = std::find_if(document.signatures.begin(), document.signatures.end(),
                                  [&](const record::Signature& entry) { return entry.signature == signature; });
  return found == document.signatures.end() ? nullptr : &*found;
}

std::string signature_name(const ResultDocument& document, std::uint8_t signature) {
  const record::Signature* entry = find_signature(document, signature);
  if (entry != nullptr && !entry->name.empty()) return std::string(entry->name.view());
  return fmt::format("sig {}", signature);
}

std::string digest_text(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

}  // namespace fencepost::host
