// The odometry of an image that contains several, likewise.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/console/link_words.hpp"
#include "firmware/image/one_of.hpp"
#include "firmware/image/opening.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::image {

/// As CameraChoice, with `kOdometries`.
template <class First, class... Drivers>
class OdometryChoice {
 public:
  explicit OdometryChoice(const Opening& opening) { driver_.template hold<First>(opening); }

  /// Bit n: OdometryId n.
  static constexpr std::uint32_t kContained = [] {
    std::uint32_t bits = 0;
    for (const std::span<const config::OdometryId> odometries :
         {std::span<const config::OdometryId>(First::kOdometries),
          std::span<const config::OdometryId>(Drivers::kOdometries)...}) {
      for (const config::OdometryId odometry : odometries) bits |= 1U << static_cast<unsigned>(odometry);
    }
    return bits;
  }();

  /// Opens one that is contained. A base that drives is stopped before it is left.
  [[gnu::noinline]] void open(const Opening& opening, base::Time now) {
    driver_.visit([now](auto& driver) {
      if constexpr (requires { driver.session().stand(); }) {
        driver.session().stand();
        driver.push(now);
      }
    });
    static_cast<void>(open_if<First>(opening) || (open_if<Drivers>(opening) || ...));
  }

  base::Result<sensor::OdometrySample> poll(base::Time now) {
    return driver_.visit([now](auto& driver) { return driver.poll(now); });
  }
  [[nodiscard]] sensor::LinkState link() const {
    return driver_.visit([](const auto& driver) { return driver.link(); });
  }
  [[nodiscard]] bool stamped_here() const {
    return driver_.visit([](const auto& driver) { return sensor::stamped_here(driver); });
  }
  [[nodiscard]] console::LinkWords link_words(sensor::LinkState state) const {
    return driver_.visit([state](const auto& driver) { return console::link_words(driver, "odometry", state); });
  }
  /// The speed that a wheel base which drives by itself may have, mm/s; others are not asked.
  void allow_motion(std::int16_t most) {
    driver_.visit([most](auto& driver) {
      if constexpr (requires { driver.session().allow_motion(true, most); }) {
        driver.session().allow_motion(most > 0, most);
      }
    });
  }

 private:
  template <class Driver>
  bool open_if(const Opening& opening) {
    bool is_it = false;
    for (const config::OdometryId odometry : Driver::kOdometries)
      is_it = is_it || odometry == opening.devices.odometry();
    if (!is_it) return false;
    Driver::start(opening);
    driver_.template hold<Driver>(opening);
    return true;
  }

  OneOf<First, Drivers...> driver_;
};

}  // namespace fencepost::image
