#include "host/emulate/models/cmucam_commands.hpp"

#include <algorithm>
#include <span>

namespace fencepost::emulate {
namespace {

constexpr unsigned kOne = 1;
constexpr unsigned kTwo = 2;
constexpr unsigned kThree = 4;
constexpr unsigned kFour = 8;
constexpr unsigned kTwoOrThree = kTwo | kThree;
constexpr unsigned kAll = kOne | kTwoOrThree | kFour;

/// Who knows a command, with how many arguments.
struct Known {
  std::string_view name;
  unsigned models;
  std::size_t least;
  std::size_t most;
};

// Commands whose answers need more of a camera than tracking (dumps, histograms, inputs) are not emulated: NCK.
constexpr Known kKnown[] = {
    {"GV", kAll, 0, 0},
    {"RS", kAll, 0, 0},
    {"TC", kAll, 0, 6},
    {"PM", kAll, 1, 1},
    {"RM", kOne | kTwoOrThree, 1, 1},
    {"CR", kOne | kTwoOrThree, 0, 16},
    {"MM", kOne, 1, 1},
    {"NF", kAll, 1, 1},
    {"DM", kOne | kTwo | kFour, 1, 1},
    {"HM", kOne | kFour, 1, 1},
    {"SW", kOne | kFour, 0, 4},
    {"VW", kTwoOrThree, 4, 4},
    {"HR", kTwoOrThree, 1, 1},
    {"PF", kTwoOrThree, 1, 1},
    {"OM", kTwoOrThree, 2, 2},
    {"ST", kTwoOrThree | kFour, 0, 6},
    {"GT", kTwoOrThree | kFour, 0, 0},
    {"AG", kFour, 1, 1},
    {"AW", kFour, 1, 1},
    {"VF", kFour, 1, 1},
    {"BM", kFour, 1, 1},
    {"GW", kFour, 0, 0},
};

// Commands that a CMUcam4 answers with ACK only: its lamps, servos, screen, outputs and picture effects.
constexpr Known kWithoutEffect[] = {
    {"L0", kFour, 0, 0}, {"L1", kFour, 1, 1}, {"CB", kFour, 1, 1}, {"CC", kFour, 1, 1}, {"CW", kFour, 3, 3},
    {"BW", kFour, 1, 1}, {"NG", kFour, 1, 1}, {"M0", kFour, 0, 0}, {"M1", kFour, 0, 0}, {"MF", kFour, 1, 1},
    {"MS", kFour, 1, 1}, {"SS", kFour, 3, 3}, {"AP", kFour, 2, 2}, {"AT", kFour, 2, 2}, {"PP", kFour, 2, 2},
    {"TP", kFour, 2, 2}, {"PO", kFour, 2, 2}, {"TO", kFour, 2, 2}, {"SO", kFour, 2, 2},
};

unsigned bit(CmuCamModel model) { return 1U << static_cast<unsigned>(model); }

const Known* find(std::span<const Known> table, CmuCamModel model, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Known& candidate) {
    return candidate.name == name && (candidate.models & bit(model)) != 0;
  });
  return found == table.end() ? nullptr : &*found;
}

bool suits(const Known& known, std::size_t arguments) { return arguments >= known.least && arguments <= known.most; }

}  // namespace

CmuCamJudgement cmucam_judgement(CmuCamModel model, std::string_view name, std::size_t arguments) {
  if (const Known* known = find(kKnown, model, name)) {
    return suits(*known, arguments) ? CmuCamJudgement::kAct : CmuCamJudgement::kRefuse;
  }
  const Known* empty = find(kWithoutEffect, model, name);
  return empty != nullptr && suits(*empty, arguments) ? CmuCamJudgement::kAccept : CmuCamJudgement::kUnknown;
}

}  // namespace fencepost::emulate
