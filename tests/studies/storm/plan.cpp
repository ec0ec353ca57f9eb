#include "tests/studies/storm/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/devices/catalogue.hpp"
#include "host/devices/open_devices.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

using devices::Row;
using devices::Use;

/// Those of the catalogue that both have a driver and can be emulated, on a serial line or on CAN.
std::vector<const Row*> candidates(Use use) {
  std::vector<const Row*> rows;
  for (const Row* row : devices::rows_for(use)) {
    if (!row->emulated->has_value() || !row->live->has_value()) continue;
    const auto& places = (*row->live)->places;
    const auto is = [&](host::PlaceKind kind) { return std::find(places.begin(), places.end(), kind) != places.end(); };
    if (is(host::PlaceKind::kTty) || is(host::PlaceKind::kCan)) rows.push_back(row);
  }
  return rows;
}

/// A link of the camera, of those that have a model.
host::PlaceKind random_link(Chance& chance, const Row& camera) {
  using enum host::PlaceKind;
  std::vector<host::PlaceKind> buses;
  for (const host::PlaceKind kind : (*camera.live)->places) {
    if (kind == kI2c || kind == kSpi || kind == kUsb) buses.push_back(kind);
  }
  return buses.empty() || chance.one_in(4) ? kTty : chance.of(buses);
}

/// As delivered, or faster.
std::uint32_t random_baud(Chance& chance, const Row& camera) {
  constexpr std::uint32_t kFast = 115'200;
  const std::vector<devices::Option>& options = devices::options_of(camera, Use::kCamera);
  const auto baud = std::find_if(options.begin(), options.end(), [](const auto& one) { return *one.name == "baud"; });
  if (baud == options.end() || !chance.one_in(3)) return 0;
  return std::stoul(*baud->fallback) < kFast ? kFast : 0;
}

Wires random_wires(Chance& chance) {
  constexpr std::uint32_t kHertz[] = {100'000, 400'000};
  return {chance.of(kHertz), chance.one_in(2)};
}

std::string_view name_of(host::PlaceKind link) {
  switch (link) {
    case host::PlaceKind::kI2c: return "I2C";
    case host::PlaceKind::kSpi: return "SPI";
    case host::PlaceKind::kUsb: return "USB";
    default: return "a serial line";
  }
}

sensor::Text random_name(Chance& chance) {
  constexpr std::string_view kCharacters[] = {"a", "\xc3\xa4", ",", "*", "$", " "};
  const std::string_view character = chance.of(kCharacters);
  std::string name;
  const auto size = chance.one_in(2) ? sensor::kMaxText : static_cast<std::size_t>(chance.whole(0, 8));
  while (name.size() + character.size() <= size) name += character;
  return sensor::Text(std::string_view(name));
}

/// Colours that the windows of a CMUcam, 40 to either side, tell from each other.
constexpr sensor::Rgb kColours[] = {{208, 32, 32},  {32, 208, 32},  {32, 32, 208},   {208, 208, 32},
                                    {32, 208, 208}, {208, 32, 208}, {120, 120, 120}, {208, 120, 32}};

std::vector<record::Signature> random_signatures(Chance& chance, const emulate::ImageLimits& limits,
                                                 std::string_view profile) {
  const std::int64_t most = profile == "micro" ? 4 : 8;
  const std::int64_t has = limits.last_signature - limits.first_signature + 1;
  const std::int64_t count = chance.whole(1, std::min(most, has));
  std::vector<record::Signature> signatures;
  for (std::int64_t i = 0; i < count; ++i) {
    record::Signature signature;
    signature.signature = static_cast<std::uint8_t>(limits.first_signature + i);
    signature.rgb = kColours[static_cast<std::size_t>(i)];
    signature.name = random_name(chance);
    if (chance.one_in(4)) signature.width = static_cast<std::uint16_t>(chance.whole(50, 250));
    signatures.push_back(signature);
  }
  return signatures;
}

