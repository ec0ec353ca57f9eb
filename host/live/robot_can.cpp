#include "host/live/robot_can.hpp"

#include <charconv>
#include <cmath>

namespace fencepost::host {
namespace {

constexpr std::int64_t kLargestId = 0x1FFF'FFFF;
constexpr std::int64_t kLargestStandardId = 0x7FF;

/// A whole number, or a text in hexadecimal such as "0x181".
std::uint32_t read_id(const JsonNode& node, bool extended) {
  const std::int64_t most = extended ? kLargestId : kLargestStandardId;
  if (!node.is_text()) return static_cast<std::uint32_t>(node.integer(0, most));
  const std::string text = node.text();
  std::int64_t id = -1;
  const char* end = text.data() + text.size();
  const bool hex = text.starts_with("0x") && text.size() > 2;
  if (!hex || std::from_chars(text.data() + 2, end, id, 16).ptr != end || id < 0 || id > most) {
    node.fail("\"" + text + "\" is no CAN identifier",
              extended ? "write \"0x0\" to \"0x1fffffff\"" : "write \"0x0\" to \"0x7ff\", or set \"extended\"");
  }
  return static_cast<std::uint32_t>(id);
}

bool read_switch(const JsonNode& node, std::string_view key, bool fallback) {
  const auto found = node.find(key);
  return found ? found->truth() : fallback;
}

can_wheels::Signal read_signal(const JsonNode& node) {
  node.expect_keys({"id", "extended", "byte", "length", "big_endian", "signed", "scale", "sign"});
  can_wheels::Signal signal;
  signal.extended = read_switch(node, "extended", false);
  signal.id = read_id(node.at("id"), signal.extended);
  signal.first_byte = static_cast<std::uint8_t>(node.at("byte").integer(0, 7));
  const auto length = node.find("length");
  signal.size = static_cast<std::uint8_t>(length ? length->integer(1, 4) : 4);
  if (signal.first_byte + signal.size > 8) {
    node.fail("byte and length reach beyond the 8 bytes of a frame", "count the bytes from 0");
  }
  signal.big_endian = read_switch(node, "big_endian", false);
  signal.is_signed = read_switch(node, "signed", true);
  return signal;
}

/// pm per count or pm/s per unit, with the sign of the mounting.
std::int64_t read_scale(const JsonNode& node, const std::optional<std::int64_t>& fallback) {
  std::int64_t scale = fallback.value_or(0);
  if (const auto given = node.find("scale")) {
    scale = static_cast<std::int64_t>(
        std::llround(given->positive(1, "m per count, or m/s per unit") * kPicometresPerMetre));
  }
  if (scale == 0) node.fail("\"scale\" is missing", "add it: metres per count, or metres per second per unit");
  const auto sign = node.find("sign");
  if (!sign) return scale;
  const std::int64_t value = sign->integer(-1, 1);
  if (value == 0) sign->fail("is 0", "write 1, or -1 where the wheel is mounted the other way round");
  return value * scale;
}

}  // namespace

can_wheels::Mapping read_can(const JsonNode& node, const WheelNumbers& wheels) {
  node.expect_keys({"quantity", "left", "right", "silence"});
  can_wheels::Mapping mapping;
  const auto quantity = node.find("quantity");
  if (quantity) {
    const std::string word = quantity->text();
    if (word != "counts" && word != "velocities") {
      quantity->fail("\"" + word + "\" is unknown", "write \"counts\" or \"velocities\"");
    }
    if (word == "velocities") mapping.quantity = can_wheels::Quantity::kVelocities;
  }
  mapping.left = read_signal(node.at("left"));
  mapping.right = read_signal(node.at("right"));
  const bool counts = mapping.quantity == can_wheels::Quantity::kCounts;
  const std::optional<std::int64_t> none;
  mapping.wheels.counter_bits = 8 * mapping.left.size;
  mapping.wheels = wheels.over(mapping.wheels);
  mapping.wheels.left_pm_per_count = read_scale(node.at("left"), counts ? wheels.left_pm_per_count : none);
  mapping.wheels.right_pm_per_count = read_scale(node.at("right"), counts ? wheels.right_pm_per_count : none);
  if (!wheels.track_pm) node.fail("the distance of the wheels is not known", "add \"wheels\": {\"track\": metres}");
  if (counts && mapping.left.size != mapping.right.size && !wheels.counter_bits) {
    node.fail("left and right have different lengths", "add \"counter_bits\" to \"wheels\"");
  }
  if (const auto silence = node.find("silence")) {
    mapping.silence = base::Duration::nearest(silence->number(0.01, 60, "s"));
  }
  return mapping;
}

}  // namespace fencepost::host
