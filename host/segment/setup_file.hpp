// The known set-up: the camera's calibration, the colours to look for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/records.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// From a scene, from JSON that has just its block "camera", from a line $FPCAM, or from a calibration of OpenCV's or
/// ROS's (opencv_camera.hpp). errors: SegmentProblem
sensor::CameraIntrinsics parse_camera(std::string_view text, const std::string& name);

/// From a scene, from JSON that has just its "signatures", or from lines $FPSIG. At least one, each number once.
/// errors: SegmentProblem
std::vector<record::Signature> parse_signatures(std::string_view text, const std::string& name);

/// "red=c02020" is signature `number`. errors: SegmentProblem
record::Signature parse_colour(std::string_view text, std::uint8_t number);

/// "c02020". errors: SegmentProblem
sensor::Rgb parse_rgb(std::string_view digits, const std::string& where);

}  // namespace fencepost::host
