#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/positive.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/terminal.hpp"
#include "host/segment/read_poses.hpp"
#include "host/segment/segment.hpp"
#include "host/segment/setup_file.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

struct SegmentRequest {
  std::vector<std::string> images;
  std::string poses;
  std::string camera;
  std::string signatures;
  std::vector<std::string> colours;
  std::string background = "find";
  std::string labelled;
  std::string output = "-";
  SegmentOptions options;
  FloorOptions floor;
};

std::string hex(sensor::Rgb rgb) { return fmt::format("{:02x}{:02x}{:02x}", rgb.red, rgb.green, rgb.blue); }

/// "find", "black", "black=48" or "8a8a80,303030".
BackgroundRule parse_background(const std::string& text) {
  constexpr int kBlack = 48;  // of 255
  BackgroundRule rule;
  if (text == "find") return rule;
  if (text.rfind("black", 0) == 0) {
    int threshold = kBlack;
    const bool bare = text == "black";
    if (!bare && (text.size() < 7 || text[5] != '=' || !CLI::detail::lexical_cast(text.substr(6), threshold) ||
                  threshold < 1 || threshold > 255)) {
      throw Failure(Exit::kUsage, "--background " + text + ": write black, or black=N with N from 1 to 255");
    }
    rule.darkest = threshold;
    return rule;
  }
  for (const std::string& colour : CLI::detail::split(text, ',')) {
    rule.colours.push_back(parse_rgb(colour, "--background"));
  }
  return rule;
}

std::vector<record::Signature> given_signatures(const SegmentRequest& request) {
  if (!request.signatures.empty() && !request.colours.empty()) {
    throw Failure(Exit::kUsage, "--signatures and --colour cannot go together; add the colour to the file");
  }
  if (!request.signatures.empty()) {
    return parse_signatures(read_input(request.signatures), input_name(request.signatures));
  }
  std::vector<record::Signature> signatures;
  for (const std::string& colour : request.colours) {
    signatures.push_back(parse_colour(colour, static_cast<std::uint8_t>(signatures.size() + 1)));
  }
  return signatures;
}

std::string poses_of(const SegmentRequest& request) {
  if (!request.poses.empty()) return request.poses;
  std::error_code ignored;
  const std::string& first = request.images.front();
  const fs::path folder = fs::is_directory(first, ignored) ? fs::path(first) : fs::path(first).parent_path();
  const std::string path = (folder / "poses.csv").string();
  if (fs::exists(path, ignored)) return path;
  throw Failure(Exit::kUnreadable, path + " is missing; write it (image,t,x,y,heading), or name it with --poses");
}

/// As a table would name them: in a folder by their file names.
std::vector<std::string> names_of(const std::vector<std::string>& sources) {
  std::error_code ignored;
  const bool folder = sources.size() == 1 && fs::is_directory(sources.front(), ignored);
  std::vector<std::string> names;
  for (const std::string& path : folder ? images_in(sources.front()) : sources) {
    names.push_back(fs::path(path).filename().string());
  }
  return names;
}

SegmentHooks hooks_for(const SegmentRequest& request, const std::vector<View>& views, Progress& progress) {
  SegmentHooks hooks;
  hooks.progress = [&](std::size_t done, std::size_t all) {
    progress.at(static_cast<double>(done), static_cast<double>(all));
  };
  if (request.labelled.empty()) return hooks;
  std::error_code error;
  fs::create_directories(request.labelled, error);
  if (error) throw Failure(Exit::kDevice, "cannot make the folder " + request.labelled + ": " + error.message());
  hooks.labelled = [&request, &views](std::size_t i, const cv::Mat& picture) {
    const std::string name = fmt::format("{:04}_{}.png", i, fs::path(views[i].path).stem().string());
    write_output((fs::path(request.labelled) / name).string(), encode_png(picture));
  };
  return hooks;
}

/// "1 region", "2 regions".
std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

void say_counts(const SegmentSummary& summary) {
  say(fmt::format("{} of {} x {} px, {}", counted(summary.frames, "image"), summary.width, summary.height,
                  counted(summary.blobs, "blob")));
  const auto say_if = [](std::size_t count, const char* thing, const char* what) {
    if (count > 0) say(counted(count, thing) + " " + what);
  };
  say_if(summary.empty, "image", "with nothing but background");
  say_if(summary.merged, "region", "joined to another of the same signature");
  say_if(summary.small, "region", "left out: too small (--min-pixels)");
  say_if(summary.dropped, "region", "left out: a frame holds 16, the largest");
}

void say_colours(const SegmentSummary& summary) {
  for (const SignatureUse& use : summary.signatures) {
    const record::Signature& signature = use.signature;
    say(fmt::format("signature {:3} {} {}: in {} images", signature.signature, hex(signature.rgb),
                    signature.name.view(), use.images));
  }
  const auto say_list = [](const char* what, const std::vector<sensor::Rgb>& colours) {
    if (colours.empty()) return;
    std::string text = what;
    for (const sensor::Rgb colour : colours) text += " " + hex(colour);
    say(text);
  };
  say_list("background:", summary.background);
  say_list("left out, in too few images:", summary.rare);
}

