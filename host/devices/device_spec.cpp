#include "host/devices/device_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "hal/base/check.hpp"
#include "host/devices/catalogue.hpp"
#include "host/text/device_word.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::devices {
namespace {

using enum PlaceKind;
using host::DeviceOption;
using host::DeviceWord;
using host::listed;

std::string_view use_name(Use use) {
  switch (use) {
    case Use::kCamera: return "camera";
    case Use::kOdometry: return "odometry";
    case Use::kEmulated: break;
  }
  return "device";
}

std::string patterns(const std::vector<PlaceKind>& places) {
  std::vector<std::string> words;
  for (const PlaceKind place : places) words.emplace_back(place_pattern(place));
  return listed(words);
}

std::optional<double> real_number(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789.") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() ? std::optional(value) : std::nullopt;
}

/// The allowed values if `value` is none of them, else empty.
struct Refusal {
  const std::string& value;

  std::string operator()(const Words& values) const {
    const bool known = std::find(values.words.begin(), values.words.end(), value) != values.words.end();
    return known ? "" : listed(values.words);
  }
  std::string operator()(const Whole& values) const {
    const std::optional<std::uint32_t> number = host::whole_number(value);
    if (number && ((*number >= values.low && *number <= values.high) || (values.or_zero && *number == 0))) return {};
    return fmt::format("{}whole numbers from {} to {}", values.or_zero ? "0, or " : "", values.low, values.high);
  }
  std::string operator()(const Metres& values) const {
    const std::optional<double> number = real_number(value);
    if (number && *number > 0 && *number < values.below) return {};
    return fmt::format("metres, more than 0 and less than {}", values.below);
  }
  std::string operator()(const AnyText& /*values*/) const { return {}; }
};

const Option* find_option(const Row& row, Use use, const std::string& name) {
  for (const Option& option : options_of(row, use)) {
    if (*option.name == name) return &option;
  }
  return nullptr;
}

class Parser {
 public:
  Parser(std::string_view text, Use use) : text_(text) { spec_.use = use; }

  base::Result<DeviceSpec, std::string> parse() {
    DeviceWord word = host::split_device(text_);
    if (spec_.use == Use::kEmulated) std::replace(word.kind.begin(), word.kind.end(), '@', ':');
    std::string place = word.place.value_or("");
    if (!find_row(word.kind, place) || !take_place(place)) return problem_;
    for (const DeviceOption& option : word.options) {
      if (!take_option(option)) return problem_;
    }
    if (!word.problem.empty()) {
      fail("{}", word.problem);
      return problem_;
    }
    spec_.text = text_;
    return spec_;
  }

 private:
  template <class... Arguments>
  bool fail(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    problem_ = fmt::format("{} \"{}\": ", use_name(spec_.use), text_) +
               fmt::format(text, std::forward<Arguments>(arguments)...);
    return false;
  }

  // A name may have a colon; the part behind it is then no place.
  bool find_row(const std::string& kind, std::string& place) {
    const std::size_t colon = place.find(':');
    const std::string longer = kind + ":" + place.substr(0, colon);
    std::vector<std::string> known;
    bool is_longer = false;
    for (const Row* row : rows_for(spec_.use)) {
      known.push_back(*row->name);
      if (*row->name == longer) is_longer = true;
      if (*row->name == longer || (*row->name == kind && !is_longer)) spec_.row = row;
    }
    if (is_longer) place = colon == std::string::npos ? "" : place.substr(colon + 1);
    if (spec_.row != nullptr) return true;
    return fail("{}", is_of_the_other_role(kind)
                          ? fmt::format("{} is for --{}; allowed here: {}", kind, use_name(other_role()), listed(known))
                          : host::no_such(use_name(spec_.use), kind, known));
  }

  [[nodiscard]] Use other_role() const { return spec_.use == Use::kCamera ? Use::kOdometry : Use::kCamera; }

  [[nodiscard]] bool is_of_the_other_role(const std::string& kind) const {
    const std::vector<const Row*> others =
        spec_.use == Use::kEmulated ? std::vector<const Row*>() : rows_for(other_role());
    return std::any_of(others.begin(), others.end(), [&](const Row* row) { return *row->name == kind; });
  }

  bool take_place(const std::string& text) {
    return spec_.use == Use::kEmulated ? take_listening_place(text) : take_plugged_place(text);
  }

