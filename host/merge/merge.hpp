// One map of several: runs, or robots, that saw the same things from places that nobody measured against each other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/merge/relocate.hpp"
#include "host/relocation/constellation.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

struct RunMap {
  std::string log;  ///< its name
  ResultDocument result;
  std::string_view bytes{};                          ///< of the run; empty: it is not looked at sighting by sighting
  std::optional<sensor::CameraIntrinsics> camera{};  ///< for one without FPCAM
};

/// The objects of a map that a search takes: confirmed, or lost since, seen often enough, with a place.
struct KnownPoints {
  std::vector<recon::ConstellationPoint> points;
  std::vector<std::size_t> objects;  ///< of the document, by point
};
KnownPoints known_points(const ResultDocument& document);

/// Where a run's map frame lies in that of the merged map, which is the first run's.
struct RunJoin {
  std::string log;
  recon::JoinVerdict verdict = recon::JoinVerdict::kTooFew;
  PoseResult frame;           ///< its origin and heading; of no meaning unless joined
  std::uint32_t objects = 0;  ///< that were used: confirmed, with a place
  std::uint32_t matched = 0;  ///< of them, with objects of the other runs
  std::uint32_t missing = 0;  ///< seen where the others' map has nothing
  double false_alarms = 0;    ///< recon::JoinResult
  double misfit = 0;          ///< m, root mean square of the matches
  /// Of one that stays out: where it begins all the same, by its single sightings.
  std::optional<Relocated> start{};
  [[nodiscard]] bool joined() const { return verdict == recon::JoinVerdict::kJoined; }
};

/// An object of one of the runs.
struct MergeSource {
  std::size_t run = 0;
  std::uint32_t id = 0;
};

struct MergedMap {
  /// The objects of all joined runs, with new ids. An object that several runs saw is there once, at the mean of its
  /// places, with the models of the one with the most views. Counts, paths and guard points are of all joined; no
  /// alerts.
  ResultDocument map;
  std::vector<RunJoin> runs;                      ///< in the order given; the first is always joined
  std::vector<std::vector<MergeSource>> sources;  ///< by object of the map
  std::vector<std::string> notes;                 ///< signatures with two names: one sentence each
};

/// Takes at least one run. A run stays out, with the reason, if its objects do not determine where it belongs. It is
/// tried again when other runs have enlarged the map.
MergedMap merge(const std::vector<RunMap>& runs);

/// Why a run stays out, and what would help; for a joined one empty.
std::string reason(const RunJoin& join);
/// A line a run, then the objects.
std::string merge_text(const MergedMap& merged, bool colour);
/// The result document with "runs" beside its keys, and "sources" in each object.
std::string merge_json(const MergedMap& merged);

}  // namespace fencepost::host