sensor::CameraMount random_mount(Chance& chance) {
  sensor::CameraMount mount;
  mount.x = base::Metres::nearest(chance.real(0, 0.1));
  mount.y = base::Metres::nearest(chance.one_in(3) ? chance.real(-0.04, 0.04) : 0);
  mount.z = base::Metres::nearest(chance.real(0.08, 0.25));
  mount.yaw = base::Radians::nearest(chance.one_in(4) ? chance.real(-0.3, 0.3) : 0);
  if (!chance.one_in(5)) mount.pitch = base::Radians::nearest(chance.one_in(2) ? 0 : chance.real(0, 0.3));
  return mount;
}

/// The camera mounted a little elsewhere, and another name.
std::vector<std::string> configured_anew(const Kept& configured) {
  sensor::CameraIntrinsics camera = configured.camera;
  camera.mount.x = base::Metres::nearest(camera.mount.x.to_double() + 0.003);
  record::Signature signature = configured.signatures.front();
  signature.name = "named new";
  return {line_of(camera), line_of(signature)};
}

/// Near where 32 bits of milliseconds, microseconds or ticks, and their signs, are full; or at zero.
base::Time random_clock(Chance& chance) {
  constexpr std::int64_t kWraps[] = {0,
                                     0,
                                     0,
                                     (1LL << 31),
                                     (1LL << 32),
                                     (1LL << 32) / 100,
                                     (1LL << 31) / 100,
                                     (1LL << 16) * 10,
                                     (1LL << 32) + (1LL << 31)};
  const std::int64_t wrap = chance.of(kWraps);
  return {std::max<std::int64_t>(0, wrap - chance.whole(0, 3'000'000))};
}

}  // namespace

Plan plan_of(std::uint64_t seed, double minutes) {
  Chance chance(seed);
  Plan plan;
  plan.seed = seed;
  plan.milliseconds = static_cast<std::int64_t>(minutes * 60'000);
  plan.variant = static_cast<std::size_t>(chance.whole(0, std::size(kVariants) - 1));
  const Row& camera = *chance.of(candidates(Use::kCamera));
  const Row& wheels = *chance.of(candidates(Use::kOdometry));
  plan.camera = *camera.name;
  plan.link = random_link(chance, camera);
  plan.wires = random_wires(chance);
  if (plan.link == host::PlaceKind::kTty) plan.baud = random_baud(chance, camera);
  plan.wheels = *wheels.name;
  constexpr console::Mode kModes[] = {console::Mode::kText, console::Mode::kLog, console::Mode::kPlot,
                                      console::Mode::kQuiet};
  if (!plan.console_is_log()) plan.mode = chance.of(kModes);
  const emulate::ImageLimits& limits = *(*camera.emulated)->image;
  plan.configured.camera = *devices::nominal_camera(camera);
  plan.configured.camera.mount = random_mount(chance);
  plan.configured.signatures = random_signatures(chance, limits, kVariants[plan.variant].profile);
  plan.clock = random_clock(chance);
  constexpr std::int64_t kTurns[] = {1, 2, 5, 10};
  plan.turn_ms = chance.of(kTurns);
  constexpr double kSpeeds[] = {11.5, 11.5, 100, 1'000, 0.96};
  plan.console_speed = chance.of(kSpeeds);
  constexpr double kRates[] = {4, 8, 10, 12, 15, 20, 25};
  const double rate = std::min(chance.of(kRates), limits.max_rate);
  for (std::int64_t i = chance.whole(1, 3); i > 0; --i) {
    plan.laps.push_back(random_lap(chance, {plan.configured.camera, rate, plan.configured.signatures}));
  }
  plan.events = random_events(chance, {plan.milliseconds, plan.console_is_log(), plan.disk(), plan.console_is_log(),
                                       configured_anew(plan.configured)});
  return plan;
}

std::string describe(const Plan& plan) {
  const Variant& variant = kVariants[plan.variant];
  return fmt::format(
      "{} (output {}, journal {}), {} on {}, {}, {} images/s, {} laps, console {} bytes/ms, turns to {} ms, {} "
      "events",
      variant.profile, variant.output, variant.journal, plan.camera, name_of(plan.link), plan.wheels, plan.laps[0].rate,
      plan.laps.size(), plan.console_speed, plan.turn_ms, plan.events.size());
}

}  // namespace fencepost::test
