// The library's functions, for the sizes that micro.cpp, small.cpp and full.cpp instantiate.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <type_traits>

#include "firmware/config/profile.hpp"
#include "firmware/console/reports.hpp"
#include "firmware/console/signatures.hpp"
#include "firmware/fencepost/state.hpp"

namespace fencepost {
namespace library {

template <class Size>
struct ProfileOf;
template <>
struct ProfileOf<Micro> {
  using Type = Embedded<config::Micro>;
};
template <>
struct ProfileOf<Small> {
  using Type = Embedded<config::Small>;
};
template <>
struct ProfileOf<Full> {
  using Type = Embedded<config::Full>;
};

template <class Profile>
const recon::Object<Profile>* object_with(const loop::Memory<Profile>& memory, std::uint32_t id) {
  for (const recon::Object<Profile>& object : memory.map.slots()) {
    if (object.used() && object.id == id) return &object;
  }
  return nullptr;
}

}  // namespace library

template <class Size>
struct Core<Size>::State : library::State<typename library::ProfileOf<Size>::Type> {
  using Profile = typename library::ProfileOf<Size>::Type;

  AlertFunction told = nullptr;
  void* told_context = nullptr;

  static void hear(void* self, const record::AlertReport& report, std::string_view sentence) {
    const State& state = *static_cast<const State*>(self);
    std::array<char, console::kMaxSentence + 1> text{};
    std::copy(sentence.begin(), sentence.end(), text.begin());
    state.told(state.told_context, library::alert_of(report, text.data()));
  }
};

template <class Size>
typename Core<Size>::State& Core<Size>::state() {
  return *static_cast<State*>(static_cast<void*>(bytes_));
}
template <class Size>
const typename Core<Size>::State& Core<Size>::state() const {
  return *static_cast<const State*>(static_cast<const void*>(bytes_));
}

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): bytes_ are the State below
template <class Size>
Core<Size>::Core() {
  static_assert(sizeof(State) <= Size::kBytes && alignof(State) <= 8);
  static_assert(std::is_trivially_destructible_v<State>);
  static_assert(State::Profile::kObjects == Size::kObjects && recon::kOutlineVertices == kMaxCorners);
  std::construct_at(static_cast<State*>(static_cast<void*>(bytes_)));
}

template <class Size>
Answer Core<Size>::set_camera(const Camera& camera) {
  const auto intrinsics = library::intrinsics_of(camera);
  if (!intrinsics) return intrinsics.error();
  state().pipeline().set_camera(*intrinsics);
  return Answer::kTaken;
}

template <class Size>
Answer Core<Size>::set(const char* key, const char* value) {
  const auto error = state().pipeline().set(key, value);
  if (!error) return Answer::kTaken;
  return *error == config::SettingError::kUnknownKey ? Answer::kUnknown : Answer::kRange;
}

template <class Size>
Answer Core<Size>::set(const char* key, float value) {
  const auto text = library::setting_of(key, value);
  if (!text) return text.error();
  return state().pipeline().set(key, text->view()) ? Answer::kRange : Answer::kTaken;
}

template <class Size>
Answer Core<Size>::set_colour(const Colour& colour) {
  const auto signature = library::signature_of(colour);
  if (!signature) return signature.error();
  return state().pipeline().set_signature(*signature) ? Answer::kTaken : Answer::kNoRoom;
}

template <class Size>
Answer Core<Size>::set_name(std::uint8_t signature, const char* name) {
  const record::Signature* known = console::find_signature(signature, state().memory().signatures);
  record::Signature named = known != nullptr ? *known : record::Signature{signature, {}, {}};
  named.name = name;
  return state().pipeline().set_signature(named) ? Answer::kTaken : Answer::kNoRoom;
}

template <class Size>
void Core<Size>::on_alert(AlertFunction function, void* context) {
  State& s = state();
  s.told = function;
  s.told_context = context;
  s.hear_alerts(function != nullptr ? &State::hear : nullptr, &s);
}

template <class Size>
void Core<Size>::on_log(LogFunction function, void* context) {
  state().hear_log(function, context);
}

template <class Size>
Answer Core<Size>::odometry(std::int64_t time, const Pose& pose) {
  const base::Time t = library::time_of(time);
  const auto sample = library::sample_of(t, pose);
  if (!library::is_time(t) || !sample) return Answer::kRange;
  return state().accept(*sample);
}

