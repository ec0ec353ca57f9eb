#include "host/calibrate/known.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "hal/base/result.hpp"
#include "host/text/device_word.hpp"

namespace fencepost::host {
namespace {

/// errors: a sentence: no such colour.
base::Result<std::uint8_t, std::string> signature_called(const std::string& name,
                                                         const std::vector<record::Signature>& signatures) {
  std::vector<std::string> names;
  for (const record::Signature& signature : signatures) {
    if (signature.name.view() == name) return signature.signature;
    names.emplace_back(signature.name.view());
  }
  unsigned number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc() && end == name.data() + name.size() && number <= 255)
    return static_cast<std::uint8_t>(number);
  return no_such("colour", name, names);
}

std::vector<std::size_t> objects_of(std::uint8_t signature, const StartedProblem& started) {
  std::vector<std::size_t> objects;
  for (std::size_t o = 0; o < started.signatures.size(); ++o) {
    if (started.signatures[o] == signature) objects.push_back(o);
  }
  return objects;
}

}  // namespace

std::string signature_name(const std::vector<record::Signature>& signatures, std::uint8_t signature) {
  const auto known = std::ranges::find(signatures, signature, &record::Signature::signature);
  if (known == signatures.end() || known->name.view().empty()) return fmt::format("sig {}", signature);
  return std::string(known->name.view());
}

std::optional<std::string> add_known(const CalibrateOptions& options, const std::vector<record::Signature>& signatures,
                                     StartedProblem& started) {
  const auto seen = [&](const std::string& name, std::vector<std::size_t>& objects) -> std::optional<std::string> {
    const auto signature = signature_called(name, signatures);
    if (!signature) return signature.error();
    objects = objects_of(*signature, started);
    if (!objects.empty()) return std::nullopt;
    return fmt::format("nothing of colour {} was seen often enough to be measured by", name);
  };
  for (const NamedSize& size : options.sizes) {
    std::vector<std::size_t> objects;
    if (auto wrong = seen(size.signature, objects)) return "--size: " + *wrong;
    for (const std::size_t object : objects) started.problem.sizes.push_back({object, size.width});
  }
  for (const NamedDistance& apart : options.distances) {
    std::vector<std::size_t> a;
    std::vector<std::size_t> b;
    if (auto wrong = seen(apart.a, a)) return "--distance: " + *wrong;
    if (auto wrong = seen(apart.b, b)) return "--distance: " + *wrong;
    if (apart.a == apart.b) return "--distance: give two different colours, one for each block";
    // Several objects of a colour: it is not known which one was measured, and parts of one are joined later.
    for (const std::size_t i : a) {
      for (const std::size_t j : b) started.problem.distances.push_back({i, j, apart.distance});
    }
  }
  return std::nullopt;
}

}  // namespace fencepost::host
