// One command of the program: what --help says about it, and how it runs.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/cli/options.hpp"

namespace fencepost::host::cli {

using Action = std::function<Exit()>;

struct Command {
  std::string name;
  std::string summary;   ///< one clause, for the list of commands
  std::string examples;  ///< shown last in --help, one a line, each indented by two blanks
  /// Declares the command's options. The action runs after parsing; for a command of commands it is empty.
  std::function<Action(Options)> configure;
  std::vector<Command> children;
  bool by_lab = false;  ///< done by the second program (lab.hpp), which its help says
};

/// The program in one clause.
inline constexpr const char* kProgramSummary = "obstacle maps and alerts from coloured blobs and odometry";

/// Every command, in the order in which people meet them. Help, suggestions and completion all read this table.
const std::vector<Command>& commands();
/// The names of those that only the program of another system has.
std::span<const std::string_view> commands_elsewhere();

Command completion_command();
Command configure_command();
Command demo_command();
Command devices_command();
Command doctor_command();
Command help_command();
Command record_command();
Command replay_command();
Command report_command();
Command simulate_command();
Command evaluate_command();
Command merge_command();
Command monitor_command();
Command calibrate_command();
Command smooth_command();
Command import_command();
Command segment_command();
Command paper_command();
Command run_command();
Command train_command();
Command emulate_command();
Command export_command();

}  // namespace fencepost::host::cli
