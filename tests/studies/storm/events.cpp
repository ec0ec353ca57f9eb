#include "tests/studies/storm/events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

constexpr std::string_view kKinds[] = {"type",   "noise",    "hostile bytes", "stall",     "unplug", "reboot",
                                       "freeze", "throttle", "slow disk",     "full disk", "busy",   "power cut"};
constexpr std::string_view kCables[] = {"camera", "wheels", "console"};

constexpr std::string_view kCommands[] = {"help",
                                          "status",
                                          "objects",
                                          "map",
                                          "settings",
                                          "get",
                                          "version",
                                          "next",
                                          "sectors",
                                          "calibrate",
                                          "watch",
                                          "stop",
                                          "go",
                                          "alerts off",
                                          "alerts on",
                                          "reset",
                                          "selftest",
                                          "mode log",
                                          "no such command",
                                          "set alert.stop x",
                                          "set alert.warn 99999",
                                          "get alert.stop",
                                          "\t set  confirm.k = 3 ",
                                          "$FPODO,1,2,3*0000",
                                          "$FPSIG,1,d02020,x",
                                          "error: echoed",
                                          ""};
constexpr std::string_view kModes[] = {"mode text", "mode plot", "mode quiet", "mode log"};
constexpr std::string_view kSettings[] = {
    "alert.stop 0.30",  "alert.stop 0.20",   "alert.warn 0.60",   "alert.notice 1.2", "alert.ttc_stop 0.6",
    "robot.width 0.25", "robot.margin 0.03", "confirm.k 2",       "confirm.n 6",      "alert.rate 9",
    "camera.noise 1.5", "correct.drift 2",   "correct.pose off",  "correct.pose on",  "correct.pose auto",
    "robot.front 0.12", "robot.rear 0.11",   "alert.ttc_warn 3.0"};

std::string setting(Chance& chance) { return "set " + std::string(chance.of(kSettings)) + "\r"; }

std::string garbage(Chance& chance, std::int64_t most) {
  std::string text;
  for (std::int64_t left = chance.whole(1, most); left > 0; --left) {
    text += static_cast<char>(chance.whole(0, 255));
  }
  return text;
}

