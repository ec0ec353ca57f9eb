// The map on a small screen, a bit a turn of the loop: an object, or a few rows. Buttons change what is shown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/console/map_shape.hpp"
#include "firmware/loop/pipeline.hpp"
#include "firmware/view/picture.hpp"
#include "firmware/view/side.hpp"
#include "hal/bus/buttons.hpp"
#include "hal/bus/screen.hpp"

namespace fencepost::view {

template <class Profile, bus::Screen Screen>
class MapView {
 public:
  MapView(app::Pipeline<Profile>& pipeline, Screen& screen) : pipeline_(pipeline), screen_(screen) {}

  void start() {
    for (std::size_t i = 0; i < std::size(kFixedColours); ++i) screen_.set_colour(i, kFixedColours[i]);
  }

  /// START: the console's next mode. SELECT: forget the map, start a new run. A: nearer. B: farther; SELECT also
  /// shows everything again.
  void press(const bus::Buttons& held) {
    const bus::Buttons before = held_;
    held_ = held;
    if (pipeline_.testing()) return;
    if (held.start && !before.start) pipeline_.set_mode(next(pipeline_.mode()));
    if (held.select && !before.select) start_again();
    if (held.a && !before.a && picture_.window().scale > 0) zoom_ = picture_.window().scale - 1U;
    if (held.b && !before.b && picture_.window().scale + 1U < kScales.size()) zoom_ = picture_.window().scale + 1U;
  }

  /// One step of the picture.
  [[gnu::noinline]] void turn(const app::Links& links) {
    if (step_ == 0) {
      begin();
    } else if (step_ <= Profile::kObjects) {
      look_at(step_ - 1);
    } else if (step_ == Profile::kObjects + 1) {
      tell(links);
    } else {
      paint();
      return;
    }
    ++step_;
  }

 private:
  static constexpr std::size_t kRowsPerTurn = 2;
  static constexpr std::size_t kMostNamed = 8;  ///< objects that the text has lines for

  static app::Mode next(app::Mode mode) {
    return static_cast<app::Mode>((static_cast<std::size_t>(mode) + 1) % app::kModes);
  }
  void start_again() {
    zoom_.reset();
    pipeline_.restart();
  }

  [[nodiscard]] const app::Memory<Profile>& memory() const { return pipeline_.memory(); }

  void begin() {
    picture_.begin(window());
    if (!memory().poses.empty()) picture_.put_robot(make_robot(app::robot_pose(memory()), picture_.window()));
    level_ = record::AlertLevel::kClear;
    nearest_.reset();
    named_ = row_ = 0;
  }

  // All of it, until somebody zooms; then the robot is in the middle.
  [[nodiscard]] Window window() const {
    app::MapMillimetres robot;
    if (!memory().poses.empty()) robot = app::millimetres(app::robot_pose(memory()).position);
    if (zoom_) return {robot, static_cast<std::uint8_t>(*zoom_)};
    app::MapExtent extent;
    extent.include(robot, 0);
    for (const auto& object : memory().map.slots()) {
      if (const auto shape = app::shape_of(object)) shape->include_in(extent);
    }
    return window_of(extent);
  }

  void look_at(std::size_t slot) {
    const auto& object = memory().map.slots()[slot];
    const auto shape = app::shape_of(object);
    if (!shape || memory().poses.empty()) return;
    colour(slot, object.signature);
    picture_.add(make_figure(*shape, slot, picture_.window()));
    const app::Obstacle obstacle = app::see_obstacle(object, app::RobotPlace(app::robot_pose(memory())), {});
    const auto distance = base::Metres::nearest(obstacle.distance);
    if (app::credible(object) && (!nearest_ || distance < nearest_->distance)) {
      nearest_ = app::Nearest{distance, base::Radians::nearest(obstacle.bearing())};
    }
    const app::AlertState& alert = memory().alerts[slot];
    if (alert.id == object.id && alert.level > level_) level_ = alert.level;
    if (named_ == kMostNamed) return;
    const ObjectLine line = object_line(named_++, slot, pipeline_.telling().name_of(object.signature), distance);
    picture_.add(line.colour);
    picture_.add(line.text);
  }

  // As the camera was taught it, where that was told.
  void colour(std::size_t slot, std::uint8_t signature) {
    bus::Colour colour{160, 160, 160};
    for (const record::Signature& known : memory().signatures) {
      if (known.signature == signature) colour = {known.rgb.red, known.rgb.green, known.rgb.blue};
    }
    screen_.set_colour(kObjects + slot, colour);
    screen_.set_colour(kOutlines + slot, lighter(colour));
  }

  void tell(const app::Links& links) {
    const LevelSign sign = level_sign(level_);
    picture_.add(sign.ground);
    picture_.add(sign.word);
    picture_.add(distance_label(nearest_));
    picture_.add(bearing_label(nearest_));
    picture_.add(links_label(links));
    picture_.add(mode_label(pipeline_.mode()));
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

  app::Pipeline<Profile>& pipeline_;
  Screen& screen_;
  Picture<Profile::kObjects> picture_;
  bus::Buttons held_;
  std::optional<std::size_t> zoom_;
  std::size_t step_ = 0;
  std::size_t row_ = 0;
  // Of the picture that is being taken.
  std::size_t named_ = 0;
  record::AlertLevel level_ = record::AlertLevel::kClear;
  std::optional<app::Nearest> nearest_;
};

}  // namespace fencepost::view
