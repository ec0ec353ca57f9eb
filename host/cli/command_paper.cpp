#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/lab.hpp"

namespace fencepost::host::cli {
namespace {

Action configure_paper(Options command) {
  const auto request = std::make_shared<PaperRequest>();
  command
      .value("-o,--output", request->output,
             "folder for the page, its drawings and CSV files; default: fencepost-paper. Files of the same names are "
             "replaced, others stay")
      .takes("DIR");
  command.value("--seed", request->seed, "of the scene that is drawn; the others count up from it; default: 1")
      .takes("N")
      .within(0, 1'000'000'000);
  command
      .value("--scenes", request->scenes,
             "scenes of the table of Figure 10; so many, but at most 20, for the curves; default: 60")
      .takes("N")
      .within(1, 10'000);
  command.value("--log", request->log, "a recorded run instead of simulated scenes: of fencepost segment, say")
      .takes("LOG");
  command.value("--scene", request->scene, "the truth about that run; its first two objects are the landmarks")
      .takes("SCENE");
  command
      .value("--images", request->images,
             "the photographs that the run was made of: the first by name is that of frame 0; without it real "
             "images are drawn from the scene")
      .takes("DIR");
  command
      .value("--single", request->single_scenes,
             "scenes in each of which, alone, every sentence is looked at again; default: 20")
      .takes("N")
      .within(0, 10'000);
  return [request] { return run_paper(*request); };
}

}  // namespace

Command paper_command() {
  return {"paper",
          "the paper's figures and its table, from simulated scenes, as a folder",
          "  fencepost paper -o paper\n"
          "  fencepost paper -o paper-7 --seed 7 --scenes 10\n"
          "  fencepost paper -o blocks --log blocks.log --scene blocks.json --images photos\n",
          configure_paper,
          {},
          true};
}

}  // namespace fencepost::host::cli
