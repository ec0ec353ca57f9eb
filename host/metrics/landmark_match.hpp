// Finds the region of a real image that is the rendered landmark, with its confidence, and whether it is right (paper
// Fig. 9, 12).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "host/metrics/reacquisition.hpp"

namespace fencepost::host {

/// The best region is the landmark if its error is below this.
inline constexpr double kAcceptedError = 0.30;

struct LandmarkMatch {
  std::optional<std::size_t> region;  ///< index; nothing: no region is near enough
  std::size_t best = 0;               ///< the nearest one, accepted or not; meaningless without regions
  double error = 1;                   ///< of the best one; 1 without regions
  double match_confidence = 0;        ///< error of the second best (1 if there is none) minus that of the best
  double margin =
      0;  ///< the same, but "none of them" counts as an answer of error kAcceptedError; 0 if that is nearest
};

/// Equal errors: the first region. `image_width` in px.
LandmarkMatch match_landmark(const Region& rendered, std::span<const Region> regions, int image_width);

/// The first three are right; the second three are the corresponding wrong outcomes, in the same order.
enum class MatchOutcome : unsigned char {
  kMatched,     ///< the match is seen in both images
  kUnmatched,   ///< no match, and rightly so: it is rendered, but not in the real image
  kUnseen,      ///< no match: in neither image
  kMismatched,  ///< taken for something else
  kMissed,      ///< no match, though present in both
  kUnrendered,  ///< no match, because the rendering lacks it
};
inline constexpr std::size_t kMatchOutcomes = 6;

constexpr bool is_correct(MatchOutcome outcome) { return outcome < MatchOutcome::kMismatched; }
/// Row of the paper's table: of a wrong outcome, that of the right one beside it.
constexpr MatchOutcome result_type(MatchOutcome outcome) {
  return is_correct(outcome) ? outcome : static_cast<MatchOutcome>(static_cast<unsigned>(outcome) - 3U);
}
std::string_view name(MatchOutcome outcome);

/// Ground truth about a landmark in the real image.
struct LandmarkTruth {
  bool present = false;   ///< it is there, whole: to find it is expected
  bool is_match = false;  ///< the accepted region is (a piece of) the landmark
};

/// `match`: nothing if the model does not render the landmark into this image at all.
MatchOutcome outcome_of(const std::optional<LandmarkMatch>& match, const LandmarkTruth& truth);

/// Counts of outcomes, and the paper's accuracies of them.
struct OutcomeCounts {
  std::array<std::size_t, kMatchOutcomes> counts{};

  void add(MatchOutcome outcome) { ++counts[static_cast<std::size_t>(outcome)]; }
  void add(const OutcomeCounts& other);
  [[nodiscard]] std::size_t of(MatchOutcome outcome) const { return counts[static_cast<std::size_t>(outcome)]; }
  /// Right and wrong ones of one row (kMatched, kUnmatched or kUnseen).
  [[nodiscard]] std::size_t total(MatchOutcome type) const;
  [[nodiscard]] std::size_t incorrect(MatchOutcome type) const;
  [[nodiscard]] std::size_t total() const;
  [[nodiscard]] std::size_t incorrect() const;
  /// Share of right ones; 1 where there are none.
  [[nodiscard]] double accuracy() const;
  [[nodiscard]] double accuracy(MatchOutcome type) const;
};

}  // namespace fencepost::host
