// Which true object each object of the map follows, frame by frame, and how often that changes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>

#include "host/evaluate/frame_truths.hpp"
#include "host/replay/run_observer.hpp"

namespace fencepost::host {

/// From this many objects on, data of objects that the map has deleted is removed. A map has fewer objects.
inline constexpr std::size_t kManyObjects = 256;

class Following {
 public:
  void clear() { *this = {}; }

  /// One frame: who owns its blobs, and which objects took them.
  void add(const BlobOwners& owners, std::span<const PlacedSighting> sightings);

  /// Forgets objects that the map has deleted, but for their swaps, when there are many.
  void forget_deleted(const std::function<bool(std::uint32_t)>& in_map);

  /// Frames in which a blob of that true object was seen.
  [[nodiscard]] std::uint64_t visible(std::size_t truth) const;
  /// How often an object took a blob of another true object than the one whose blob it took last. False blobs have no
  /// owner and are ignored.
  [[nodiscard]] std::uint64_t swaps(std::uint32_t id) const;
  /// Over all objects, also those that the map has deleted.
  [[nodiscard]] std::uint64_t swaps() const;
  /// The true object whose blobs it took most often (the first of several); empty if it took false blobs only.
  [[nodiscard]] std::optional<std::size_t> follows(std::uint32_t id) const;

 private:
  struct Track {
    std::optional<std::size_t> last;
    std::uint64_t swaps = 0;
    std::map<std::size_t, std::uint64_t> sightings;  ///< by true object
  };

  std::map<std::uint32_t, Track> tracks_;
  std::map<std::size_t, std::uint64_t> visible_;
  std::uint64_t swaps_of_deleted_ = 0;
};

}  // namespace fencepost::host
