// Whose outline is fitted when: objects with news take turns, and a frame has time for so many steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/models/hybrid/outline_batch.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::recon {

/// One solver for all objects of a map. Profile::kHybridSteps steps a frame that is due; 0: every object with news is
/// fitted at once.
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
      fit_all(objects);
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

 private:
  template <class Objects>
  void fit_all(Objects& objects) {
    for (auto& object : objects) {
      if (!object.used() || !object.hybrid().news) continue;
      if (base::kLaneVectors && OutlineBatch::takes(object.hybrid())) continue;
      solver_.solve(object.hybrid(), object.cylinder.known_radius());
      object.note_outline();
    }
    if constexpr (base::kLaneVectors) fit_together(objects);
  }

  // Those with news that are left, a few at a time.
  template <class Objects>
  static void fit_together(Objects& objects) {
    OutlineBatch batch;
    base::FixedVector<typename Objects::value_type*, kLanes> taken;
    const auto solve = [&] {
      batch.solve();
      for (auto* object : taken) object->note_outline();
      taken.clear();
    };
    for (auto& object : objects) {
      if (!object.used() || !object.hybrid().news) continue;
      batch.add(object.hybrid(), object.cylinder.known_radius());
      static_cast<void>(taken.push_back(&object));
      if (taken.full()) solve();
    }
    solve();
  }

  // False: nobody has news.
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
      if (!objects[slot_].used() || !objects[slot_].hybrid().news) continue;
      solver_.begin(objects[slot_].hybrid(), objects[slot_].cylinder.known_radius());
      return true;
    }
    return false;
  }

  HybridSolver<Profile::kHybridSectors, Profile::kHybridOrder> solver_;
  std::uint8_t slot_ = 0;
};

}  // namespace fencepost::recon
