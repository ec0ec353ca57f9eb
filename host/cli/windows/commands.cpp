#include "host/cli/command.hpp"

namespace fencepost::host::cli {

// Without those of Linux's buses (run, train, emulate), and those of fencepost-lab.
const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      demo_command(),    configure_command(), doctor_command(), devices_command(),   record_command(),
      monitor_command(), replay_command(),    report_command(), simulate_command(),  evaluate_command(),
      import_command(),  export_command(),    help_command(),   completion_command()};
  return table;
}

}  // namespace fencepost::host::cli
