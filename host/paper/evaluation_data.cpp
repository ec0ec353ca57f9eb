#include "host/paper/evaluation_data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace fencepost::host {
namespace {

/// This many hard scenes are searched for examples that the table's have none of.
constexpr std::uint64_t kHardScenes = 10;

MultiPolygon geometry_of(const Snapshot& snapshot, std::string_view name) {
  for (const ModelResult& model : snapshot.models) {
    if (model.name == name) return model.geometry;
  }
  return {};
}

void measure(SequenceData& data) {
  for (const Algorithm& algorithm : algorithms()) {
    auto& by_landmark = data.scores.emplace_back();
    for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
      std::vector<Score>& scores = by_landmark.emplace_back();
      const Polygon& footprint = data.tour.scene.objects[landmark].footprint;
      for (const Snapshot& snapshot : data.models.of(algorithm, landmark).snapshots) {
        scores.push_back(score(geometry_of(snapshot, algorithm.model), footprint));
      }
    }
  }
}

void look(SequenceData& data) {
  const Scene& scene = data.tour.scene;
  const double pitch = scene.camera.mount.pitch ? scene.camera.mount.pitch->to_double() : 0.0;
  const FieldOfView view = field_of_view(scene.camera, pitch);
  for (const std::size_t landmark : {kRedLandmark, kYellowLandmark}) {
    ViewSet set(scene.objects[landmark].footprint.outer);
    auto& shown = data.shown.emplace_back();
    auto& thoroughness = data.thoroughness.emplace_back();
    auto& novelty = data.novelty.emplace_back();
    for (const FrameTruth& frame : data.tour.frames) {
      shown.push_back(visible_perimeter(scene.objects, landmark, lens_at(scene.camera, frame.pose), view));
      novelty.push_back(set.novelty(shown.back()));
      set.add(shown.back());
      thoroughness.push_back(set.thoroughness());
    }
  }
}

std::vector<Sequence> reacquire_by_all(const SequenceData& data) {
  RegionRenderer renderer(data.tour.scene.camera);
  std::vector<Sequence> sequences;
  for (const Algorithm& algorithm : algorithms()) {
    const auto world = world_of(data.tour, data.models, algorithm, data.snapshot(data.tour.frames.size()));
    sequences.push_back(reacquire_all(data.tour, renderer, world));
  }
  return sequences;
}

/// Each view that shows the landmark, by models of the first images.
void sample_novelty(const SequenceData& data, std::vector<std::vector<NoveltySample>>& samples) {
  RegionRenderer renderer(data.tour.scene.camera);
  for (const std::size_t images : kNoveltySets) {
    if (images > data.tour.frames.size()) continue;
    ViewSet set(data.tour.scene.objects[kYellowLandmark].footprint.outer);
    for (std::size_t f = 0; f < images; ++f) set.add(data.shown[kYellowLandmark][f]);
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      const auto world = world_of(data.tour, data.models, algorithms()[a], data.snapshot(images));
      for (std::size_t f = 0; f < data.tour.frames.size(); ++f) {
        const auto novelty = set.novelty(data.shown[kYellowLandmark][f]);
        const auto match = reacquire_both(data.tour, renderer, world, f)[kYellowLandmark].match;
        if (novelty && match) samples[a].push_back({images, *novelty, match->match_confidence});
      }
    }
  }
}

std::vector<ReacquisitionScore> score_scenes(BlocksWorld world, std::uint64_t seed, std::size_t scenes,
                                             Examples& examples, const std::function<void()>& scene_done) {
  std::vector<ReacquisitionScore> table(algorithms().size());
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Tour tour = drive(blocks_world(world, seed + i));
    RegionRenderer renderer(tour.scene.camera);
    const Models models = reconstruct(tour, block_count(world), {tour.frames.size()});
    for (std::size_t a = 0; a < table.size(); ++a) {
      const std::vector<Solid> by_models = world_of(tour, models, algorithms()[a], 0);
      const Sequence sequence = reacquire_all(tour, renderer, by_models);
      table[a].add(sequence);
      table[a].count_empty(by_models);
      examples.add(sequence, {world, seed + i, a, 0, 0, 0});
    }
    scene_done();
  }
  return table;
}

SequenceData figures_sequence(std::uint64_t seed, bool noisy, const std::vector<std::size_t>& after) {
  constexpr BlocksWorld kKind = BlocksWorld::kFigures;
  return follow_sequence(drive(blocks_world(kKind, seed, noisy)), block_count(kKind), after);
}

std::vector<std::size_t> first_numbers(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 1U);
  return numbers;
}

}  // namespace

void Examples::add(const Sequence& sequence, Decision found) {
  const bool of_the_paper = algorithms()[found.algorithm].paper_average.has_value();
  for (found.landmark = 0; found.landmark < sequence.size(); ++found.landmark) {
    for (found.frame = 0; found.frame < sequence[found.landmark].size(); ++found.frame) {
      const Reacquisition& one = sequence[found.landmark][found.frame];
      found.confidence = one.match ? one.match->match_confidence : 0;
      auto& example = outcomes[static_cast<std::size_t>(one.outcome)];
      if (!example && of_the_paper) example = found;
      if (one.outcome != MatchOutcome::kMismatched) continue;
      if (!least_sure_mismatch || found.confidence < least_sure_mismatch->confidence) least_sure_mismatch = found;
    }
  }
}

