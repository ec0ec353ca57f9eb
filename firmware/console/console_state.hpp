// The console's state between two turns.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/console/drive_guide.hpp"
#include "firmware/console/input_lines.hpp"
#include "firmware/console/quote.hpp"
#include "firmware/console/top_view.hpp"
#include "hal/base/stamp.hpp"

namespace fencepost::console {

/// The mode of the console's own output. In `log` an input is used only if its record could be queued.
enum class Mode : std::uint8_t { kText, kLog, kPlot, kQuiet };
inline constexpr std::size_t kModes = 4;

constexpr std::string_view name(Mode mode) {
  constexpr std::string_view kNames[kModes] = {"text", "log", "plot", "quiet"};
  return kNames[static_cast<std::size_t>(mode)];
}

/// The pending answer. It is written line by line as the link has room, each from the state of that moment.
enum class Reply : std::uint8_t {
  kNone,
  kHelp,
  kStatus,
  kObjects,
  kMap,
  kNext,  ///< subject: slot + 1 of the object that was asked for; 0: all
  kSectors,
  kWays,
  kCalibrate,
  kAllSettings,
  kOneSetting,  ///< subject: Key
  kSettingIs,   ///< subject: Key
  kOneDevice,   ///< subject: DeviceKey
  kDeviceIs,    ///< subject: DeviceKey
  kAlertsAre,
  kModeIs,
  kNewRun,
  kVersion,
  kLocked,
  kSelftest,
  kHeld,
  kReleased,
  kGoes,
  kQuit,
  // From here on a line that says what is wrong and what is allowed.
  kNoSuchCommand,  ///< quote; subject: Verb that was perhaps meant, or kNothingNear
  kTooFewWords,    ///< subject: Verb
  kTooManyWords,   ///< subject: Verb; quote: the first one too many
  kNoSuchObject,   ///< quote
  kNoSuchWord,     ///< subject: Verb; quote
  kNoSuchKey,      ///< quote; subject: see name_of_key(), or kNothingNear
  kNoSuchValue,    ///< subject: Key; quote
  kNoSuchDevice,   ///< subject: DeviceKey; quote
  kDeviceRefused,  ///< subject: config::Refusal; quote
  kMayNotGo,
  kWaitsForReset,  ///< quote
  kNotText,
  kLineTooLong,
  kTableFull,  ///< subject: capacity; quote: what did not fit
};

struct Answer {
  static constexpr std::uint8_t kNothingNear = 0xFF;

  Reply reply = Reply::kNone;
  std::uint8_t subject = 0;
  std::uint8_t line = 0;  ///< the next one
  Quote quote{};

  [[nodiscard]] bool pending() const { return reply != Reply::kNone; }
};

/// The typed commands on the robot's motion, and its permission.
struct Motion {
  bool held : 1 = false;       ///< `stop`: nothing may move until `go`
  bool by_button : 1 = false;  ///< it was the board's button that set `ahead`: it needs no port
  bool ahead = false;  ///< `go`: the board's motors; whatever is typed next ends it, and so does whoever drives them
  bool may = false;    ///< loop::MotionPermit allows it now; set by whoever drives the motors
};

struct ConsoleState {
  Mode mode = Mode::kText;
  bool alerts : 1 = true;
  bool locked : 1 = false;              ///< until the program starts again
  std::uint8_t turns_without_room = 0;  ///< since the answer's last line
  Motion motion;
  Answer answer;
  std::uint16_t selftest_at = 0;  ///< next code of the canned stream
  base::Stamp plotted_at;
  DriveGuide guide;
  bool watching = false;  ///< the map again and again, until a line is typed
  bool drawn = false;     ///< the map, since then
  base::Stamp drawn_at;
  TopView view;  ///< of the map that is being drawn
  InputLines input;
};

}  // namespace fencepost::console
