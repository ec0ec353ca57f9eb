// The map with its legend; each legend entry switches a layer without any script.
#pragma once

#include <optional>
#include <string>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// The style rules that make the legend's boxes work, for the page's head.
std::string top_view_rules(const ResultDocument& document, const std::optional<Scene>& truth);

std::string top_view(const ResultDocument& document, const std::optional<Scene>& truth);

}  // namespace fencepost::host
