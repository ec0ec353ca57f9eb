#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/lab.hpp"

namespace fencepost::host::cli {
namespace {

Action configure_merge(Options command) {
  const auto request = std::make_shared<MergeRequest>();
  command
      .positional("LOG", request->logs,
                  "recorded streams, all runs of each; the map frame is that of the first; - is standard input")
      .required();
  command.profile(request->profile, "capacities of the robots; default: each log's, else full");
  command.log_camera(request->camera);
  command.flag("--json", request->json, "write the result document, with \"runs\" and \"sources\", instead of text");
  command.value("-o,--output", request->output, "where to write; default: standard output").takes("FILE");
  return [request] { return run_merge(*request); };
}

}  // namespace

Command merge_command() {
  return {"merge",
          "one map of several runs or robots, joined by the objects they share",
          "  fencepost merge morning.log noon.log\n"
          "  fencepost merge robot*.log --json | jq '.runs'\n",
          configure_merge,
          {},
          true};
}

}  // namespace fencepost::host::cli