void say_table(const PosesTable& table, const ImageList& list) {
  if (list.without_pose > 0) say(counted(list.without_pose, "image") + " left out: not in " + table.file);
  if (table.made_up_times) say(table.file + " tells no times: they are made up, one image every 0.1 s");
  if (table.shifted_times) say("t counts from the first image: the stream's clock ends at 999999 s");
  for (const std::string& note : table.notes) say(note);
  for (const std::string& column : table.unused_columns) say("column " + column + " of " + table.file + " is not used");
}

Exit run(SegmentRequest request) {
  try {
    request.options.classes.background = parse_background(request.background);
    request.options.classes.signatures = given_signatures(request);
  } catch (const SegmentProblem& problem) {
    const bool option = problem.where.rfind("--", 0) == 0;
    throw Failure(option ? Exit::kUsage : Exit::kUnreadable, problem.message());
  }
  try {
    const sensor::CameraIntrinsics camera = parse_camera(read_input(request.camera), input_name(request.camera));
    const std::string poses = poses_of(request);
    request.floor.rotate = request.options.straightening.rotate;
    const PosesTable table =
        read_poses(read_input(poses), input_name(poses), names_of(request.images), camera.mount, request.floor);
    const ImageList list = list_images(request.images, table);
    std::optional<Progress> progress("segmenting");
    const SegmentResult result =
        segment(list.views, camera, request.options, hooks_for(request, list.views, *progress));
    progress.reset();
    if (!result.ok()) throw result.error();
    write_output(request.output, result->log);
    say_counts(result->summary);
    say_colours(result->summary);
    say_table(table, list);
  } catch (const SegmentProblem& problem) {
    throw Failure(Exit::kUnreadable, problem.message());
  }
  return Exit::kDone;
}

void add_looks(CLI::App& app, SegmentRequest& request) {
  app.add_option("--signatures", request.signatures, "colours to look for: a scene, or $FPSIG lines; default: found")
      ->type_name("FILE");
  app.add_option("--colour,--color", request.colours, "the same on the command line, numbered from 1")
      ->type_name("NAME=RRGGBB")
      ->allow_extra_args(false);
  app.add_option("--background", request.background,
                 "find, black[=N] (darker than N of 255), or colours; default: find")
      ->type_name("WHAT");
  app.add_flag("--silhouette", request.options.classes.silhouette, "all that is no background is one object");
}

void add_knobs(CLI::App& app, SegmentOptions& options) {
  app.add_option("--rotate", options.straightening.rotate, "turn the images clockwise first: 0, 90, 180 or 270")
      ->check(CLI::IsMember({0, 90, 180, 270}))
      ->type_name("DEGREES");
  app.add_flag("--undistort", options.straightening.undistort, "take the calibration's k1 out of the images first");
  app.add_option("--spatial", options.spatial, "px, radius of the mean shift; default: width / 64, 3 to 10")
      ->type_name("PX")
      ->check(CLI::Range(1.0, 100.0));
  app.add_option("--range", options.range, "grey levels that the mean shift smooths over; default: 16")
      ->type_name("N")
      ->check(CLI::Range(1.0, 255.0));
  app.add_option("--min-pixels", options.min_pixels,
                 "smaller regions are dropped; default: 0.05 % of the image, 12 at least")
      ->type_name("N")
      ->check(positive());
  app.add_option("--max-gap", options.max_gap,
                 "regions of one signature this near are one; default: width / 100, 2 at least")
      ->type_name("PX")
      ->check(CLI::Range(0, 32767));
  app.add_option("--border", options.border,
                 "ends this near to the border count as on it; default: width / 160, 2 at least")
      ->type_name("PX")
      ->check(CLI::Range(0, 32767));
}

Action configure_segment(CLI::App& app) {
  const auto request = std::make_shared<SegmentRequest>();
  app.add_option("IMAGES", request->images, "a folder, or PNG and JPEG files")->required();
  app.add_option("--camera", request->camera,
                 "their calibration: a scene, its \"camera\", a file with the $FPCAM line, or OpenCV's YAML")
      ->type_name("FILE")
      ->required();
  app.add_option("--poses", request->poses,
                 "CSV image,t,x,y,heading (s, m, rad), COLMAP's images.txt, or TUM's trajectory; default: poses.csv "
                 "beside the images")
      ->type_name("FILE");
  static const std::map<std::string, bool> kWhose = {{"camera", false}, {"robot", true}};
  app.add_option("--poses-of", request->floor.of_robot, "whose poses COLMAP's or TUM's are; default: camera")
      ->transform(CLI::CheckedTransformer(kWhose))
      ->option_text("camera|robot");
  app.add_option("--scale", request->floor.scale, "m that one unit of COLMAP's or TUM's poses is; default: 1")
      ->type_name("M")
      ->check(positive());
  add_looks(app, *request);
  add_knobs(app, request->options);
  app.add_option("--debug-images", request->labelled, "write what was found as pictures into this folder")
      ->type_name("DIR");
  app.add_option("-o,--output", request->output, "where to write the log; default: standard output")->type_name("LOG");
  return [request] { return run(*request); };
}

}  // namespace

Command segment_command() {
  return {"segment",
          "images and poses as a record stream",
          "  fencepost segment photos --camera camera.json -o run.log\n"
          "  fencepost segment photos --camera camera.json --debug-images found | fencepost replay -\n",
          configure_segment,
          {}};
}

}  // namespace fencepost::host::cli
