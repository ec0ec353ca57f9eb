// The C interface: what of it needs a core.
#include <cstdint>

#include "firmware/fencepost/handle.hpp"

namespace {

fencepost_answer c_answer(fencepost::Answer answer) { return static_cast<fencepost_answer>(answer); }

void hear(void* context, const fencepost::Alert& alert) {
  const auto& core = *static_cast<const fencepost_core*>(context);
  core.hear(core.hear_context, &alert);
}

}  // namespace

std::size_t fencepost_bytes(const fencepost_capacity* capacity) { return capacity == nullptr ? 0 : capacity->bytes; }
std::size_t fencepost_alignment() { return alignof(fencepost::MicroCore); }
std::size_t fencepost_capacity_objects(const fencepost_capacity* capacity) {
  return capacity == nullptr ? 0 : capacity->objects;
}

fencepost_core* fencepost_init(void* memory, std::size_t bytes, const fencepost_capacity* capacity) {
  if (memory == nullptr || capacity == nullptr || bytes < capacity->bytes) return nullptr;
  void* aligned = memory;
  std::size_t space = bytes;
  if (std::align(fencepost_alignment(), capacity->bytes, aligned, space) != memory) return nullptr;
  return capacity->make(memory);
}

fencepost_answer fencepost_set_camera(fencepost_core* core, const fencepost_camera* camera) {
  if (core == nullptr || camera == nullptr) return FENCEPOST_NULL;
  return c_answer(core->set_camera(*camera));
}

fencepost_answer fencepost_set(fencepost_core* core, const char* key, const char* value) {
  if (core == nullptr || key == nullptr || value == nullptr) return FENCEPOST_NULL;
  return c_answer(core->set(key, value));
}

fencepost_answer fencepost_set_number(fencepost_core* core, const char* key, float value) {
  if (core == nullptr || key == nullptr) return FENCEPOST_NULL;
  return c_answer(core->set(key, value));
}

fencepost_answer fencepost_set_colour(fencepost_core* core, const fencepost_colour* colour) {
  if (core == nullptr || colour == nullptr) return FENCEPOST_NULL;
  return c_answer(core->set_colour(*colour));
}

fencepost_answer fencepost_set_name(fencepost_core* core, std::uint8_t signature, const char* name) {
  if (core == nullptr || name == nullptr) return FENCEPOST_NULL;
  return c_answer(core->set_name(signature, name));
}

fencepost_answer fencepost_on_alert(fencepost_core* core, fencepost_alert_function function, void* context) {
  if (core == nullptr) return FENCEPOST_NULL;
  core->hear = function;
  core->hear_context = context;
  core->on_alert(function == nullptr ? nullptr : hear, core);
  return FENCEPOST_TAKEN;
}

fencepost_answer fencepost_on_log(fencepost_core* core, fencepost_log_function function, void* context) {
  if (core == nullptr) return FENCEPOST_NULL;
  core->on_log(function, context);
  return FENCEPOST_TAKEN;
}

fencepost_answer fencepost_odometry(fencepost_core* core, std::int64_t time, fencepost_pose pose) {
  return core == nullptr ? FENCEPOST_NULL : c_answer(core->odometry(time, pose));
}

fencepost_answer fencepost_boxes(fencepost_core* core, std::int64_t time, const fencepost_box* first,
                                 std::size_t count) {
  if (core == nullptr || (first == nullptr && count > 0)) return FENCEPOST_NULL;
  return c_answer(core->boxes(time, first, count));
}

fencepost_answer fencepost_step(fencepost_core* core, std::int64_t now) {
  if (core == nullptr) return FENCEPOST_NULL;
  if (!fencepost::library::is_time(fencepost::library::time_of(now))) return FENCEPOST_RANGE;
  core->step(now);
  return FENCEPOST_TAKEN;
}

fencepost_answer fencepost_restart(fencepost_core* core) {
  if (core == nullptr) return FENCEPOST_NULL;
  core->restart();
  return FENCEPOST_TAKEN;
}

fencepost_level fencepost_level_in_force(const fencepost_core* core) {
  return core == nullptr ? FENCEPOST_BLIND : static_cast<fencepost_level>(core->level());
}

bool fencepost_may_drive(fencepost_core* core, std::int64_t now) { return core != nullptr && core->may_drive(now); }

float fencepost_speed_limit(const fencepost_core* core) { return core == nullptr ? -1.0F : core->speed_limit(); }

std::size_t fencepost_objects(const fencepost_core* core, fencepost_object* to, std::size_t most) {
  return core == nullptr || to == nullptr ? 0 : core->objects(to, most);
}

std::size_t fencepost_outline(const fencepost_core* core, std::uint32_t id, fencepost_point* to, std::size_t most) {
  return core == nullptr || to == nullptr ? 0 : core->outline(id, to, most);
}

std::size_t fencepost_sectors(const fencepost_core* core, float* to, std::size_t most) {
  return core == nullptr || to == nullptr ? 0 : core->sectors(to, most);
}

std::size_t fencepost_ways(const fencepost_core* core, fencepost_way* to, std::size_t most,
                           const fencepost_passing_rule* rules, std::size_t count) {
  if (core == nullptr || to == nullptr || (rules == nullptr && count > 0)) return 0;
  return core->ways(to, most, rules, count);
}

bool fencepost_where(const fencepost_core* core, fencepost_pose* to) {
  return core != nullptr && to != nullptr && core->pose(*to);
}

std::uint64_t fencepost_digest(const fencepost_core* core) { return core == nullptr ? 0 : core->digest(); }
