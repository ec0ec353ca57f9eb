// The hybrid's targets on the reference scenes (176 px, 43 degrees, sequential circle).
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace fencepost::test {

/// The targets of one noise level, points of per cent.
struct HybridTarget {
  std::string_view level;
  std::array<double, 5> sum_true;      ///< R + P at 2, 4, 8, 18 and 75 views, flags given
  std::array<double, 5> sum_inferred;  ///< flags inferred
  std::optional<double> end_recklessness_true;
  std::optional<double> end_recklessness_inferred;
  bool beats_cylinder = false;  ///< at the end both R and P are below those of Alg. 1
};

inline constexpr std::array<HybridTarget, 7> kHybridTargets = {{
    {"0", {96, 75, 56, 32, 12}, {80, 70, 51, 30, 12}, 3, 3, false},
    {"1", {104, 86, 67, 40, 17}, {93, 78, 62, 41, 18}, 4, 5, false},
    {"2", {116, 103, 80, 47, 23}, {103, 89, 73, 51, 26}, 6, 8, true},
    {"3", {126, 124, 101, 61, 34}, {107, 98, 86, 66, 37}, 10, 13, true},
    {"4", {132, 139, 122, 75, 42}, {120, 115, 104, 80, 47}, 16, 20, true},
    {"S", {107, 90, 67, 39, 16}, {97, 81, 67, 43, 17}, {}, {}, true},
    {"T", {121, 106, 76, 41, 17}, {103, 90, 77, 48, 19}, 4, 6, true},  // reclaims what was lost: R
}};

/// %, maximum R of two convex objects at level 2, all views.
inline constexpr double kConvexRecklessness = 5;
inline constexpr double kConvexParanoia = 8;  ///< %, maximum P of the same
inline constexpr double kConvexOverlap = 88;  ///< %, minimum IoU of the same

/// Maximum difference of a bin's mean excess from the one that its confidence promises.
inline constexpr double kConfidenceError = 0.15;
/// Minimum rank correlation of confidence and excess.
inline constexpr double kMinSpearman = 0.8;

}  // namespace fencepost::test
