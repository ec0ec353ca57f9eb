#include "host/cli/command.hpp"

namespace fencepost::host::cli {

const std::vector<Command>& commands() {
  static const std::vector<Command> table = {
      demo_command(),     run_command(),       train_command(),   configure_command(), doctor_command(),
      devices_command(),  record_command(),    monitor_command(), replay_command(),    report_command(),
      simulate_command(), evaluate_command(),  merge_command(),   calibrate_command(), smooth_command(),
      paper_command(),    emulate_command(),   import_command(),  export_command(),    segment_command(),
      help_command(),     completion_command()};
  return table;
}

std::span<const std::string_view> commands_elsewhere() { return {}; }

}  // namespace fencepost::host::cli
