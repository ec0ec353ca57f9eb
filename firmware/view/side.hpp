// The text beside the map: how near it is, and what there is.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/console/console_state.hpp"
#include "firmware/console/links.hpp"
#include "firmware/console/text.hpp"
#include "firmware/record/records.hpp"
#include "firmware/view/shapes.hpp"
#include "firmware/view/window.hpp"

namespace fencepost::view {

inline constexpr std::int32_t kSideLeft = Window::kSide + 2;

struct LevelSign {
  Box ground;
  Label word;
};
LevelSign level_sign(record::AlertLevel level);
/// The distance of the nearest credible object; dashes without one.
Label distance_label(const std::optional<console::Nearest>& nearest);
Label bearing_label(const std::optional<console::Nearest>& nearest);

struct ObjectLine {
  Box colour;
  Label text;  ///< "A red   0.83", metres
};
/// `row` counts the lines; `name` is the signature's, or empty.
ObjectLine object_line(std::size_t row, std::size_t slot, std::string_view name,
                       const std::optional<base::Metres>& distance);

/// The states of camera and odometry.
Label links_label(const console::Links& links);
Label mode_label(console::Mode mode);

struct ScaleBar {
  Box bar;  ///< as long as a square of the grid
  Label length;
};
ScaleBar scale_bar(const Window& window);

}  // namespace fencepost::view
