// Typed commands: the table of commands, the words of a line, and the word that was probably meant.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/config/devices.hpp"
#include "firmware/config/settings.hpp"
#include "firmware/console/console_state.hpp"

namespace fencepost::console {

enum class Verb : std::uint8_t {
  kHelp,
  kSettings,
  kStatus,
  kObjects,
  kMap,
  kWatch,
  kNext,
  kSectors,
  kWays,
  kCalibrate,
  kAlerts,
  kMode,
  kSet,
  kGet,
  kSelftest,
  kReset,
  kGo,
  kStop,
  kLock,
  kVersion,
  kQuit,
};
inline constexpr std::size_t kVerbs = 21;

struct VerbInfo {
  std::string_view name;
  std::string_view arguments;  ///< as `help` shows them
  std::uint8_t least;          ///< how many there are
  std::uint8_t most;
  std::string_view help;
};

/// By Verb.
inline constexpr std::array<VerbInfo, kVerbs> kVerbInfo = {{
    {"help", "", 0, 0, "this list of commands; `?` as well"},
    {"settings", "", 0, 0, "all of them: value, range, what it is"},
    {"status", "", 0, 0, "what came in, what was refused, links, robot, digest"},
    {"objects", "", 0, 0, "the objects, the letters are those of the map"},
    {"map", "", 0, 0, "the map from above"},
    {"watch", "", 0, 0, "the map every two seconds, until Enter"},
    {"next", "[ID]", 0, 1, "from where an object would be learnt most"},
    {"sectors", "", 0, 0, "distances all around as a record, $FPSEC"},
    {"ways", "", 0, 0, "how far and how fast the robot may go, $FPWAY"},
    {"calibrate", "", 0, 0, "what a calibration drive still needs"},
    {"alerts", "on|off", 1, 1, "say alerts (modes text and log)"},
    {"mode", "text|log|plot|quiet", 1, 1, "sentences, records, numbers to plot, only answers"},
    {"set", "KEY VALUE", 2, 3, "change a setting"},
    {"get", "[KEY]", 0, 1, "one setting, or all"},
    {"selftest", "", 0, 0, "a known stream through the loop: forgets the map"},
    {"reset", "", 0, 0, "forget the map, start a new run"},
    {"go", "", 0, 0, "after `stop`; where `bumper` is not 0: straight ahead"},
    {"stop", "", 0, 0, "hold the robot until `go`; Enter alone ends `go`, too"},
    {"lock", "", 0, 0, "no command changes anything until a button resets it"},
    {"version", "", 0, 0, "program, target, profile"},
    {"quit", "", 0, 0, "how to leave"},
}};

constexpr const VerbInfo& info(Verb verb) { return kVerbInfo[static_cast<std::size_t>(verb)]; }

/// True if the command has to wait for the next reset while the console is locked. `word`: the one after the verb.
/// Commands that only look are allowed, and those that make the robot report more or stop.
bool waits_for_reset(Verb verb, std::string_view word);

/// The words of a line; spaces, tabs and '=' are between them, so that what `get` says can be typed after `set`.
struct Words {
  static constexpr std::size_t kMax = 5;  ///< one more than any command has
  std::array<std::string_view, kMax> words;
  std::size_t count = 0;
};
Words split(std::string_view line);

/// Without leading bytes that are not printable: inserting a plug sends such.
std::string_view without_noise(std::string_view line);

/// The line as edited: backspaces applied, escape sequences of cursor keys removed, in lower case. Changes the line in
/// place. Nothing if it holds bytes that are not text. Bytes before the first printable character are line noise.
std::optional<std::string_view> typed(std::span<char> line);

std::optional<Mode> mode_named(std::string_view word);

/// Checks that this is a command, with as many words as it needs, of the right kind. Answers with the error, or with
/// nothing (not pending) and the verb as subject. A setting and its value are not checked here.
Answer check(const Words& words);

/// `reply` about the setting of that name, or `of_device` where that chooses a device and those are `offered`; or that
/// there is none.
Answer about_key(Reply reply, Reply of_device, bool offered, std::string_view key);
/// The names of all settings, those of devices behind the others.
std::string_view name_of_key(std::size_t index);

/// The name nearest to `word` among those that are offered. A near name begins with `word`, contains it or differs by
/// at most two letters.
class NearestName {
 public:
  explicit NearestName(std::string_view word) : word_(word) {}
  void offer(std::size_t index, std::string_view name);
  [[nodiscard]] std::optional<std::size_t> index() const { return best_; }

 private:
  std::string_view word_;
  std::optional<std::size_t> best_;
  std::size_t least_ = 3;  ///< letters of difference; only less than this is near
};

}  // namespace fencepost::console
