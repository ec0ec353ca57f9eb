// `fencepost run`: the robot's loop on real devices until it is stopped.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/linux/clock.hpp"
#include "host/live/alert_now.hpp"
#include "host/live/console_port.hpp"
#include "host/live/device.hpp"
#include "host/live/live_loop.hpp"
#include "host/live/robot_file.hpp"
#include "host/live/write_behind.hpp"

namespace fencepost::host {

struct RunPlan {
  RobotFile robot;
  std::string profile = "full";  ///< one of kLiveProfiles
  console::Mode mode = console::Mode::kText;
  std::string version;                     ///< of the program, for FPHDR
  std::optional<std::uint64_t> frames;     ///< stop after this number of frame records
  std::optional<base::Duration> duration;  ///< stop after so long
  bool console_is_people = false;          ///< standard error is read beside the console: link messages go there only
  bool ends_without_log = false;           ///< a log that cannot be written any more ends the run
};

/// The parts of a run; all of them are borrowed.
struct RunParts {
  linux::MonotonicClock clock;
  Devices& devices;
  ConsolePort& console;
  WriteBehind* log = nullptr;
  std::function<void(std::string_view)> say;            ///< messages for people, a line each
  const volatile std::sig_atomic_t& interrupted;        ///< not 0: stop
  int interrupted_descriptor = -1;                      ///< readable then; -1: an interrupt is seen a little later
  std::vector<AlertOutput*> outputs = {};               ///< follow the alert in force, beside console and log
  std::function<void(std::string_view)> follower = {};  ///< gets the log's lines, whole; must not wait
};

struct RunSummary {
  enum class End : std::uint8_t { kDone, kInterrupted };
  End end = End::kDone;
  base::Duration time;
  console::Counters counters;
  std::uint64_t alerts = 0;
  std::uint64_t digest = 0;
  base::Duration stalled;          ///< the longest time in which an input would have waited for this machine
  std::uint64_t console_lost = 0;  ///< bytes that nobody read
  bool output_failed = false;      ///< the console could not be written any more, and there was no log
  bool log_failed = false;
  base::Duration log_until;    ///< if it failed: since the start
  std::uint64_t log_lost = 0;  ///< bytes of records after that
  std::string log;             ///< its name; empty without
  std::uint64_t log_bytes = 0;

  /// "12.3 s: 617 frames, ...", the cause of a stall if there was any, and "digest 0123456789abcdef, log run.log
  /// (...)": a line each.
  [[nodiscard]] std::string sentence() const;
};

RunSummary run_live(const RunPlan& plan, const RunParts& parts);

}  // namespace fencepost::host
