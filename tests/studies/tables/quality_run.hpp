// One random scene at one noise level: driven, reconstructed, measured.
#pragma once

#include <string>
#include <vector>

#include "host/evaluate/evaluate.hpp"
#include "tests/studies/common/noise_levels.hpp"

namespace fencepost::test {

/// The source from which the reconstruction learns which ends of a blob are hidden.
enum class OcclusionFlags {
  kInferred,  ///< from the log alone, as on the robot: correspondence and flags are the map's own
  kTrue,      ///< from the simulator, and so is whose each blob is
};

/// The random scenes to run.
enum class SceneKind {
  kSequential,  ///< reference_scene()
  kSpread,      ///< spread_scene()
  kTwoConvex,   ///< two_objects_scene()
};
host::Scene scene_of(SceneKind kind, unsigned seed);

struct QualityOptions {
  SceneKind kind = SceneKind::kSequential;
  OcclusionFlags flags = OcclusionFlags::kInferred;
  std::string profile = "full";
  std::string dump;  ///< a folder for each scene and its log, to look closer with `fencepost evaluate`; empty: none
};

/// Columns of the tables; the last one is the end of the circle of 75 views.
inline const std::vector<std::uint32_t> kTableViews{2, 4, 8, 18};

/// The same seed gives the same scene and the same draws at every level and with either kind of flags. Beside the
/// models there is one more, kHullLimit: the convex hull of the truth, the best that silhouettes can give.
/// errors: throws std::runtime_error with a sentence.
host::Evaluation run_scene(unsigned seed, const NoiseLevel& level, const QualityOptions& options);

inline constexpr const char* kHullLimit = "(convex hull of truth: limit)";

}  // namespace fencepost::test
