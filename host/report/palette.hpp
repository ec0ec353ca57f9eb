// Colours and line styles: an object's colour is its signature's, a model has a line style.
#pragma once

#include <string>

#include "hal/sensor/blob_frame.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// Relative luminance (WCAG 2) below which a line's colour has contrast 3:1 with white paper.
inline constexpr double kLineLuminance = 1.05 / 3.0 - 0.05;
/// The same for text, 4.5:1.
inline constexpr double kTextLuminance = 1.05 / 4.5 - 0.05;

/// "#rrggbb" of the same hue, darkened until its luminance is at most `max_luminance`.
std::string ink(sensor::Rgb colour, double max_luminance);

/// "#rrggbb" as it is.
std::string hex(sensor::Rgb colour);

/// The signature's colour from the log; a colour of our own, by number, where the log has none.
sensor::Rgb signature_colour(const ResultDocument& document, std::uint8_t signature);

struct ModelStyle {
  std::string dash;         ///< stroke-dasharray; empty: solid
  double width = 1.6;       ///< px
  double fill_opacity = 0;  ///< of the signature's colour
  int layer = 0;            ///< higher is drawn later
  bool shown = true;        ///< ticked when the page opens
};

/// Models not known here get a style of their own kind, the same each time.
ModelStyle model_style(const std::string& name);

/// Fill of an alert level, light to dark so that it survives a black-and-white printer.
std::string level_colour(record::AlertLevel level);

}  // namespace fencepost::host
