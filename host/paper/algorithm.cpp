#include "host/paper/algorithm.hpp"

#include <algorithm>
#include <memory>

#include "firmware/config/profile.hpp"
#include "host/replay/models.hpp"

namespace fencepost::host {
namespace {

std::vector<Algorithm> all() {
  return {
      {"cylinder", "cylinder (as printed)", "cylinder_paper", false, "#c0392b", "", 100.00, 97.26, 98.63},
      {"sheaf", "plane sheaf", "sheaf", false, "#2e8b57", "", 97.26, 98.63, 97.95},
      {"carving", "space carving (as printed)", "carve_paper", false, "#1f5fbf", "", 91.78, 98.63, 95.21},
      {"carving_evidence", "space carving, contradicted cuts left out", "carve", false, "#1f5fbf", "4 2", {}, {}, {}},
      {"cylinder_edges", "cylinder (edge tangents)", "cylinder", false, "#d98200", "5 3", {}, {}, {}},
      {"hybrid", "hybrid", "hybrid", false, "#6a1b9a", "", {}, {}, {}},
      {"hybrid_inferred", "hybrid, robot\u2019s own flags", "hybrid", true, "#6a1b9a", "2 3", {}, {}, {}}};
}

std::vector<Algorithm> available() {
  const auto models = models_of(*std::make_unique<recon::Object<Compared<config::Full>>>());
  std::vector<Algorithm> kept = all();
  std::erase_if(kept, [&](const Algorithm& algorithm) {
    return std::none_of(models.begin(), models.end(), [&](const auto& m) { return m.name == algorithm.model; });
  });
  return kept;
}

}  // namespace

const std::vector<Algorithm>& algorithms() {
  static const std::vector<Algorithm> kept = available();
  return kept;
}

std::optional<std::size_t> algorithm_index(std::string_view key) {
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    if (algorithms()[i].key == key) return i;
  }
  return std::nullopt;
}

}  // namespace fencepost::host
