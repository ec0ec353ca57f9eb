#include "host/live/device_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/text/device_word.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::host {
namespace {

using enum PlaceKind;

struct OptionInfo {
  std::string name;
  std::vector<PlaceKind> places;     ///< where it makes sense; none: everywhere
  std::vector<std::string> choices;  ///< words, or else a whole number
  std::uint32_t low = 0;
  std::uint32_t high = 0;
};

struct KindInfo {
  DeviceKind kind;
  std::string name;
  DeviceRole role;
  std::vector<PlaceKind> places;
  std::vector<OptionInfo> options;
};

OptionInfo baud() { return {"baud", {kTty}, {}, 50, 4'000'000}; }
OptionInfo address() { return {"address", {kI2c}, {}, 1, 127}; }
OptionInfo serial() { return {"serial", {kUsb}, {"*"}, 0, 0}; }
OptionInfo one_of(std::string name, std::vector<std::string> choices) {
  return {std::move(name), {}, std::move(choices), 0, 0};
}

const std::vector<KindInfo>& kinds() {
  static const std::vector<PlaceKind> line = {kTty, kTcp};
  static const std::vector<OptionInfo> pixy = {baud(), address(), serial(), {"hertz", {kSpi}, {}, 10'000, 2'000'000}};
  static const OptionInfo settle = {"settle", {}, {}, 0, 60};
  static const OptionInfo resolution = one_of("resolution", {"low", "high"});
  static const std::vector<KindInfo> table = {
      {DeviceKind::kPixy2, "pixy2", DeviceRole::kCamera, {kTty, kTcp, kI2c, kSpi, kUsb}, pixy},
      {DeviceKind::kPixy21, "pixy2.1", DeviceRole::kCamera, {kTty, kTcp, kI2c, kSpi, kUsb}, pixy},
      {DeviceKind::kCmuCam1, "cmucam1", DeviceRole::kCamera, line, {baud(), settle}},
      {DeviceKind::kCmuCam2,
       "cmucam2",
       DeviceRole::kCamera,
       line,
       {baud(), settle, resolution, one_of("imager", {"ov6620", "ov7620"})}},
      {DeviceKind::kCmuCam3, "cmucam3", DeviceRole::kCamera, line, {baud(), settle, resolution}},
      {DeviceKind::kCmuCam4, "cmucam4", DeviceRole::kCamera, line, {baud(), settle}},
      {DeviceKind::kNxtCam,
       "nxtcam",
       DeviceRole::kCamera,
       {kI2c, kNxt, kTty, kTcp},
       {baud(),
        {"address", {kI2c, kNxt}, {}, 1, 127},
        {"port", {kNxt}, {}, 1, 4},
        {"map", {kI2c, kNxt}, {"on", "off"}, 0, 0},
        {"lock", {kI2c, kNxt}, {"on", "off"}, 0, 0}}},
      {DeviceKind::kNxtCam5, "nxtcam5", DeviceRole::kCamera, line, {baud(), one_of("silence", {"lost", "empty"})}},
      {DeviceKind::kAvrCam, "avrcam", DeviceRole::kCamera, line, {baud()}},
      {DeviceKind::kXbc, "xbc", DeviceRole::kCamera, line, {baud()}},
      {DeviceKind::kConsole, "console", DeviceRole::kCamera, {kNone}, {}},
      {DeviceKind::kCreate1,
       "create1",
       DeviceRole::kOdometry,
       line,
       {baud(), one_of("mode", {"passive", "safe", "full"})}},
      {DeviceKind::kCreate2,
       "create2",
       DeviceRole::kOdometry,
       line,
       {baud(), one_of("mode", {"passive", "safe", "full"})}},
      {DeviceKind::kNxt,
       "nxt",
       DeviceRole::kOdometry,
       {kUsb, kTty, kTcp},
       {baud(), serial(), one_of("left", {"A", "B", "C"}), one_of("right", {"A", "B", "C"})}},
      {DeviceKind::kCan, "can", DeviceRole::kOdometry, {kCan}, {}},
      {DeviceKind::kRecords, "records", DeviceRole::kOdometry, line, {baud(), one_of("stamp", {"arrival", "own"})}},
      {DeviceKind::kConsole, "console", DeviceRole::kOdometry, {kNone}, {}},
  };
  return table;
}

std::string_view shape(PlaceKind place) {
  switch (place) {
    case kTty: return "/dev/tty...";
    case kTcp: return "tcp:HOST:PORT";
    case kI2c: return "/dev/i2c-N";
    case kSpi: return "/dev/spidevN.M";
    case kUsb: return "usb";
    case kNxt: return "nxt";
    case kCan: return "a CAN interface";
    case kNone: return "";
  }
  return "";
}

std::string_view role_name(DeviceRole role) { return role == DeviceRole::kCamera ? "camera" : "odometry"; }

std::string shapes(const KindInfo& info) {
  std::vector<std::string> words;
  for (const PlaceKind place : info.places) words.emplace_back(shape(place));
  return listed(words);
}

bool has(const std::vector<PlaceKind>& places, PlaceKind place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

Place place_in(std::string_view text, bool can) {
  if (const std::optional<Place> tcp = parse_tcp(text)) return *tcp;
  Place place;
  place.name = text;
  place.kind = text == "usb"                         ? kUsb
               : text == "nxt"                       ? kNxt
               : text.starts_with("/dev/i2c-")       ? kI2c
               : text.starts_with("/dev/spidev")     ? kSpi
               : text.find('/') != std::string::npos ? kTty
               : can && !text.starts_with("tcp:")    ? kCan
                                                     : kNone;
  return place;
}

class Parser {
 public:
  Parser(std::string_view text, DeviceRole role) : text_(text), role_(role) {}

  base::Result<DeviceSpec, std::string> parse() {
    const DeviceWord word = split_device(text_);
    if (!find_kind(word.kind) || !take_place(word.place.value_or(""))) return problem_;
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
    problem_ =
        fmt::format("{} \"{}\": ", role_name(role_), text_) + fmt::format(text, std::forward<Arguments>(arguments)...);
    return false;
  }

  bool find_kind(std::string_view name) {
    std::vector<std::string> known;
    for (const KindInfo& info : kinds()) {
      if (info.role != role_) continue;
      known.push_back(info.name);
      if (info.name == name) info_ = &info;
    }
    if (info_ != nullptr) {
      spec_.kind = info_->kind;
      return true;
    }
    for (const KindInfo& info : kinds()) {
      if (info.name == name) return fail("{} is for --{}; allowed here: {}", name, role_name(info.role), listed(known));
    }
    return fail("{}", no_such(role_name(role_), name, known));
  }

  bool take_place(std::string_view text) {
    if (info_->kind == DeviceKind::kConsole) {
      return text.empty() || fail("the console has no place; write {}", info_->name);
    }
    if (text.empty()) return fail("where is it? Write {}:PLACE, a place being {}", info_->name, shapes(*info_));
    spec_.place = place_in(text, info_->kind == DeviceKind::kCan);
    if (text.starts_with("tcp:") && spec_.place.kind != kTcp) {
      return fail("\"{}\" is no tcp:HOST:PORT; ports are 1 to 65535", text);
    }
    if (has(info_->places, spec_.place.kind)) return true;
    return fail("\"{}\" is no place for it; allowed: {}", text, shapes(*info_));
  }

  bool take_option(const DeviceOption& given) {
    const OptionInfo* option = find_option(given.name);
    if (option == nullptr || !allowed(*option, given.value)) return false;
    spec_.options.emplace(given.name, given.value);
    return true;
  }

  const OptionInfo* find_option(const std::string& name) {
    std::vector<std::string> known;
    for (const OptionInfo& option : info_->options) {
      if (!option.places.empty() && !has(option.places, spec_.place.kind)) continue;
      if (option.name == name) return &option;
      known.push_back(option.name);
    }
    if (known.empty()) {
      fail("no options are known of {} at {}; remove \"{}\"", info_->name, shape(spec_.place.kind), name);
    } else {
      fail("no option \"{}\" of {} at {};{} allowed: {}", name, info_->name, shape(spec_.place.kind),
           did_you_mean(name, known), listed(known));
    }
    return nullptr;
  }

  bool allowed(const OptionInfo& option, const std::string& value) {
    if (option.choices.empty()) {
      const std::optional<std::uint32_t> number = whole_number(value);
      if (number && *number >= option.low && *number <= option.high) return true;
      return fail("{}={} is not possible; allowed: whole numbers from {} to {}", option.name, value, option.low,
                  option.high);
    }
    const auto& words = option.choices;
    if (words.front() == "*") return !value.empty() || fail("{} is empty", option.name);
    if (std::find(words.begin(), words.end(), value) != words.end()) return true;
    return fail("{}={} is not possible; allowed: {}", option.name, value, listed(words));
  }

  std::string_view text_;
  DeviceRole role_;
  const KindInfo* info_ = nullptr;
  DeviceSpec spec_;
  std::string problem_;
};

}  // namespace

std::string_view DeviceSpec::kind_name() const {
  for (const KindInfo& info : kinds()) {
    if (info.kind == kind) return info.name;
  }
  return "";
}

std::string DeviceSpec::where() const {
  if (place.kind == kNone) return std::string(kind_name());
  if (place.kind == kTcp) return fmt::format("{} at {}:{}", kind_name(), place.name, place.port);
  if (place.kind == kUsb) return fmt::format("{} on USB", kind_name());
  if (place.kind == kNxt) return fmt::format("{} behind the NXT brick", kind_name());
  return fmt::format("{} at {}", kind_name(), place.name);
}

std::string DeviceSpec::option(const std::string& name, const std::string& fallback) const {
  const auto found = options.find(name);
  return found == options.end() ? fallback : found->second;
}

std::uint32_t DeviceSpec::number(const std::string& name, std::uint32_t fallback) const {
  const auto found = options.find(name);
  return found == options.end() ? fallback : whole_number(found->second).value_or(fallback);
}

std::optional<Place> parse_tcp(std::string_view text) {
  constexpr std::string_view kStart = "tcp:";
  if (!text.starts_with(kStart)) return std::nullopt;
  text.remove_prefix(kStart.size());
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  const std::optional<std::uint32_t> port = whole_number(text.substr(colon + 1));
  if (host.empty() || !port || *port == 0 || *port > 0xFFFF) return std::nullopt;
  return Place{kTcp, std::string(host), static_cast<std::uint16_t>(*port)};
}

base::Result<DeviceSpec, std::string> parse_device(std::string_view text, DeviceRole role) {
  return Parser(text, role).parse();
}

std::string describe_devices(DeviceRole role) {
  std::string text;
  for (const KindInfo& info : kinds()) {
    if (info.role != role) continue;
    std::string options;
    for (const OptionInfo& option : info.options) options += (options.empty() ? "" : " ") + option.name + "=";
    text += fmt::format("  {:<8} {}{}\n", info.name, shapes(info), options.empty() ? "" : "; " + options);
  }
  return text;
}

}  // namespace fencepost::host
