// The map on a small screen, a step a turn of the loop: an object, or a few rows. Buttons change what is shown.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/alert/alerts.hpp"
#include "firmware/console/links.hpp"
#include "firmware/console/map_shape.hpp"
#include "firmware/console/signatures.hpp"
#include "firmware/view/map_source.hpp"
#include "firmware/view/picture.hpp"
#include "firmware/view/side.hpp"
#include "hal/bus/buttons.hpp"
#include "hal/bus/screen.hpp"

namespace fencepost::view {

template <MapSource Source, bus::Screen Screen>
class MapView {
 public:
  MapView(Source& source, Screen& screen) : source_(source), screen_(screen) {}

  void start() {
    for (std::size_t i = 0; i < std::size(kFixedColours); ++i) screen_.set_colour(i, kFixedColours[i]);
  }

  /// START: the console's next mode. SELECT: forget the map, start a new run. A: nearer. B: farther; SELECT also
  /// shows everything again.
  void press(const bus::Buttons& held) {
    const bus::Buttons before = held_;
    held_ = held;
    if (source_.testing()) return;
    if (held.start && !before.start) source_.set_mode(next(source_.mode()));
    if (held.select && !before.select) start_again();
    if (held.a && !before.a && picture_.window().scale > 0) zoom_ = picture_.window().scale - 1U;
    if (held.b && !before.b && picture_.window().scale + 1U < kScales.size()) zoom_ = picture_.window().scale + 1U;
  }

  /// One step of the picture.
  [[gnu::noinline]] void turn(const console::Links& links) {
    if (step_ == 0) {
      begin();
    } else if (step_ <= Source::kObjects) {
      look_at(step_ - 1);
    } else if (step_ == Source::kObjects + 1) {
      describe(links);
    } else {
      paint();
      return;
    }
    ++step_;
  }

 private:
  static constexpr std::size_t kRowsPerTurn = 2;
  static constexpr std::size_t kMaxNamed = 8;  ///< objects that the text has lines for

  static console::Mode next(console::Mode mode) {
    return static_cast<console::Mode>((static_cast<std::size_t>(mode) + 1) % console::kModes);
  }
  void start_again() {
    zoom_.reset();
    source_.restart();
  }

  void begin() {
    picture_.begin(window());
    if (const auto robot = source_.robot()) picture_.put_robot(make_robot(*robot, picture_.window()));
    level_ = record::AlertLevel::kClear;
    nearest_.reset();
    named_ = row_ = 0;
  }

  // All of the map, until the user zooms; then the robot is in the middle.
  [[nodiscard]] Window window() const {
    console::MapMillimetres robot;
    if (const auto pose = source_.robot()) robot = console::millimetres(pose->position);
    if (zoom_) return {robot, static_cast<std::uint8_t>(*zoom_)};
    console::MapExtent extent;
    extent.include(robot, 0);
    for (const auto& object : source_.objects()) {
      if (const auto shape = console::shape_of(object)) shape->include_in(extent);
    }
    return window_of(extent);
  }

  void look_at(std::size_t slot) {
    const auto& object = source_.objects()[slot];
    const auto shape = console::shape_of(object);
    const auto robot = source_.robot();
    if (!shape || !robot) return;
    colour(slot, object.signature);
    picture_.add(make_figure(*shape, slot, picture_.window()));
    const alert::Obstacle obstacle = alert::see_obstacle(object, alert::RobotPlace(*robot), {});
    const auto distance = base::Metres::nearest(obstacle.distance);
    if (alert::credible(object) && (!nearest_ || distance < nearest_->distance)) {
      nearest_ = console::Nearest{distance, base::Radians::nearest(obstacle.bearing())};
    }
    level_ = std::max(level_, source_.alert_level(slot));
    if (named_ == kMaxNamed) return;
    const ObjectLine line =
        object_line(named_++, slot, console::name_of(object.signature, source_.signatures()), distance);
    picture_.add(line.colour);
    picture_.add(line.text);
  }

  // As the camera was taught it, where that is known.
  void colour(std::size_t slot, std::uint8_t signature) {
    bus::Colour colour{160, 160, 160};
    if (const record::Signature* known = console::find_signature(signature, source_.signatures())) {
      colour = {known->rgb.red, known->rgb.green, known->rgb.blue};
    }
    screen_.set_colour(kObjects + slot, colour);
    screen_.set_colour(kOutlines + slot, lighter(colour));
  }

  void describe(const console::Links& links) {
    const LevelSign sign = level_sign(level_);
    picture_.add(sign.ground);
    picture_.add(sign.word);
    picture_.add(distance_label(nearest_));
    picture_.add(bearing_label(nearest_));
    picture_.add(links_label(links));
    picture_.add(mode_label(source_.mode()));
    const ScaleBar bar = scale_bar(picture_.window());
    picture_.add(bar.bar);
    picture_.add(bar.length);
  }

  void paint() {
    if (!screen_.ready()) return;
    for (std::size_t i = 0; i < kRowsPerTurn && row_ < Screen::kHeight; ++i, ++row_) {
      std::array<std::uint8_t, Screen::kWidth> pixels;
      Row row(pixels, static_cast<std::int32_t>(row_));
      picture_.paint(row);
      screen_.put_row(row_, pixels);
    }
    if (row_ < Screen::kHeight) return;
    screen_.show();
    step_ = 0;
  }

  Source& source_;
  Screen& screen_;
  Picture<Source::kObjects> picture_;
  bus::Buttons held_;
  std::optional<std::size_t> zoom_;
  std::size_t step_ = 0;
  std::size_t row_ = 0;
  // State of the picture that is being composed.
  std::size_t named_ = 0;
  record::AlertLevel level_ = record::AlertLevel::kClear;
  std::optional<console::Nearest> nearest_;
};

}  // namespace fencepost::view
