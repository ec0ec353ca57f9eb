#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/lab.hpp"

namespace fencepost::host::cli {
namespace {

void add_looks(Options command, SegmentRequest& request) {
  command.value("--signatures", request.signatures, "colours to look for: a scene, or $FPSIG lines; default: found")
      .takes("FILE");
  command.value("--colour,--color", request.colours, "the same on the command line, numbered from 1")
      .takes("NAME=RRGGBB")
      .one_word();
  command.value("--background", request.background, "find, black[=N] (darker than N of 255), or colours; default: find")
      .takes("WHAT");
  command.flag("--silhouette", request.silhouette, "all that is no background is one object");
}

void add_knobs(Options command, SegmentRequest& request) {
  command.value("--rotate", request.rotate, "turn the images clockwise first: 0, 90, 180 or 270")
      .one_of({"0", "90", "180", "270"})
      .takes("DEGREES");
  command.flag("--undistort", request.undistort, "take the calibration's k1 out of the images first");
  command.value("--spatial", request.spatial, "px, radius of the mean shift; default: width / 64, 3 to 10")
      .takes("PX")
      .within(1.0, 100.0);
  command.value("--range", request.range, "grey levels that the mean shift smooths over; default: 16")
      .takes("N")
      .within(1.0, 255.0);
  command
      .value("--min-pixels", request.min_pixels,
             "smaller regions are dropped; default: 0.05 % of the image, 12 at least")
      .takes("N")
      .positive();
  command
      .value("--max-gap", request.max_gap,
             "regions of one signature this near are one; default: width / 100, 2 at least")
      .takes("PX")
      .within(0, 32767);
  command
      .value("--border", request.border,
             "ends this near to the border count as on it; default: width / 160, 2 at least")
      .takes("PX")
      .within(0, 32767);
}

Action configure_segment(Options command) {
  const auto request = std::make_shared<SegmentRequest>();
  command.positional("IMAGES", request->images, "a folder, or PNG and JPEG files").required();
  command
      .value("--camera", request->camera,
             "their calibration: a scene, its \"camera\", a file with the $FPCAM line, or OpenCV's YAML")
      .takes("FILE")
      .required();
  command
      .value("--poses", request->poses,
             "CSV image,t,x,y,heading (s, m, rad), COLMAP's images.txt, or TUM's trajectory; default: poses.csv "
             "beside the images")
      .takes("FILE");
  command.value("--poses-of", request->poses_of, "whose poses COLMAP's or TUM's are; default: camera")
      .one_of({"camera", "robot"})
      .shown_as("camera|robot");
  command.value("--scale", request->scale, "m that one unit of COLMAP's or TUM's poses is; default: 1")
      .takes("M")
      .positive();
  add_looks(command, *request);
  add_knobs(command, *request);
  command.value("--debug-images", request->labelled, "write what was found as pictures into this folder").takes("DIR");
  command.value("-o,--output", request->output, "where to write the log; default: standard output").takes("LOG");
  return [request] { return run_segment(*request); };
}

}  // namespace

Command segment_command() {
  return {"segment",
          "images and poses as a record stream",
          "  fencepost segment photos --camera camera.json -o run.log\n"
          "  fencepost segment photos --camera camera.json --debug-images found | fencepost replay -\n",
          configure_segment,
          {},
          true};
}

}  // namespace fencepost::host::cli
