// Measures of one log, and the means over several.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/evaluate/metrics.hpp"

namespace fencepost::host {

struct ModelScore {
  std::string model;
  Score score;
};

/// One object at one moment: when it reached this number of views, or at the end of the run.
struct Cut {
  std::uint32_t views = 0;
  bool end = false;
  std::optional<double> position_error;  ///< m, from the cylinder's centre to the footprint's centroid
  std::vector<ModelScore> models;        ///< empty for a true object that was not found: scored as empty
  double confidence = 0;                 ///< the object's
};

/// The map object that is matched to a true one.
struct FoundObject {
  std::uint32_t id = 0;
  record::ObjectState state = record::ObjectState::kTentative;
  std::uint32_t views = 0;
};

struct ObjectEvaluation {
  std::size_t truth = 0;  ///< index into Scene::objects
  std::string name;
  std::uint8_t signature = 0;
  std::uint64_t visible = 0;           ///< frames in which it was seen (without frame truth: its signature)
  bool missed = false;                 ///< visible often enough, but no confirmed object is matched to it
  std::optional<FoundObject> found;    ///< may be tentative
  std::optional<std::uint64_t> swaps;  ///< of the found object; nothing without frame truth
  std::vector<Cut> cuts;               ///< by views, the end last; none if neither found nor missed
};

/// A confirmed object that is matched to no true one.
struct Phantom {
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  std::uint32_t views = 0;
  std::optional<std::size_t> follows;  ///< the true object that owns most of its blobs: then it is a duplicate
};

struct Evaluation {
  std::string log;
  std::string scene;
  bool frame_truth = false;  ///< the scene reproduces exactly this log, so the owner of each blob is known
  std::uint64_t frames = 0;  ///< that the map took
  std::uint64_t digest = 0;
  std::string profile;
  std::vector<std::string> models;        ///< names, in order of the result
  std::vector<ObjectEvaluation> objects;  ///< one for each true object
  std::vector<Phantom> phantoms;
  std::optional<std::uint64_t> swaps;  ///< of all objects; nothing without frame truth
};

/// A log of several that could not be measured, and why.
struct UnjudgedLog {
  std::string log;
  std::string why;
};

/// Mean over `n` objects; no standard error for one.
struct Mean {
  double mean = 0;
  std::optional<double> standard_error;
  std::uint64_t n = 0;
};

struct SummaryRow {
  std::string model;
  std::optional<std::uint32_t> views;  ///< nothing: the end
  Mean recklessness;                   ///< an empty model counts 1
  Mean paranoia;                       ///< without empty models
  Mean iou;                            ///< an empty model counts 0
  std::uint64_t empty = 0;
};

struct PositionRow {
  std::optional<std::uint32_t> views;
  Mean error;  ///< m; objects without a cylinder are left out
};

struct Summary {
  std::uint64_t logs = 0;
  std::uint64_t objects = 0;  ///< true ones that were found or should have been
  std::uint64_t found = 0;    ///< by confirmed objects
  std::uint64_t missed = 0;
  std::uint64_t phantoms = 0;
  std::optional<std::uint64_t> swaps;  ///< nothing unless every log has frame truth
  std::vector<SummaryRow> rows;        ///< by model, then by views, the end last
  std::vector<PositionRow> position;
};

}  // namespace fencepost::host
