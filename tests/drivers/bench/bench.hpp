// A device, its cable and its driver on one clock: the fixture of all driver tests.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::test {

/// Ten seconds of the fastest camera: what a stalled line may give when it goes on.
inline constexpr std::int64_t kOldImages = 700;

/// Of an image that many columns and rows wide: a box of 42 x 31, elsewhere in each image.
inline sensor::Blob moving_box(std::int64_t image, std::int64_t columns, std::int64_t rows) {
  const auto x = static_cast<std::int16_t>(image % columns);
  const auto y = static_cast<std::int16_t>(image / columns % rows);
  return {3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
          0, {}};
}

/// Common to all camera rigs. Each image shows `scene`. With `moving` each shows a different box, so that a damaged or
/// an old one cannot be taken for the right one. `Self` has kWidth and kHeight of the driver's image and
/// `blob_of(image)`, that box as the device is shown it. Where the driver gives another blob, it has is(frame, image).
template <class Self, class Thing = sensor::Blob>
struct CameraRig {
  using Sample = sensor::BlobFrame;

  static constexpr std::size_t kMaxThings = 20;  ///< in one image: more than a frame holds

  std::vector<Thing> scene;
  bool moving = false;
  std::int64_t images = 0;
  bool exposing = true;  ///< the imager works
  base::Time next_image;
  std::int64_t latest = 3;  ///< latency: a right sample may be this many images old, itself included

  /// Whether an image is due.
  bool expose(base::Time now, base::Duration period) {
    if (now < next_image) return false;
    next_image = now + period;
    if (exposing) ++images;
    return exposing;
  }
  /// Things in an image that is taken now.
  [[nodiscard]] std::vector<Thing> seen() const { return moving ? std::vector{Self::blob_of(images)} : scene; }
  static bool is(const sensor::BlobFrame& frame, std::int64_t image) {
    return frame.blobs.size() == 1 && frame.blobs[0] == Self::blob_of(image);
  }
  [[nodiscard]] bool shows(const sensor::BlobFrame& frame, std::int64_t last) const {
    return any_of_last(last, [&](std::int64_t image) { return Self::is(frame, image); });
  }
  [[nodiscard]] bool right(const sensor::BlobFrame& frame) const { return shows(frame, latest); }
  [[nodiscard]] bool old(const sensor::BlobFrame& frame) const { return shows(frame, kOldImages); }
  /// Whether `is(n)` holds for the number of one of the last `count` images.
  template <class Is>
  [[nodiscard]] bool any_of_last(std::int64_t count, Is is) const {
    for (std::int64_t image = images; image > images - count && image >= 0; --image) {
      if (is(image)) return true;
    }
    return false;
  }
};

struct BenchClock {
  fake::SteppedClock clock;
};

/// Rig: constructed on a clock, with
/// - `Sample`, and `poll(now)` as the driver's
/// - `device`, `link` (a Plug), `driver`
/// - `live(now)`: the device's own activity; `restart(now)`: a power cycle
/// - `right(sample)`: whether that is what the device says now, `old(sample)`: or said some seconds ago; for rigs that
///   are `moving`
template <class Rig>
class Bench : private BenchClock, public Rig {
 public:
  using Sample = typename Rig::Sample;
  using BenchClock::clock;

  template <class... Args>
  explicit Bench(Args&&... args) : Rig(BenchClock::clock, std::forward<Args>(args)...) {}

  /// The device acts, then the driver is polled once.
  std::optional<Sample> step(base::Duration time = base::milliseconds(1)) {
    clock.advance(time);
    this->live(clock.now());
    const base::Result<Sample> got = this->poll(clock.now());
    if (!got) return std::nullopt;
    disorder += last_t && got->t <= *last_t ? 1U : 0U;
    last_t = got->t;
    return *got;
  }
  /// By milliseconds; the samples of this time, which `frames` gathers too.
  std::vector<Sample> run(base::Duration time) {
    std::vector<Sample> samples;
    for (const base::Time end = clock.now() + time; clock.now() < end;) {
      if (const auto sample = step()) samples.push_back(*sample);
    }
    frames.insert(frames.end(), samples.begin(), samples.end());
    return samples;
  }
  std::vector<Sample> run(std::int64_t ms) { return run(base::milliseconds(ms)); }
  template <class Scene>
  std::vector<Sample> run(std::int64_t ms, const Scene& shown) {
    this->scene = shown;
    return run(ms);
  }
  std::vector<Sample> run(std::int64_t ms, std::initializer_list<sensor::Blob> shown) {
    this->scene = shown;
    return run(ms);
  }

  std::vector<Sample> frames;
  std::uint32_t disorder = 0;  ///< samples that are not later than the one before
  std::optional<base::Time> last_t;
};

}  // namespace fencepost::test
