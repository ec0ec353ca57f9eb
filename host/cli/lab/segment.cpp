#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <sstream>

#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/terminal.hpp"
#include "host/scene/rgb.hpp"
#include "host/segment/read_poses.hpp"
#include "host/segment/segment.hpp"
#include "host/segment/setup_file.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

/// "find", "black", "black=48" or "8a8a80,303030".
BackgroundRule parse_background(const std::string& text) {
  constexpr int kBlack = 48;  // of 255
  BackgroundRule rule;
  if (text == "find") return rule;
  if (text.rfind("black", 0) == 0) {
    int threshold = kBlack;
    const bool bare = text == "black";
    const char* const end = text.data() + text.size();
    if (!bare && (text.size() < 7 || text[5] != '=' || std::from_chars(text.data() + 6, end, threshold).ptr != end ||
                  threshold < 1 || threshold > 255)) {
      throw Failure(Exit::kUsage, "--background " + text + ": write black, or black=N with N from 1 to 255");
    }
    rule.darkest = threshold;
    return rule;
  }
  std::istringstream colours(text + ",");
  for (std::string colour; std::getline(colours, colour, ',');) {
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

void say_counts(const SegmentSummary& summary) {
  say(fmt::format("{} of {} x {} px, {}", plural(summary.frames, "image"), summary.width, summary.height,
                  plural(summary.blobs, "blob")));
  const auto say_if = [](std::size_t count, const char* thing, const char* what) {
    if (count > 0) say(plural(count, thing) + " " + what);
  };
  say_if(summary.empty, "image", "with nothing but background");
  say_if(summary.merged, "region", "joined to another of the same signature");
  say_if(summary.small, "region", "left out: too small (--min-pixels)");
  say_if(summary.dropped, "region", "left out: a frame holds 16, the largest");
}

void say_colours(const SegmentSummary& summary) {
  for (const SignatureUse& use : summary.signatures) {
    const record::Signature& signature = use.signature;
    say(fmt::format("signature {:3} {} {}: in {}", signature.signature, rgb_text(signature.rgb), signature.name.view(),
                    plural(use.images, "image")));
  }
  const auto say_list = [](const char* what, const std::vector<sensor::Rgb>& colours) {
    if (colours.empty()) return;
    std::string text = what;
    for (const sensor::Rgb colour : colours) text += " " + rgb_text(colour);
    say(text);
  };
  say_list("background:", summary.background);
  say_list("left out, in too few images:", summary.rare);
}

void say_table(const PosesTable& table, const ImageList& list) {
  if (list.without_pose > 0) say(plural(list.without_pose, "image") + " left out: not in " + table.file);
  if (table.made_up_times) say(table.file + " tells no times: they are made up, one image every 0.1 s");
  if (table.shifted_times) say("t counts from the first image: the stream's clock ends at 999999 s");
  for (const std::string& note : table.notes) say(note);
  for (const std::string& column : table.unused_columns) say("column " + column + " of " + table.file + " is not used");
}

SegmentOptions options_of(const SegmentRequest& request) {
  SegmentOptions options;
  options.straightening.rotate = request.rotate;
  options.straightening.undistort = request.undistort;
  options.classes.silhouette = request.silhouette;
  options.spatial = request.spatial;
  options.range = request.range;
  options.min_pixels = request.min_pixels;
  options.max_gap = request.max_gap;
  options.border = request.border;
  return options;
}

}  // namespace

Exit run_segment(const SegmentRequest& request) {
  SegmentOptions options = options_of(request);
  try {
    options.classes.background = parse_background(request.background);
    options.classes.signatures = given_signatures(request);
  } catch (const SegmentProblem& problem) {
    const bool option = problem.where.rfind("--", 0) == 0;
    throw Failure(option ? Exit::kUsage : Exit::kUnreadable, problem.message());
  }
  try {
    const sensor::CameraIntrinsics camera = parse_camera(read_input(request.camera), input_name(request.camera));
    const std::string poses = poses_of(request);
    const FloorOptions floor{request.poses_of == "robot", request.scale, request.rotate};
    const PosesTable table =
        read_poses(read_input(poses), input_name(poses), names_of(request.images), camera.mount, floor);
    const ImageList list = list_images(request.images, table);
    std::optional<Progress> progress("segmenting");
    const SegmentResult result = segment(list.views, camera, options, hooks_for(request, list.views, *progress));
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

}  // namespace fencepost::host::cli
