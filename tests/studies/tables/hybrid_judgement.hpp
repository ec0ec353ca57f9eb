// The hybrid against the paper's algorithms, cell by cell, and against the figures it was meant to reach.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"

namespace fencepost::test {

/// One scene twice. `paper` has true flags, and the paper's algorithms are taken from it. `hybrid` has the flags that
/// the hybrid gets, which may be the same run.
struct ScenePair {
  host::Evaluation paper;
  host::Evaluation hybrid;
};

/// One noise level at one number of views. In points of per cent.
struct CellJudgement {
  std::optional<std::uint32_t> views;  ///< nothing: the end of the tour
  double recklessness = 0;
  double paranoia = 0;
  std::string rival;          ///< the best of the paper's algorithms here
  double rival_sum = 0;       ///< its R + P
  double difference = 0;      ///< mean over objects of R + P, hybrid minus rival
  double standard_error = 0;  ///< of the difference, scenes as units
  std::size_t objects = 0;

  [[nodiscard]] double sum() const { return recklessness + paranoia; }
  [[nodiscard]] bool holds() const { return difference <= standard_error; }
};

/// Alg. 1 as printed, both rules of Alg. 2, Alg. 3 on a grid and exactly.
const std::vector<std::string>& paper_models();

/// The rival is the model of paper_models() with the least mean R + P over all objects. Pairs objects of one scene that
/// reached `views` in both runs; one that the hybrid's run missed counts as without area there.
/// errors: throws std::runtime_error for fewer than two scenes with such a pair.
CellJudgement judge_cell(std::span<const ScenePair> scenes, std::optional<std::uint32_t> views);

/// Means of one model in one cell over the same objects, points of per cent. Same errors.
struct ModelMeans {
  double recklessness = 0;
  double paranoia = 0;
  double iou = 0;
};
ModelMeans means_of_model(std::span<const host::Evaluation> scenes, const std::string& model,
                          std::optional<std::uint32_t> views);

/// A fit's confidence, and its R + P beyond that of the hull of the truth.
struct Confidence {
  double reported = 0;
  double excess = 0;
};
/// One for every cut of every object, kHullLimit beside it.
std::vector<Confidence> confidences(std::span<const host::Evaluation> scenes);

/// Excess by reported confidence, against min(1, 1.05 (1 - c)) at the bin's mean c.
struct ConfidenceBin {
  double from = 0;
  double to = 0;
  std::size_t fits = 0;
  double reported = 0;  ///< mean
  double excess = 0;    ///< mean
  [[nodiscard]] double promised() const;
};
std::vector<ConfidenceBin> bins_of(std::span<const Confidence> fits);

/// Spearman's rank correlation of -reported and excess, ties by mean rank.
double spearman(std::span<const Confidence> fits);

}  // namespace fencepost::test
