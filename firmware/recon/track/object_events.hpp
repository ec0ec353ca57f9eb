// Events of the map's objects in one frame, for readers that store something by an object's id.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/base/fixed.hpp"

namespace fencepost::recon {

/// Ids are never used again within a run, so readers need not compare slots: an id that has ended is gone for good.
enum class EventKind : std::uint8_t {
  kBorn,     ///< `id` has begun, tentative
  kMoved,    ///< its models began again elsewhere: they were of something else, or it moves. `id` goes on
  kMerged,   ///< ended: the same object as `other`, which goes on
  kDivided,  ///< ended: it was two objects, which are born anew
  kEvicted,  ///< ended: the table was full and another one needed its place
  kDeleted,  ///< ended: it should have been seen again and again and was not
};

constexpr bool ends(EventKind kind) { return kind >= EventKind::kMerged; }

struct ObjectEvent {
  EventKind kind = EventKind::kBorn;
  std::uint8_t slot = 0;    ///< of the table, where it is or was
  std::uint32_t id = 0;     ///< never 0
  std::uint32_t other = 0;  ///< kMerged: the id that goes on; else 0
};

/// The events of one frame, in order. A slot has at most three: its object ends, another one is born there, and that
/// one is merged or deleted.
template <std::size_t kObjects>
using ObjectEvents = base::FixedVector<ObjectEvent, 3 * kObjects>;

}  // namespace fencepost::recon
