#include "host/metrics/landmark_match.hpp"

#include <algorithm>

namespace fencepost::host {
namespace {

double share_right(std::size_t wrong, std::size_t all) {
  return all == 0 ? 1 : 1 - static_cast<double>(wrong) / static_cast<double>(all);
}

MatchOutcome wrong_counterpart(MatchOutcome right) {
  return static_cast<MatchOutcome>(static_cast<unsigned>(right) + static_cast<unsigned>(MatchOutcome::kMismatched));
}

}  // namespace

LandmarkMatch match_landmark(const Region& rendered, std::span<const Region> regions, int image_width) {
  LandmarkMatch match;
  double second = 1;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const double error = reacquisition_error(reacquisition_terms(regions[i], rendered, image_width));
    if (i == 0 || error < match.error) {
      second = i == 0 ? 1 : match.error;
      match.best = i;
      match.error = error;
    } else {
      second = std::min(second, error);
    }
  }
  match.match_confidence = second - match.error;
  match.margin = std::max(0.0, std::min(second, kAcceptedError) - match.error);
  if (!regions.empty() && match.error < kAcceptedError) match.region = match.best;
  return match;
}

std::string_view name(MatchOutcome outcome) {
  switch (outcome) {
    case MatchOutcome::kMatched: return "matched";
    case MatchOutcome::kUnmatched: return "unmatched";
    case MatchOutcome::kUnseen: return "unseen";
    case MatchOutcome::kMismatched: return "mismatched";
    case MatchOutcome::kMissed: return "missed";
    case MatchOutcome::kUnrendered: return "unrendered";
  }
  return "";
}

MatchOutcome outcome_of(const std::optional<LandmarkMatch>& match, const LandmarkTruth& truth) {
  if (!match) return truth.present ? MatchOutcome::kUnrendered : MatchOutcome::kUnseen;
  if (match->region) return truth.is_match ? MatchOutcome::kMatched : MatchOutcome::kMismatched;
  return truth.present ? MatchOutcome::kMissed : MatchOutcome::kUnmatched;
}

void OutcomeCounts::add(const OutcomeCounts& other) {
  for (std::size_t i = 0; i < kMatchOutcomes; ++i) counts[i] += other.counts[i];
}

std::size_t OutcomeCounts::total(MatchOutcome type) const { return of(type) + incorrect(type); }

std::size_t OutcomeCounts::incorrect(MatchOutcome type) const { return of(wrong_counterpart(type)); }

std::size_t OutcomeCounts::total() const {
  std::size_t sum = 0;
  for (const std::size_t count : counts) sum += count;
  return sum;
}

std::size_t OutcomeCounts::incorrect() const {
  return incorrect(MatchOutcome::kMatched) + incorrect(MatchOutcome::kUnmatched) + incorrect(MatchOutcome::kUnseen);
}

double OutcomeCounts::accuracy() const { return share_right(incorrect(), total()); }

double OutcomeCounts::accuracy(MatchOutcome type) const { return share_right(incorrect(type), total(type)); }

}  // namespace fencepost::host