  bool take_plugged_place(const std::string& text) {
    const std::vector<PlaceKind>& places = places_of(*spec_.row, spec_.use);
    if (has(places, kNone)) return text.empty() || fail("the console has no place; write {}", spec_.kind_name());
    if (text.empty()) {
      return fail("where is it? Write {}:PLACE, a place being {}", spec_.kind_name(), patterns(places));
    }
    spec_.place = host::place_in(text, has(places, kCan));
    if (text.starts_with("tcp:") && spec_.place.kind != kTcp) {
      return fail("\"{}\" is no tcp:HOST:PORT; ports are 1 to 65535", text);
    }
    if (has(places, spec_.place.kind)) return true;
    return fail("\"{}\" is no place for it; allowed: {}", text, patterns(places));
  }

  bool take_listening_place(const std::string& text) {
    if (has(places_of(*spec_.row, spec_.use), kCan)) {
      spec_.place = {kCan, text};
      return !text.empty() || fail("{} needs an interface, such as {}:vcan0", spec_.kind_name(), spec_.kind_name());
    }
    constexpr std::string_view kListen = "tcp:";
    if (text.starts_with(kListen)) {
      spec_.place = {kTcp, text.substr(kListen.size())};
      return !spec_.place.name.empty() || fail("tcp: needs a port, such as tcp:7000 (0: any free one)");
    }
    const PlaceKind kind = host::place_in(text, false).kind;
    if (kind == kUsb || kind == kI2c || kind == kSpi || kind == kNxt || kind == kVideo) {
      return fail("no {} at {} can be emulated; only on a pty, on tcp, or on CAN", spec_.kind_name(), text);
    }
    spec_.place = {kTty, text == "pty" ? "" : text};
    return true;
  }

  bool take_option(const DeviceOption& given) {
    const Option* option = usable_option(given.name);
    if (option == nullptr) return false;
    if (given.value.empty() && std::holds_alternative<AnyText>(*option->values)) {
      return fail("{} is empty", given.name);
    }
    const std::string allowed = std::visit(Refusal{given.value}, *option->values);
    if (!allowed.empty()) return fail("{}={} is not possible; allowed: {}", given.name, given.value, allowed);
    spec_.options.emplace(given.name, given.value);
    return true;
  }

  const Option* usable_option(const std::string& name) {
    std::vector<std::string> known;
    for (const Option& option : options_of(*spec_.row, spec_.use)) {
      if (!option.places.empty() && !has(option.places, spec_.place.kind)) continue;
      if (*option.name == name) return &option;
      known.push_back(*option.name);
    }
    const bool emulated = spec_.use == Use::kEmulated;
    const std::string at = emulated ? "" : fmt::format(" at {}", place_pattern(spec_.place.kind));
    if (known.empty()) {
      fail("no options are known of {}{}; remove \"{}\"", spec_.kind_name(), at, name);
    } else {
      fail("no option \"{}\" of {}{};{} allowed: {}", name, spec_.kind_name(), at, host::did_you_mean(name, known),
           listed(known));
    }
    return nullptr;
  }

  std::string_view text_;
  DeviceSpec spec_;
  std::string problem_;
};

}  // namespace

std::string DeviceSpec::where() const {
  switch (place.kind) {
    case kNone: return kind_name();
    case kTcp: return fmt::format("{} at {}:{}", kind_name(), place.name, place.port);
    case kUsb: return fmt::format("{} on USB", kind_name());
    case kNxt: return fmt::format("{} behind the NXT brick", kind_name());
    case kTty:
    case kI2c:
    case kSpi:
    case kCan:
    case kVideo:
    case kFilm: break;
  }
  return fmt::format("{} at {}", kind_name(), place.name);
}

std::string DeviceSpec::option(const std::string& name) const {
  const auto found = options.find(name);
  if (found != options.end()) return found->second;
  const Option* known = find_option(*row, use, name);
  FENCEPOST_CHECK(known != nullptr);
  return *known->fallback;
}

std::uint32_t DeviceSpec::number(const std::string& name) const { return host::whole_number(option(name)).value_or(0); }

double DeviceSpec::real(const std::string& name) const { return real_number(option(name)).value_or(0); }

base::Result<DeviceSpec, std::string> parse_device(std::string_view text, Use use) { return Parser(text, use).parse(); }

const std::vector<Option>& options_of(const Row& row, Use use) {
  return use == Use::kEmulated ? (*row.emulated)->options : (*row.live)->options;
}

const std::vector<PlaceKind>& places_of(const Row& row, Use use) {
  return use == Use::kEmulated ? (*row.emulated)->places : (*row.live)->places;
}

}  // namespace fencepost::devices