std::string typed(Chance& chance, bool any_mode) {
  switch (chance.whole(0, 9)) {
    case 0: return garbage(chance, chance.one_in(4) ? 2'500 : 40);
    case 1: return std::string(static_cast<std::size_t>(chance.whole(1, 1'500)), 'x') + "\r";
    case 2: return record::sealed("FPSIG,1,d02020,another name") + "\r\n";
    case 3:
    case 4: return setting(chance);
    case 5: return setting(chance) + setting(chance);
    case 6:
      if (any_mode) return std::string(chance.of(kModes)) + "\r";
      [[fallthrough]];
    default: return std::string(chance.of(kCommands)) + (chance.one_in(2) ? "\r" : "\r\n");
  }
}

class Maker {
 public:
  Maker(Chance& chance, const EventChoice& choice) : chance_(chance), choice_(choice) {}

  Event any() {
    Event event;
    event.kind = kind();
    event.at = chance_.whole(2'000, choice_.milliseconds - 1);
    event.seed = static_cast<std::uint64_t>(chance_.whole(1, 1'000'000'000));
    event.cable = chance_.one_in(2) ? Cable::kCamera : Cable::kWheels;
    fill(event);
    return event;
  }

 private:
  EventKind kind() {
    for (;;) {
      const auto kind = static_cast<EventKind>(chance_.whole(0, std::size(kKinds) - 1));
      if (kind == EventKind::kSlowDisk && !choice_.disk) continue;
      if (kind == EventKind::kFullDisk && (!choice_.disk || !chance_.one_in(10))) continue;
      if (kind == EventKind::kPowerCut && !choice_.flash) continue;
      return kind;
    }
  }

  void fill(Event& event) {
    switch (event.kind) {
      case EventKind::kType: event.text = typed(chance_, !choice_.console_is_log); break;
      case EventKind::kNoise:
        event.length = chance_.whole(500, 20'000);
        event.amount = chance_.one_in(2) ? 0.01 : 0.001;
        break;
      case EventKind::kHostile: event.amount = static_cast<double>(chance_.whole(1, 400)); break;
      case EventKind::kStall: event.length = chance_.whole(20, 4'000); break;
      case EventKind::kUnplug:
        if (!choice_.console_is_log && chance_.one_in(3)) event.cable = Cable::kConsole;
        event.length = chance_.whole(50, 15'000);
        break;
      case EventKind::kReboot: event.length = chance_.whole(1, 3'000); break;
      case EventKind::kFreeze:
        event.cable = Cable::kCamera;
        event.length = chance_.whole(200, 5'000);
        break;
      case EventKind::kThrottle:
        event.cable = Cable::kConsole;
        event.length = chance_.whole(100, 12'000);
        event.amount = static_cast<double>(chance_.whole(0, 4));
        break;
      case EventKind::kSlowDisk: event.length = chance_.whole(100, 30'000); break;
      case EventKind::kFullDisk: break;
      case EventKind::kBusy: event.length = chance_.whole(20, chance_.one_in(4) ? 3'000 : 200); break;
      case EventKind::kPowerCut:
        event.length = chance_.whole(10, 2'000);
        if (chance_.one_in(5)) break;  // nothing is being written
        for (std::int64_t n = chance_.whole(1, 4); n > 0; --n) event.text += setting(chance_);
        for (const std::string& line : choice_.configured) {
          if (chance_.one_in(4)) event.text += line;
        }
        // A line is kept as some more characters than were typed, of which a word is four.
        event.amount = static_cast<double>(chance_.whole(0, 8 + static_cast<std::int64_t>(event.text.size()) / 2));
        break;
    }
  }

  Chance& chance_;
  const EventChoice& choice_;
};

}  // namespace

std::string describe(const Event& event) {
  std::string line =
      fmt::format("{:8.3f} s {}", static_cast<double>(event.at) / 1'000, kKinds[static_cast<std::size_t>(event.kind)]);
  const bool of_cable = event.kind != EventKind::kType && event.kind < EventKind::kThrottle;
  if (of_cable) line += fmt::format(" of {}", kCables[static_cast<std::size_t>(event.cable)]);
  if (event.length > 0) line += fmt::format(" for {} ms", event.length);
  if (event.amount > 0) line += fmt::format(", {}", event.amount);
  if (event.text.empty()) return line;
  line += " \"";
  for (const char c : std::string_view(event.text).substr(0, 60)) {
    line += c >= ' ' && c <= '~' ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return line + "\"";
}

std::vector<Event> random_events(Chance& chance, const EventChoice& choice) {
  Maker maker(chance, choice);
  // Some robots have a quiet life, some one fault a second.
  const double minutes = static_cast<double>(choice.milliseconds) / 60'000;
  constexpr double kPerMinute[] = {0, 2, 6, 6, 20, 60};
  const auto count = static_cast<std::int64_t>(minutes * chance.of(kPerMinute));
  std::vector<Event> events;
  for (std::int64_t i = 0; i < count; ++i) events.push_back(maker.any());
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
  return events;
}

std::vector<Event> unnoticed_reboots(std::uint64_t seed, std::int64_t milliseconds) {
  Chance chance(seed);
  std::vector<Event> events;
  for (std::int64_t at = 10'000; at + 45'000 < milliseconds; at += 60'000) {
    const std::int64_t begins = at + chance.whole(0, 10'000);
    const std::int64_t kept_away = chance.whole(300, 3'000);
    events.push_back({.kind = EventKind::kBusy, .at = begins, .length = kept_away});
    for (const Cable cable : {Cable::kCamera, Cable::kWheels}) {
      const std::int64_t length = chance.whole(1, kept_away / 2);
      events.push_back({.kind = EventKind::kReboot, .cable = cable, .at = begins + 5, .length = length});
    }
  }
  return events;
}

}  // namespace fencepost::test
