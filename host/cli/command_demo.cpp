#include <fmt/format.h>

#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/page_file.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/share.hpp"
#include "host/cli/terminal.hpp"
#include "host/result/text.hpp"

namespace fencepost::host::cli {
namespace {

constexpr const char* kRecording = "go_around";

std::string next_steps(const std::string& log, const std::string& scene) {
  return fmt::format(
      "Next:\n"
      "  fencepost replay {0} --json\n"
      "  fencepost simulate {1} -o my.log\n"
      "  fencepost report my.log --scene {1}\n"
      "  fencepost --help",
      log, scene);
}

Exit run(const std::string& output) {
  const std::string log = find_recording(std::string(kRecording) + ".log");
  const std::string scene_path = find_recording(std::string(kRecording) + ".json");
  say(fmt::format("Replaying {}: a robot stops before an obstacle and goes around it.", log));
  const ReplayOutcome outcome = replay_file(log, {});
  const GivenLog given{std::string(kRecording) + ".log", read_input(log), read_input(scene_path)};
  write_output(output, page_of_logs({given}));
  if (!is_standard_output(output)) {  // else the page itself is the data
    const TextOptions text{colour_on_stdout(), true, 1};
    write_output("-", alert_list(outcome.result, text) + "\n" + object_table(outcome.result, text) + "\n" +
                          counts(outcome.result, outcome.result.alerts.size()) + "\n");
    say_lines(fmt::format("\nWrote {}: open it in a browser to see the map and the alerts.", output));
  }
  say_what_was_left_out(outcome);
  say_lines(next_steps(log, scene_path));
  return Exit::kDone;
}

Action configure_demo(Options command) {
  const auto output = std::make_shared<std::string>("fencepost-demo.html");
  command.value("-o,--output", *output, "where to write the page; default: fencepost-demo.html").takes("FILE.html");
  return [output] { return run(*output); };
}

}  // namespace

Command demo_command() {
  return {"demo",
          "the bundled recording: alerts, objects and a page, no robot needed",
          "  fencepost demo\n"
          "  fencepost demo -o /tmp/demo.html\n",
          configure_demo,
          {}};
}

}  // namespace fencepost::host::cli
