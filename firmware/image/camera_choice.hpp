// The camera of an image that contains several: one is open, and the loop polls it without knowing which.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/console/link_words.hpp"
#include "firmware/image/one_of.hpp"
#include "firmware/image/opening.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::image {

/// Each driver says which cameras it is for (`kCameras`), is made with an Opening, and sets its port up in start().
template <class First, class... Drivers>
class CameraChoice {
 public:
  /// The first, which needs no port, until another is opened.
  explicit CameraChoice(const Opening& opening) { driver_.template hold<First>(opening); }

  /// Bit n: CameraId n.
  static constexpr std::uint32_t kContained = [] {
    std::uint32_t bits = 0;
    for (const std::span<const config::CameraId> cameras : {std::span<const config::CameraId>(First::kCameras),
                                                            std::span<const config::CameraId>(Drivers::kCameras)...}) {
      for (const config::CameraId camera : cameras) bits |= 1U << static_cast<unsigned>(camera);
    }
    return bits;
  }();

  /// A camera that is contained. Not inlined: it happens seldom, and its locals would lie under the reconstruction's.
  [[gnu::noinline]] void open(const Opening& opening) {
    dropped_before_ = dropped();
    static_cast<void>(open_if<First>(opening) || (open_if<Drivers>(opening) || ...));
  }

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    return driver_.visit([now](auto& driver) { return poll_one(driver, now); });
  }
  [[nodiscard]] sensor::LinkState link() const {
    return driver_.visit([](const auto& driver) { return driver.link(); });
  }
  /// Dropped blobs of all cameras that were open.
  [[nodiscard]] std::uint32_t dropped() const {
    return dropped_before_ + driver_.visit([](const auto& driver) { return driver.dropped(); });
  }
  [[nodiscard]] bool stamped_here() const {
    return driver_.visit([](const auto& driver) { return sensor::stamped_here(driver); });
  }
  [[nodiscard]] console::LinkWords link_words(sensor::LinkState state) const {
    return driver_.visit([state](const auto& driver) { return console::link_words(driver, "camera", state); });
  }

 private:
  // Not inlined: the frames of all drivers would have places of their own on the stack.
  template <class Driver>
  [[gnu::noinline]] static base::Result<sensor::BlobFrame> poll_one(Driver& driver, base::Time now) {
    return driver.poll(now);
  }
  template <class Driver>
  bool open_if(const Opening& opening) {
    bool is_it = false;
    for (const config::CameraId camera : Driver::kCameras) is_it = is_it || camera == opening.devices.camera();
    if (!is_it) return false;
    Driver::start(opening);
    driver_.template hold<Driver>(opening);
    return true;
  }

  OneOf<First, Drivers...> driver_;
  std::uint32_t dropped_before_ = 0;
};

}  // namespace fencepost::image
