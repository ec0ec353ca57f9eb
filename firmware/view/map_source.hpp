// The interface of the robot's loop for the view, which knows nothing else of it.
#pragma once

#include <concepts>
#include <optional>
#include <span>

#include "firmware/console/console_state.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::view {

/// `objects()` are the slots of the map's table; `robot()` is unknown before the first odometry; `alert_level(slot)` is
/// the level in force of the object there.
template <class T>
concept MapSource = requires(T source, const T& same, std::size_t slot, console::Mode mode) {
  { T::kObjects } -> std::convertible_to<std::size_t>;
  { same.objects().size() } -> std::same_as<std::size_t>;
  { same.robot() } -> std::same_as<std::optional<recon::MapPose>>;
  { same.signatures() } -> std::same_as<std::span<const record::Signature>>;
  { same.alert_level(slot) } -> std::same_as<record::AlertLevel>;
  { same.mode() } -> std::same_as<console::Mode>;
  { same.testing() } -> std::same_as<bool>;
  source.set_mode(mode);
  source.restart();
};

}  // namespace fencepost::view
