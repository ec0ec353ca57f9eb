#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <system_error>

#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/paper/log_tour.hpp"
#include "host/paper/paper.hpp"
#include "host/segment/image_file.hpp"
#include "host/segment/image_list.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

/// Before a minute of work: the folder is there and takes files.
void prepare(const std::string& folder) {
  const auto fail = [&](const std::string& why) {
    throw Failure(Exit::kDevice, "cannot write into " + folder + ": " + why + "; choose another folder with -o");
  };
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) fail("it is a file");
  fs::create_directories(folder, error);
  if (error) fail(error.message());
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail(std::generic_category().message(errno));
}

/// The photographs of a folder, by the number of the frame that was made of each.
std::function<Picture(std::uint32_t)> photographs(const std::string& folder, const Tour& tour) {
  std::vector<std::string> files;
  try {
    files = images_in(folder);
  } catch (const SegmentProblem& problem) {
    throw Failure(Exit::kUnreadable, problem.message());
  }
  for (const FrameTruth& frame : tour.frames) {
    if (frame.frame.frame < files.size()) continue;
    throw Failure(Exit::kUnreadable,
                  fmt::format("{}: {}, but the run has a frame {}; name the folder that the run was made of", folder,
                              plural(files.size(), "image"), frame.frame.frame));
  }
  const sensor::CameraIntrinsics camera = tour.scene.camera;
  return [files, camera](std::uint32_t frame) {
    const std::string& file = files[frame];
    try {
      const cv::Mat image = read_image(file);
      if (image.cols != camera.width || image.rows != camera.height) {
        throw Failure(Exit::kUnreadable, fmt::format("{}: {} x {} px, but the run\u2019s camera has {} x {}", file,
                                                     image.cols, image.rows, camera.width, camera.height));
      }
      cv::Mat rgb;
      cv::cvtColor(image, rgb, cv::COLOR_BGR2RGB);
      return Picture{rgb.cols, rgb.rows, {rgb.datastart, rgb.dataend}};
    } catch (const SegmentProblem& problem) {
      throw Failure(Exit::kUnreadable, problem.message());
    }
  };
}

/// The recorded run, if one was named.
std::optional<PaperRun> recorded_run(const PaperRequest& request) {
  if (request.log.empty() && request.scene.empty()) {
    if (request.images.empty()) return std::nullopt;
    throw Failure(Exit::kUsage, "--images are those of a recorded run: name it with --log and --scene");
  }
  if (request.log.empty() || request.scene.empty()) {
    throw Failure(Exit::kUsage, "--log and --scene belong together: a run, and the truth about it");
  }
  const Scene scene = read_scene(request.scene);
  PaperRun run{fs::path(request.log).filename().string(), tour_of_log(read_log(request.log), scene)};
  if (!request.images.empty()) run.tour.photograph = photographs(request.images, run.tour);
  return run;
}

std::vector<PaperFile> make_page(const PaperOptions& options, const std::string& log) {
  try {
    return write_paper(options);
  } catch (const std::runtime_error& error) {
    if (!options.run) throw;
    throw Failure(Exit::kUnreadable, log + ": " + error.what());
  }
}

}  // namespace

Exit run_paper(const PaperRequest& request) {
  PaperOptions options;
  options.generator = "fencepost " FENCEPOST_VERSION;
  options.seed = request.seed;
  options.scenes = request.scenes;
  options.single_scenes = request.single_scenes;
  options.run = recorded_run(request);
  prepare(request.output);
  options.mean_scenes = std::min(options.mean_scenes, options.scenes);
  std::optional<Progress> progress("computing");
  options.progress = [&](std::string_view what, double done, double all) { progress->at(done, all, what); };
  const std::vector<PaperFile> files = make_page(options, request.log);
  progress.reset();
  for (const PaperFile& file : files) {
    write_output((fs::path(request.output) / file.name).string(), file.bytes);
  }
  say("wrote " + (fs::path(request.output) / "index.html").string() + "; open it in a browser");
  return Exit::kDone;
}

}  // namespace fencepost::host::cli
