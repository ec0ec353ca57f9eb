// A driver on its cable with its device, whatever they are: compiled once for each rig, and nothing else is.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

#include "hal/base/fnv1a.hpp"
#include "hal/sensor/link_state.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {

/// Images of a camera: a different box in each; one, two or three boxes; these in turns; a crowd; none.
/// Wheels drive straight on.
enum class Scene : std::uint8_t { kMoving, kOne, kTwo, kThree, kTurns, kCrowd, kNothing };

/// A sample, by what it says.
struct Seen {
  bool right = false;      ///< the device says so now, of kMoving
  bool old = false;        ///< or said so some seconds ago
  bool possible = true;    ///< boxes lie in the image
  bool sorted = true;      ///< boxes become smaller
  std::uint64_t what = 0;  ///< equal for equal boxes, and for all poses that are right
  std::size_t blobs = 0;
};

class Subject {
 public:
  virtual ~Subject() = default;

  /// The device acts, then the driver is polled once.
  virtual std::optional<Seen> step() = 0;
  virtual void show(Scene scene) = 0;
  [[nodiscard]] virtual bool sees() const = 0;  ///< a camera
  [[nodiscard]] virtual base::Time now() const = 0;
  [[nodiscard]] virtual sensor::LinkState link() const = 0;
  [[nodiscard]] virtual std::uint32_t dropped() const = 0;  ///< blobs
  [[nodiscard]] virtual std::uint32_t disorder() const = 0;
  [[nodiscard]] virtual std::size_t waiting() const = 0;
  virtual Plug& plug() = 0;
  virtual Line* line() = 0;  ///< none where a cable carries whole transfers
  virtual void unplug() = 0;
  virtual void forget() = 0;   ///< all that is on the cable
  virtual void restart() = 0;  ///< a power cycle of the device
  /// Adds the last sample to a digest; what the driver counted.
  virtual void say(base::Fnv1a64& digest) const = 0;
  virtual void count(base::Fnv1a64& digest) const = 0;

  void pass(base::Duration time) {
    for (const base::Time end = now() + time; now() < end;) (void)step();
  }
};

template <class Rig>
class RigSubject final : public Subject {
 public:
  RigSubject(base::Duration step, const Damage& damage) : bench_(damage), step_(step) { show(Scene::kMoving); }

  std::optional<Seen> step() override {
    choose();
    sample_ = bench_.step(step_);
    if (!sample_) return std::nullopt;
    return judged(*sample_);
  }
  void show(Scene scene) override {
    scene_ = scene;
    if constexpr (requires { bench_.moving; }) bench_.moving = !kSees || scene == Scene::kMoving;
    chosen_.reset();
  }
  [[nodiscard]] bool sees() const override { return kSees; }
  [[nodiscard]] base::Time now() const override { return bench_.clock.now(); }
  [[nodiscard]] sensor::LinkState link() const override { return bench_.driver.link(); }
  [[nodiscard]] std::uint32_t dropped() const override {
    if constexpr (kSees) return bench_.driver.dropped();
    return 0;
  }
  [[nodiscard]] std::uint32_t disorder() const override { return bench_.disorder; }
  [[nodiscard]] std::size_t waiting() const override { return bench_.link.waiting(); }
  Plug& plug() override { return bench_.link; }
  Line* line() override {
    if constexpr (std::is_base_of_v<Line, std::remove_reference_t<decltype(bench_.link)>>) return &bench_.link;
    return nullptr;
  }
  void unplug() override { bench_.link.unplug(); }
  void forget() override { bench_.link.forget(); }
  void restart() override { bench_.restart(bench_.clock.now()); }
  void say(base::Fnv1a64& digest) const override {
    for (const char c : record::encoded(*sample_)) digest.u8(static_cast<std::uint8_t>(c));
  }
  void count(base::Fnv1a64& digest) const override { note_counts(bench_.driver, digest); }

 private:
  static constexpr bool kSees = std::is_same_v<typename Rig::Sample, sensor::BlobFrame>;

