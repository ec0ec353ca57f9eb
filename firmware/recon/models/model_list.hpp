// The models of one object, as a list: what a robot computes is its profile's choice, one word a model.
#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

/// The interface of a model: all that the map calls. Local frame: map axes, origin at the object's first estimated
/// place. add() takes a sighting and returns nothing; readers use the model's own type. A robot's model also has
/// kHashParts parts, of which hash() takes one a frame.
template <class M>
concept Model = requires(M model, const ModelView& view, const Sighting& first, MapPoint origin, const Vec2& shift) {
  { M::kName } -> std::convertible_to<std::string_view>;
  model.start(first, origin);  ///< a new object: forgets everything
  model.add(view);
  model.move_origin(shift);  ///< the local origin is elsewhere by `shift` (m); the object has not moved
  model.shift(shift);        ///< the object and its origin have moved in the map by `shift` (m)
};

template <class First, Model... Others>
class ModelList;

/// The cylinder comes first in every list: tracking, alerts and the place of the others depend on it. It lives in the
/// object's core, so that code without a profile can use it. The list holds the others.
template <Model... Others>
class ModelList<Cylinder, Others...> {
 public:
  template <class Visit>
  void for_each(Visit&& visit) {
    std::apply([&](Others&... models) { (visit(models), ...); }, others_);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::apply([&](const Others&... models) { (visit(models), ...); }, others_);
  }

  /// By its place in the list; the cylinder, place 0, is in the object's core.
  template <std::size_t kPlace>
  [[nodiscard]] const auto& get() const {
    return std::get<kPlace - 1>(others_);
  }
  template <class M>
  [[nodiscard]] M& get() {
    return std::get<M>(others_);
  }
  template <class M>
  [[nodiscard]] const M& get() const {
    return std::get<M>(others_);
  }

  static constexpr std::size_t kHashParts = (Others::kHashParts + ... + 0);
  /// One part of one of them; parts are numbered through.
  void hash(base::Fnv1a64& hash, std::size_t part) const {
    for_each([&](const auto& model) {
      using M = std::remove_cvref_t<decltype(model)>;
      if (part < M::kHashParts) model.hash(hash, part);
      part -= M::kHashParts;  // wraps to a number that is no part of any other
    });
  }

 private:
  [[no_unique_address]] std::tuple<Others...> others_;
};

/// Of a robot's comparison models: it has none.
using NoModels = ModelList<Cylinder>;

/// A robot fits one outline after the other; a desk may fit kCapacity of them at once, to the same bits.
struct NoBatch {
  static constexpr std::size_t kCapacity = 0;
};

}  // namespace fencepost::recon
