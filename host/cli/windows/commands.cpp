#include <array>

#include "host/cli/command.hpp"

namespace fencepost::host::cli {

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      demo_command(),    configure_command(), doctor_command(), devices_command(),   record_command(),
      monitor_command(), replay_command(),    report_command(), simulate_command(),  evaluate_command(),
      import_command(),  export_command(),    help_command(),   completion_command()};
  return table;
}

// Those of Linux's buses, and those of fencepost-lab.
std::span<const std::string_view> commands_elsewhere() {
  static constexpr std::array<std::string_view, 8> kNames = {"run",   "train",  "emulate", "calibrate",
                                                             "merge", "smooth", "paper",   "segment"};
  return kNames;
}

}  // namespace fencepost::host::cli
