// Observes the map after each accepted frame: which object took which blob, and any object's models at that
// moment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/record/records.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// An object and the blob of this frame that it took.
struct PlacedSighting {
  std::uint32_t id = 0;
  std::uint32_t views = 0;  ///< of the object, this one included
  std::size_t blob = 0;     ///< index into PlacedFrame::frame.blobs
};

struct PlacedFrame {
  const recon::WaitingFrame& frame;
  std::span<const PlacedSighting> sightings;
  /// The object with that id as it is now, with all models; it must be one of the sightings.
  std::function<ObjectResult(std::uint32_t id)> describe;
  /// The same with the models that alerts go by alone, cylinder and hybrid: for observers that ask often.
  std::function<ObjectResult(std::uint32_t id)> outline;
  /// Whether the map still has the object of that id, seen now or not. Ids do not come again.
  std::function<bool(std::uint32_t id)> in_map;
  /// The answer of `sectors` now; nothing of a profile that has none.
  std::function<std::optional<record::SectorReport>()> sectors;
  std::function<std::optional<record::WayReport>()> ways;  ///< likewise
};

/// Called by a replay, in order. Observing does not change the result.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// The map is empty again, ids restart.
  virtual void run_begins() = 0;
  virtual void frame_placed(const PlacedFrame& placed) = 0;
};

}  // namespace fencepost::host
