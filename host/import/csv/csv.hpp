// Tables of blobs and of poses, by the names of their columns.
#pragma once

#include <string>
#include <string_view>

#include "host/import/take.hpp"

namespace fencepost::host {

/// Blobs: t, and x1,y1,x2,y2 or x,y,width,height (centre); perhaps signature, frame, cx, cy, pixels, name. Rows of one
/// t (or one frame) are one frame; a row whose box is empty is a frame without blobs. Other names that people use for
/// the same are known (share/doc/import.md). Several names of colours without numbers are numbered by their first rows.
Taken take_csv(std::string_view blobs, const std::string& file);  ///< errors: ImportProblem

ImportResult import_csv(std::string_view blobs, const std::string& file, const TakeSettings& settings);

/// t,x,y,heading by column names, s, m, rad; or TUM's "timestamp tx ty tz qx qy qz qw" with z up.
/// errors: ImportProblem
std::vector<TimedPose> parse_pose_table(std::string_view text, const std::string& file);

}  // namespace fencepost::host
