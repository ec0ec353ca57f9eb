// All data of the figures, computed once.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/evaluate/metrics.hpp"
#include "host/metrics/visibility.hpp"
#include "host/paper/blocks_world.hpp"
#include "host/paper/reacquire.hpp"

namespace fencepost::host {

/// A sequence of images of the two landmarks, and what each algorithm made of it after some of them.
struct SequenceData {
  Tour tour;
  std::vector<std::size_t> after;                           ///< image numbers (1 is the first), ascending
  Models models;                                            ///< one snapshot for each of `after`
  std::vector<std::vector<std::vector<Score>>> scores;      ///< by algorithm, landmark and snapshot
  std::vector<std::vector<PerimeterPart>> shown;            ///< by landmark and frame
  std::vector<std::vector<double>> thoroughness;            ///< of the images up to and with that frame
  std::vector<std::vector<std::optional<double>>> novelty;  ///< of that frame over the images before it

  /// Index of the snapshot after `images`; it must be there.
  [[nodiscard]] std::size_t snapshot(std::size_t images) const;
  [[nodiscard]] const Score& score(std::size_t algorithm, std::size_t landmark, std::size_t images) const {
    return scores[algorithm][landmark][snapshot(images)];
  }
};

/// `blocks`: how many of the scene's objects, from the first, are reconstructed.
SequenceData follow_sequence(Tour tour, std::size_t blocks, const std::vector<std::size_t>& after);

/// Reacquisition of the yellow landmark from every pose of a sequence, by models of its first images.
struct NoveltySample {
  std::size_t images = 0;  ///< that the models are of
  double novelty = 0;      ///< of this view over them
  double confidence = 0;   ///< match_confidence
};

/// Sets of first images that Figure 13 builds its models of.
inline const std::vector<std::size_t> kNoveltySets{8, 18, 36};

/// One algorithm's decision about one landmark in one image.
struct Decision {
  BlocksWorld world = BlocksWorld::kPaperLike;
  std::uint64_t seed = 0;
  std::size_t algorithm = 0;
  std::size_t landmark = 0;
  std::size_t frame = 0;
  double confidence = 0;  ///< of the match, if there is one
};

/// Decisions to be drawn as pictures.
struct Examples {
  std::optional<Decision> least_sure_mismatch;
  std::array<std::optional<Decision>, kMatchOutcomes> outcomes;  ///< the first of each by an algorithm of the paper

  /// Adds examples of a sequence of images; `found` names its scene and algorithm.
  void add(const Sequence& sequence, Decision found);
  [[nodiscard]] bool complete() const;
};

struct PaperData {
  std::uint64_t seed = 0;
  std::string run;                        ///< name of the recorded run that all of this is of; empty: simulated scenes
  std::vector<std::size_t> mean_images;   ///< after which the means are taken, ascending
  SequenceData shown;                     ///< the sequence that is drawn; a snapshot after each image
  std::vector<SequenceData> noisy;        ///< more scenes, for means
  std::vector<SequenceData> ideal;        ///< the same scenes without noise
  std::vector<ReacquisitionScore> table;  ///< by algorithm, over `table_scenes` scenes
  std::size_t table_scenes = 0;
  Examples examples;               ///< in those scenes; outcomes that they lack are from hard ones
  std::vector<Sequence> sequence;  ///< by algorithm: the shown scene's landmarks, by models of all its images
  std::vector<std::vector<NoveltySample>> novelty;  ///< by algorithm, over `noisy`
};

/// Numbers of images after which the means over scenes are taken, as far as a scene has them.
inline const std::vector<std::size_t> kMeanImages{2, 4, 6, 8, 12, 18, 24, 30, 36, 40, 50, 60, 75};

/// Gets a description of the finished step, and its work in units of one table scene.
using Progress = std::function<void(std::string_view what, double work)>;
inline constexpr double kWorkOfMeanScene = 4;    ///< one scene of the curves
inline constexpr double kWorkOfSingleScene = 6;  ///< one scene that is evaluated alone
inline constexpr double kWorkOfShown = 3;        ///< the sequence that is drawn

/// `mean_scenes` scenes for the curves, `table_scenes` for Figure 10; seeds count up from `seed`.
PaperData evaluate_paper(std::uint64_t seed, std::size_t mean_scenes, std::size_t table_scenes,
                         const Progress& progress);

/// The same of one scene of the curves and one of the table, alone: is a statement about many true of each?
PaperData evaluate_scene(std::uint64_t seed);

/// The same of one recorded run: the scene's first two objects are the landmarks (red, yellow). The means and the table
/// are of this run alone. errors: std::runtime_error: too few frames or objects.
PaperData evaluate_run(const std::string& name, Tour tour, const Progress& progress);

/// A member of Score; not a number for the paranoia of an empty model.
double measure_of(const Score& score, double Score::*what);

/// Mean of measure_of() over sequences, for the yellow landmark; not a number of none.
double mean_score(std::span<const SequenceData> sequences, std::size_t algorithm, std::size_t images,
                  double Score::*what);
/// How many of these models are empty.
std::size_t count_empty(std::span<const SequenceData> sequences, std::size_t algorithm, std::size_t images);

}  // namespace fencepost::host
