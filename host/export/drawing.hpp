// The top view of a run as shapes and labels: drawn once, written as SVG or painted as PNG.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "host/export/run.hpp"

namespace fencepost::host::exports {

/// Lines or areas; px, y down.
struct Shape {
  std::vector<std::vector<Point>> lines;
  bool closed = false;
  sensor::Rgb stroke;
  double width = 1;  ///< px
  sensor::Rgb fill;
  double fill_opacity = 0;  ///< closed ones: 0 is no fill, areas are even-odd
  bool dashed = false;
  std::string title;  ///< the tooltip in viewers that have one
};

enum class Align : unsigned char { kStart, kMiddle, kEnd };
struct Label {
  Point at;  ///< of the baseline
  std::string text;
  sensor::Rgb colour;
  Align anchor = Align::kMiddle;
  double size = 13;  ///< px
};

struct Drawing {
  double width = 0;  ///< px
  double height = 0;
  std::vector<std::variant<Shape, Label>> parts;  ///< from the back to the front
};

/// Grid in metres, outlines with their numbers and names, the robot's path and its last pose.
Drawing draw_run(const Run& run, const std::string& model);

/// A file of its own, without a style sheet or script.
std::string svg_of(const Drawing& drawing, const std::string& title);

/// `scale`: px of the picture for one of the drawing. Labels are ASCII there; other letters are shown as '?'.
/// errors: std::runtime_error with libpng's words
std::string png_of(const Drawing& drawing, double scale);

}  // namespace fencepost::host::exports