template <class Size>
Answer Core<Size>::boxes(std::int64_t time, const fencepost_box* first, std::size_t count) {
  State& s = state();
  const base::Time t = library::time_of(time);
  if (!library::is_time(t) || !library::are_boxes({first, count})) return Answer::kRange;
  if (!s.memory().calibration.known) return Answer::kNoCamera;
  return s.accept(library::frame_of(t, s.next_frame(), {first, count}));
}

template <class Size>
void Core<Size>::step(std::int64_t now) {
  const base::Time t = library::time_of(now);
  if (library::is_time(t)) state().pass(t);
}

template <class Size>
Level Core<Size>::level() const {
  return static_cast<Level>(state().in_force().level);
}

template <class Size>
bool Core<Size>::may_drive(std::int64_t now) {
  return state().may_drive(library::time_of(now));
}

template <class Size>
float Core<Size>::speed_limit() const {
  const auto speed = state().speed_limit().speed;
  return speed ? speed->to_float() : -1;
}

template <class Size>
std::size_t Core<Size>::objects(Object* to, std::size_t most) const {
  const auto& memory = state().memory();
  if (memory.poses.empty()) return 0;
  const alert::RobotPlace robot(robot_pose(memory));
  std::size_t count = 0;
  for (const auto& object : memory.map.slots()) {
    if (!object.used() || !object.cylinder.estimate().ok() || count == most) continue;
    const alert::Obstacle seen = see_obstacle(object, robot, {});
    to[count] = library::object_of(console::report_object(object, seen, memory.run.time.value_or(base::Time{})));
    ++count;
  }
  return count;
}

template <class Size>
std::size_t Core<Size>::outline(std::uint32_t id, Point* to, std::size_t most) const {
  const auto* object = library::object_with(state().memory(), id);
  if (object == nullptr || !object->hybrid().ok()) return 0;
  const auto& hybrid = object->hybrid();
  std::array<recon::Vec2, recon::kOutlineVertices> corners{};
  const std::size_t count = std::min(most, recon::outline_polygon(hybrid.outline(), 0, corners));
  for (std::size_t i = 0; i < count; ++i) {
    const recon::MapPoint corner = recon::moved(hybrid.origin, corners[i]);
    to[i].x = static_cast<float>(corner.x) * recon::kMetresPerMapUnit;
    to[i].y = static_cast<float>(corner.y) * recon::kMetresPerMapUnit;
  }
  return count;
}

template <class Size>
std::size_t Core<Size>::sectors(float* to, std::size_t most) const {
  if constexpr (State::Profile::kSeesFloor) {
    static_assert(alert::kSectors == kSectors);
    const auto& memory = state().memory();
    if (memory.poses.empty()) return 0;
    const std::size_t count = std::min(most, kSectors);
    const record::SectorReport report = sectors_of(memory);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& distance = report.sectors[i].distance;
      to[i] = distance ? distance->to_float() : -1;
    }
    return count;
  } else {
    return 0;
  }
}

template <class Size>
std::size_t Core<Size>::ways(Way* to, std::size_t most, const PassingRule* rules, std::size_t count) const {
  if constexpr (State::Profile::kSeesFloor) {
    const auto& memory = state().memory();
    if (memory.poses.empty()) return 0;
    const std::span<const PassingRule> sides(rules, count);
    const record::WayReport report = ways_of(memory, [&](std::uint8_t signature) {
      const auto of_it = [&](const PassingRule& rule) { return rule.signature == signature; };
      const auto rule = std::find_if(sides.begin(), sides.end(), of_it);
      if (rule == sides.end()) return alert::PassingSide::kAny;
      return rule->on_the_right ? alert::PassingSide::kRight : alert::PassingSide::kLeft;
    });
    static_assert(record::WayReport::kMax == kWays);
    const std::size_t size = std::min(most, report.ways.size());
    for (std::size_t i = 0; i < size; ++i) to[i] = library::way_of(report.ways[i]);
    return size;
  } else {
    return 0;
  }
}

template <class Size>
bool Core<Size>::pose(Pose& pose) const {
  const auto& memory = state().memory();
  if (memory.poses.empty()) return false;
  const recon::MapPose robot = robot_pose(memory);
  pose.x = static_cast<float>(robot.position.x) * recon::kMetresPerMapUnit;
  pose.y = static_cast<float>(robot.position.y) * recon::kMetresPerMapUnit;
  pose.heading = static_cast<float>(robot.heading) * 1e-6F;  // microradians
  return true;
}

template <class Size>
std::uint64_t Core<Size>::digest() const {
  return state().memory().map.digest();
}

template <class Size>
void Core<Size>::restart() {
  state().restart();
}

}  // namespace fencepost