  void choose() {
    if constexpr (kSees) {
      if (scene_ == Scene::kMoving || chosen_ == bench_.images) return;
      chosen_ = bench_.images;
      std::size_t things = static_cast<std::size_t>(scene_);
      if (scene_ == Scene::kTurns) things = 1 + static_cast<std::size_t>(bench_.images % 3);
      if (scene_ == Scene::kCrowd) things = Rig::kMaxThings;
      if (scene_ == Scene::kNothing) things = 0;
      bench_.scene.clear();
      for (std::size_t i = 0; i < things; ++i) {
        bench_.scene.push_back(bench_.blob_of(7 + 7'531 * static_cast<std::int64_t>(i)));
        if (scene_ == Scene::kCrowd) widen(bench_.scene.back(), 2 * static_cast<int>(i));
      }
    }
  }
  // Each of a crowd is larger than the one before.
  template <class Thing>
  static void widen(Thing& thing, int columns) {
    if constexpr (requires { thing.size; }) {
      thing.size += columns;
    } else {
      thing.x2 = static_cast<decltype(thing.x2)>(thing.x1 + columns);
    }
  }

  Seen judged(const sensor::BlobFrame& frame) const {
    Seen seen;
    seen.right = scene_ == Scene::kMoving && bench_.right(frame);
    seen.old = scene_ == Scene::kMoving && !seen.right && bench_.old(frame);
    seen.blobs = frame.blobs.size();
    base::Fnv1a64 what;
    std::int64_t last = INT64_MAX;
    for (const sensor::Blob& blob : frame.blobs) {
      for (const std::int64_t value :
           {std::int64_t{blob.signature}, std::int64_t{blob.x1}, std::int64_t{blob.y1}, std::int64_t{blob.x2},
            std::int64_t{blob.y2}, std::int64_t{blob.cx.raw}, std::int64_t{blob.cy.raw}, std::int64_t{blob.pixels}}) {
        what.i64(value);
      }
      seen.possible = seen.possible && 0 <= blob.x1 && blob.x1 <= blob.x2 && blob.x2 < Rig::kWidth && 0 <= blob.y1 &&
                      blob.y1 <= blob.y2 && blob.y2 < Rig::kHeight;
      const std::int64_t size =
          blob.pixels > 0 ? blob.pixels : std::int64_t{blob.x2 - blob.x1 + 1} * (blob.y2 - blob.y1 + 1);
      seen.sorted = seen.sorted && size <= last;
      last = size;
    }
    seen.what = what.value();
    return seen;
  }
  Seen judged(const sensor::OdometrySample& sample) {
    Seen seen;
    seen.right = bench_.right(sample);
    seen.old = !seen.right && bench_.old(sample);
    seen.what = seen.right ? 1 : 0;
    return seen;
  }

  // The driver's counters, under whatever name it has.
  template <class Driver>
  static void note_counts(const Driver& driver, base::Fnv1a64& digest) {
    if constexpr (requires { driver.counts(); }) {
      note_bytes(driver.counts(), digest);
    } else if constexpr (requires { driver.counters(); }) {
      note_bytes(driver.counters(), digest);
    } else if constexpr (requires { driver.session(); }) {
      note_counts(driver.session(), digest);
    }
  }
  template <class Counts>
  static void note_bytes(const Counts& counts, base::Fnv1a64& digest) {
    static_assert(std::has_unique_object_representations_v<Counts>);
    std::array<std::uint8_t, sizeof(Counts)> bytes;
    std::memcpy(bytes.data(), &counts, sizeof counts);
    for (const std::uint8_t byte : bytes) digest.u8(byte);
  }

  Bench<Rig> bench_;
  base::Duration step_;
  Scene scene_ = Scene::kMoving;
  std::optional<std::int64_t> chosen_;  ///< the image before the one that the scene is for
  std::optional<typename Rig::Sample> sample_;
};

}  // namespace fencepost::test
