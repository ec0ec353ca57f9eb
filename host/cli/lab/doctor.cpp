#include <fmt/format.h>

#include "host/calibrate/cause_findings.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/terminal.hpp"

namespace fencepost::host::cli {

bool has_lab() { return true; }

std::vector<doctor::Finding> distance_findings(std::string_view bytes, const std::string& log) {
  ReplayOptions options;
  options.profile = "full";
  ReplayOutcome replayed;
  const DriveLog drive = read_drive(bytes, log, options, replayed);
  if (replayed.unreadable) return {};
  const Causes found = find_causes(drive);
  if (found.moving > kMaxMoving) {
    say(fmt::format("distances are not judged: {:.0f} % of the boxes are of things that move", 100 * found.moving));
  }
  if (found.sideways) say("distances are not judged: the robot moves sideways, which wheels that roll cannot");
  if (found.several) {
    say("no single number explains these distances, so none is named; 'fencepost calibrate' estimates all together");
  }
  if (found.is_part) {
    say(fmt::format("distances are judged by the first {:.0f} s and the {} objects seen most", kJudgedSeconds,
                    kJudgedObjects));
  }
  return findings_of_causes(found.causes, drive.signatures, log);
}

}  // namespace fencepost::host::cli
