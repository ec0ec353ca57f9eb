// Schedules the outline fits: objects with new tangents take turns, and a frame has time for a fixed number of steps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::recon {

/// One solver for all objects of a map. It takes Profile::kHybridSteps steps in a frame that is due, in warm fits. With
/// 0 steps, outlines are fitted at once and from nothing. A well-known outline then waits until its new tangents weigh
/// as much as a whole view.
template <class Profile>
class OutlineFitter {
 public:
  void clear() {
    solver_.abandon();
    slot_ = 0;
  }

  /// After the frame's objects have begun and their models have taken it. `due`: it is a frame for models.
  template <class Table>
  [[gnu::noinline]] void fit(Table& table, bool due) {
    auto& objects = table.objects();
    if constexpr (Profile::kHybridSteps == 0) {
      fit_all(objects, kWholeView);
    } else {
      // The object in that slot is not the one that the fit was begun with, or its models began again.
      for (const auto& event : table.events()) {
        if (event.slot == slot_) solver_.abandon();
      }
      if (!objects[slot_].used()) solver_.abandon();
      if (!due) return;
      for (int i = 0; i < Profile::kHybridSteps; ++i) {
        if (!go_on(objects)) return;
      }
    }
  }

  /// The stream has ended: fits the outlines that wait for more tangents, unless steps are counted.
  template <class Table>
  void finish(Table& table) {
    if constexpr (Profile::kHybridSteps == 0) fit_all(table.objects(), 1);
  }

 private:
  using Batch = typename Profile::OutlineBatch;

  template <class Objects>
  void fit_all(Objects& all, int min_weight) {
    const std::span objects = std::span(all).first(base::slots_in_use(all));
    for (auto& object : objects) {
      if (!is_due(object, min_weight)) continue;
      if constexpr (Batch::kCapacity > 0) {
        if (Batch::takes(object.hybrid())) continue;
      }
      solver_.solve(object.hybrid(), object.cylinder.known_radius());
      object.note_outline();
    }
    if constexpr (Batch::kCapacity > 0) fit_together(objects, min_weight);
  }

  // A part of a view changes little in a well-known outline.
  template <class Object>
  static bool is_due(const Object& object, int min_weight) {
    if (!object.used() || object.hybrid().new_weight == 0) return false;
    return !object.hybrid().known_well || object.hybrid().new_weight >= min_weight;
  }

  // Fits the remaining outlines with new tangents, a few at a time.
  template <class Object>
  static void fit_together(std::span<Object> objects, int min_weight) {
    const auto due = [min_weight](const Object& object) { return is_due(object, min_weight); };
    if (std::none_of(objects.begin(), objects.end(), due)) return;  // in most frames
    Batch batch;
    base::FixedVector<Object*, Batch::kCapacity> taken;
    const auto solve = [&] {
      batch.solve();
      for (auto* object : taken) object->note_outline();
      taken.clear();
    };
    for (auto& object : objects) {
      if (!due(object)) continue;
      batch.add(object.hybrid(), object.cylinder.known_radius());
      static_cast<void>(taken.push_back(&object));
      if (taken.full()) solve();
    }
    solve();
  }

  // False: no object has new tangents.
  template <class Objects>
  bool go_on(Objects& objects) {
    if (solver_.done() && !begin_next(objects)) return false;
    if (solver_.step(objects[slot_].hybrid())) objects[slot_].note_outline();
    return true;
  }

  template <class Objects>
  bool begin_next(Objects& objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      slot_ = static_cast<std::uint8_t>(slot_ + 1U < objects.size() ? slot_ + 1U : 0U);
      if (!objects[slot_].used() || objects[slot_].hybrid().new_weight == 0) continue;
      solver_.begin_warm(objects[slot_].hybrid(), objects[slot_].cylinder.known_radius());
      return true;
    }
    return false;
  }

  HybridSolver<Profile::kHybridSectors, Profile::kHybridOrder> solver_;
  std::uint8_t slot_ = 0;
};

}  // namespace fencepost::recon
