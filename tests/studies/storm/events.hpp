// Events that happen to a robot from outside: a list. A failure is shrunk to the shortest list that still fails.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/studies/storm/chance.hpp"

namespace fencepost::test {

enum class EventKind : std::uint8_t {
  kType,      ///< `text` is typed at the console
  kNoise,     ///< bytes of a cable are lost or damaged with probability `amount`, both ways
  kHostile,   ///< `amount` bytes that the device did not send arrive at the robot
  kStall,     ///< the cable carries nothing
  kUnplug,    ///< camera, wheels or console
  kReboot,    ///< the device loses its power for a moment
  kFreeze,    ///< the camera goes on telling its last image
  kThrottle,  ///< the console takes `amount` bytes a millisecond; 0: none
  kSlowDisk,  ///< the disk takes nothing
  kFullDisk,  ///< and nothing any more
  kBusy,      ///< the loop is not called
  kPowerCut,  ///< `text` is typed, and the power goes after `amount` words were written to the flash
};

enum class Cable : std::uint8_t { kCamera, kWheels, kConsole };

struct Event {
  EventKind kind = EventKind::kType;
  Cable cable = Cable::kCamera;
  std::int64_t at = 0;      ///< ms
  std::int64_t length = 0;  ///< ms
  double amount = 0;
  std::uint64_t seed = 0;
  std::string text{};
};

/// One line, for people.
std::string describe(const Event& event);

struct EventChoice {
  std::int64_t milliseconds = 0;  ///< of the run
  bool console_is_log = false;    ///< whatever the console loses is lost to the log: it is slow and stands, no more
  bool disk = false;              ///< there is one that may fail
  bool flash = false;             ///< power may go
  std::vector<std::string> configured{};  ///< lines that may be typed then, beside settings: a calibration, a colour
};
/// In order of time.
std::vector<Event> random_events(Chance& chance, const EventChoice& choice);
/// Camera and wheels lose their power for a moment, each minute, while nobody looks: nothing tells the robot but what
/// they then say.
std::vector<Event> unnoticed_reboots(std::uint64_t seed, std::int64_t milliseconds);

}  // namespace fencepost::test