bool Examples::complete() const {
  return least_sure_mismatch && std::all_of(outcomes.begin(), outcomes.end(), [](const auto& one) { return one; });
}

std::size_t SequenceData::snapshot(std::size_t images) const {
  const auto found = std::find(after.begin(), after.end(), images);
  if (found == after.end()) throw std::logic_error("no snapshot after that image");
  return static_cast<std::size_t>(found - after.begin());
}

SequenceData follow_sequence(Tour tour, std::size_t blocks, const std::vector<std::size_t>& after) {
  SequenceData data;
  data.tour = std::move(tour);
  data.after = after;
  data.models = reconstruct(data.tour, blocks, after);
  measure(data);
  look(data);
  return data;
}

PaperData evaluate_paper(std::uint64_t seed, std::size_t mean_scenes, std::size_t table_scenes,
                         const Progress& progress) {
  PaperData data;
  data.seed = seed;
  data.table_scenes = table_scenes;
  data.mean_images = kMeanImages;
  data.shown = figures_sequence(seed, true, first_numbers(kPaperViews));
  data.sequence = reacquire_by_all(data.shown);
  progress("the sequence that is drawn", kWorkOfShown);
  data.novelty.resize(algorithms().size());
  for (std::uint64_t i = 1; i <= mean_scenes; ++i) {
    data.noisy.push_back(figures_sequence(seed + i, true, kMeanImages));
    data.ideal.push_back(figures_sequence(seed + i, false, kMeanImages));
    sample_novelty(data.noisy.back(), data.novelty);
    progress("scenes for means", kWorkOfMeanScene);
  }
  data.table = score_scenes(BlocksWorld::kPaperLike, seed, table_scenes, data.examples,
                            [&] { progress("landmarks found again, for the table", 1); });
  for (std::uint64_t i = 0; i < kHardScenes && !data.examples.complete(); ++i) {
    score_scenes(BlocksWorld::kHard, seed + i, 1, data.examples, [] {});
  }
  return data;
}

PaperData evaluate_scene(std::uint64_t seed) {
  PaperData data;
  data.seed = seed;
  data.table_scenes = 1;
  data.mean_images = kMeanImages;
  data.shown = figures_sequence(seed, true, first_numbers(kPaperViews));
  data.sequence = reacquire_by_all(data.shown);
  data.noisy.push_back(data.shown);
  data.ideal.push_back(figures_sequence(seed, false, kMeanImages));
  data.novelty.resize(algorithms().size());
  sample_novelty(data.shown, data.novelty);
  data.table = score_scenes(BlocksWorld::kPaperLike, seed, 1, data.examples, [] {});
  return data;
}

PaperData evaluate_run(const std::string& name, Tour tour, const Progress& progress) {
  constexpr std::size_t kMinFrames = 8;
  const std::size_t frames = tour.frames.size();
  const std::size_t blocks = tour.scene.objects.size();
  if (frames < kMinFrames) throw std::runtime_error("fewer than 8 frames with a pose");
  if (blocks < 2) throw std::runtime_error("the scene needs two objects, its first two are the landmarks");
  PaperData data;
  data.run = name;
  data.table_scenes = 1;
  for (const std::size_t images : kMeanImages) {
    if (images < frames) data.mean_images.push_back(images);
  }
  data.mean_images.push_back(frames);
  data.shown = follow_sequence(std::move(tour), blocks, first_numbers(frames));
  progress("the run", kWorkOfShown / 2);
  data.sequence = reacquire_by_all(data.shown);
  progress("the run", kWorkOfShown / 2);
  data.noisy.push_back(data.shown);
  data.novelty.resize(algorithms().size());
  sample_novelty(data.shown, data.novelty);
  data.table.resize(algorithms().size());
  for (std::size_t a = 0; a < data.table.size(); ++a) {
    data.table[a].add(data.sequence[a]);
    data.table[a].count_empty(world_of(data.shown.tour, data.shown.models, algorithms()[a], frames - 1));
    data.examples.add(data.sequence[a], {BlocksWorld::kPaperLike, 0, a, 0, 0, 0});
  }
  return data;
}

double measure_of(const Score& score, double Score::*what) {
  return score.empty && what == &Score::paranoia ? std::nan("") : score.*what;
}

double mean_score(std::span<const SequenceData> sequences, std::size_t algorithm, std::size_t images,
                  double Score::*what) {
  double sum = 0;
  double count = 0;
  for (const SequenceData& data : sequences) {
    const double value = measure_of(data.score(algorithm, kYellowLandmark, images), what);
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : std::nan("");
}

std::size_t count_empty(std::span<const SequenceData> sequences, std::size_t algorithm, std::size_t images) {
  return static_cast<std::size_t>(std::ranges::count_if(
      sequences, [&](const SequenceData& data) { return data.score(algorithm, kYellowLandmark, images).empty; }));
}

}  // namespace fencepost::host
