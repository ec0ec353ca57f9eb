// Wheels: the sensor stream of a Create, and values in CAN frames.
#include "drivers/can_wheels/wheels.hpp"
#include "drivers/can_wheels/layouts.hpp"
#include "drivers/create/stream_decoder.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/drivers/states/reveal.hpp"
#include "tests/drivers/states/scanned.hpp"
#include "tests/drivers/states/walks.hpp"

namespace fencepost::test {
FENCEPOST_REVEAL(WheelsFilled, &create::StreamDecoder::filled_);
FENCEPOST_REVEAL(WheelsLength, &create::StreamDecoder::length_);
FENCEPOST_REVEAL(WheelsRule, &create::StreamDecoder::rule_);
FENCEPOST_REVEAL(WheelsAgreed, &create::StreamDecoder::agreed_);
FENCEPOST_REVEAL(WheelsLeftWheel, &can_wheels::Wheels::left_);
FENCEPOST_REVEAL(WheelsRightWheel, &can_wheels::Wheels::right_);
FENCEPOST_REVEAL(WheelsPairs, &can_wheels::Wheels::pairs_);
FENCEPOST_REVEAL(WheelsLeftReading, &odometry::WheelPairs::left_);
FENCEPOST_REVEAL(WheelsRightReading, &odometry::WheelPairs::right_);

namespace {

struct Create : Seen {
  void feed(std::uint8_t byte) {
    right = decoder.feed(byte, {});
    if (filled() > decoder.*revealed(WheelsLength{})) trouble = "more than a frame is kept";
    if (!right) return;
    ++outputs;
    right = decoder.value(0) == 1'000;
  }
  void rest() { decoder.forget_rule(); }
  [[nodiscard]] bool idle() const { return decoder.rule() == create::ChecksumRule::kUnknown; }
  void control(Key& key) const {
    key.u8(filled());
    const std::uint8_t agreed = decoder.*revealed(WheelsAgreed{});
    key.u8(agreed);
    if (agreed > 0) key.u8(static_cast<std::uint8_t>(decoder.*revealed(WheelsRule{})));
  }
  [[nodiscard]] std::uint8_t filled() const { return decoder.*revealed(WheelsFilled{}); }

  create::StreamDecoder decoder;
};

// Both rules: the decoder may have settled for either.
Walked walk_create(std::initializer_list<create::StreamField> fields) {
  create::StreamLayout layout;
  Bytes without = {0x13, 0};
  for (const create::StreamField& field : fields) {
    FENCEPOST_CHECK(layout.push_back(field));
    without.push_back(field.id);
    without = without + (field.size == 2 ? Bytes{0x03, 0xE8} : Bytes{0x08});
  }
  without[1] = static_cast<std::uint8_t>(without.size() - 2);
  without.push_back(0);
  without = sealed(without, seal_create);
  Bytes with = without;
  with.back() = static_cast<std::uint8_t>(with.back() - 0x13);
  Plan plan;
  plan.good = without + with;
  plan.way_back = 2 * plan.good.size();
  plan.shortest = without.size();
  // Once agreed on one, the other is none.
  plan.samples = {{without}, {with}, {without + without, 2}, {with + with + without, 2}, {without + without + with, 2}};
  return walk(Create{{}, create::StreamDecoder(layout)}, plan);
}

Walked walk_create1() { return walk_create({{42, 2}, {41, 2}}); }
Walked walk_create1_counting() { return walk_create({{19, 2}, {20, 2}, {42, 2}, {41, 2}}); }
Walked walk_create2() { return walk_create({{43, 2}, {44, 2}}); }

// A byte is a frame: of which wheel, how long, with which value, after how long a pause.
struct Can : Seen {
  explicit Can(const can_wheels::Mapping& of) : mapping(of), wheels(of) {}

  void feed(std::uint8_t byte) {
    constexpr std::uint8_t kLengths[] = {0, 2, 3, 4, 5, 7, 8, 9};
    constexpr std::uint8_t kValues[] = {0x00, 0x01, 0x7F, 0x80};
    bus::CanFrame frame;
    frame.extended = mapping.left.extended;
    frame.id = byte % 4 == 1 ? mapping.right.id : mapping.left.id;
    if (byte % 4 == 2) ++frame.id;
    frame.remote = byte % 4 == 3;
    frame.length = kLengths[byte / 4 % 8];
    frame.data.fill(0);
    frame.data[mapping.left.first_byte] = kValues[byte / 32 % 4];
    now = now + base::milliseconds(byte < 128 ? 10 : 600);
    const auto sample = wheels.take(frame, now);
    right = sample.has_value();
    if (!right) return;
    ++outputs;
    if (sample->t > now) trouble = "a sample of the future";
    if (sample->heading.raw > 31'416 || sample->heading.raw < -31'416) trouble = "a heading beyond half a turn";
    if (frame.remote || frame.length > 8) trouble = "a sample of a frame that has no data";
  }
  void rest() { wheels.forget(); }
  [[nodiscard]] bool idle() const { return wheels.link(now) == sensor::LinkState::kSilent; }
  void control(Key& key) const {
    key.u8((wheels.*revealed(WheelsLeftWheel{})).heard.has_value());
    key.u8((wheels.*revealed(WheelsRightWheel{})).heard.has_value());
    key.u8(static_cast<std::uint8_t>(wheels.link(now)));
    const odometry::WheelPairs& pairs = wheels.*revealed(WheelsPairs{});
    key.u8((pairs.*revealed(WheelsLeftReading{})).has_value());
    key.u8((pairs.*revealed(WheelsRightReading{})).has_value());
  }

  can_wheels::Mapping mapping;
  can_wheels::Wheels wheels;
  base::Time now{};
};

Walked walk_can(const can_wheels::Mapping& mapping, std::size_t frames) {
  // Eight bytes of zeros: left, right, left, right, left.
  const Bytes good = {24, 25, 24, 25, 24};
  Plan plan;
  plan.good = good;
  plan.way_back = frames;
  plan.samples = {{good, frames == 1 ? 5U : 2U}, {{27, 26, 0, 4, 28}, 0}};
  return walk(Can(mapping), plan);
}

can_wheels::Mapping talons() {
  can_wheels::Mapping mapping;
  mapping.left = can_wheels::talon_srx_position(3);
  mapping.right = can_wheels::talon_srx_position(4);
  mapping.wheels = odometry::make_wheel_base({100, 4'096}, 500, 24);
  return mapping;
}
Walked walk_counts() { return walk_can(talons(), 5); }
Walked walk_velocities() {
  can_wheels::Mapping mapping = talons();
  mapping.left = can_wheels::talon_srx_velocity(3);
  mapping.right = can_wheels::talon_srx_velocity(4);
  mapping.quantity = can_wheels::Quantity::kVelocities;
  return walk_can(mapping, 5);
}
Walked walk_both_in_one() {
  can_wheels::Mapping mapping;
  mapping.left = {0x100, false, 0, 2, false, true};
  mapping.right = {0x100, false, 2, 2, false, true};
  mapping.wheels = {1'000'000'000, 1'000'000'000, 200'000'000'000, 16};
  return walk_can(mapping, 1);
}

const RegisteredWalk kWheels[] = {
    {"create", "Create 1", walk_create1},          {"create", "Create 1, read requested", walk_create1_counting},
    {"create", "Create 2", walk_create2},          {"can_wheels", "counts", walk_counts},
    {"can_wheels", "velocities", walk_velocities}, {"can_wheels", "both in one frame", walk_both_in_one}};

}  // namespace
}  // namespace fencepost::test
