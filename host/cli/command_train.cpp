#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/live_devices.hpp"
#include "host/cli/terminal.hpp"
#include "host/devices/video.hpp"
#include "host/import/text_lines.hpp"
#include "host/live/open_port.hpp"
#include "host/video/colours_file.hpp"
#include "host/video/jpeg.hpp"

namespace fencepost::host::cli {
namespace {

struct TrainRequest {
  std::string picture;
  std::vector<std::string> boxes;
  std::string box_file;
  std::string save;
  std::string output = "-";
};

/// A box and the name of the colour in it.
struct NamedBox {
  TrainingBox box;
  std::string name;
};

constexpr const char* kBoxForm = "write X,Y,WIDTH,HEIGHT or X,Y,WIDTH,HEIGHT=NAME, in px from the upper left corner";

NamedBox parse_box(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string_view numbers = std::string_view(text).substr(0, equals);
  std::array<int, 4> values{};
  const char* at = numbers.data();
  const char* const end = at + numbers.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [stopped, error] = std::from_chars(at, end, values[i]);
    const bool last = i + 1 == values.size();
    if (error != std::errc() || (last ? stopped != end : stopped == end || *stopped != ',')) {
      throw Failure(Exit::kUsage, fmt::format("\"{}\" is no box; {}", text, kBoxForm));
    }
    at = stopped + 1;
  }
  NamedBox named{{values[0], values[1], values[2], values[3]}, {}};
  if (equals != std::string::npos) named.name = text.substr(equals + 1);
  if (named.name.size() > sensor::kMaxText) {
    throw Failure(Exit::kUsage, fmt::format("the name of \"{}\" has more than {} characters", text, sensor::kMaxText));
  }
  return named;
}

/// Boxes of the command line and of the file. In the file each line is one; blank ones and those that begin with # are
/// not.
std::vector<NamedBox> boxes_of(const TrainRequest& request) {
  std::vector<NamedBox> boxes;
  for (const std::string& text : request.boxes) boxes.push_back(parse_box(text));
  if (request.box_file.empty()) return boxes;
  const std::string text = read_input(request.box_file);
  for (const std::string_view line : lines_of(text)) {
    if (!line.empty() && line.front() != '#') boxes.push_back(parse_box(std::string(line)));
  }
  return boxes;
}

/// Boxes of one name have one signature; one without a name has its own.
void number(std::vector<NamedBox>& boxes) {
  int next = 1;
  for (auto box = boxes.begin(); box != boxes.end(); ++box) {
    const auto same = std::find_if(
        boxes.begin(), box, [&](const NamedBox& other) { return !box->name.empty() && other.name == box->name; });
    if (same == box && next > static_cast<int>(segmenter::kMaxRanges)) {
      throw Failure(Exit::kUsage, fmt::format("there are more than {} colours; leave some out", segmenter::kMaxRanges));
    }
    box->box.signature = same == box ? static_cast<std::uint8_t>(next++) : same->box.signature;
  }
}

void check_inside(const NamedBox& named, const RgbPicture& picture) {
  const TrainingBox& box = named.box;
  const bool inside = box.x >= 0 && box.y >= 0 && box.width >= 1 && box.height >= 1 &&
                      box.width <= picture.width - box.x && box.height <= picture.height - box.y;
  if (inside) return;
  throw Failure(Exit::kUsage, fmt::format("the box {},{},{},{} is not in the picture, which has {} x {} px; {}", box.x,
                                          box.y, box.width, box.height, picture.width, picture.height, kBoxForm));
}

RgbPicture picture_of(const TrainRequest& request) {
  const bool device = request.picture.starts_with("v4l2:");
  try {
    linux::Opened<RgbPicture> picture =
        device ? take_picture(devices::webcam_settings(device_of(request.picture, devices::Use::kCamera)))
               : read_picture(request.picture);
    if (!picture) throw Failure(device ? Exit::kDevice : Exit::kUnreadable, picture.problem());
    return std::move(*picture);
  } catch (const DeviceFailure& failure) {
    throw Failure(Exit::kUsage, failure.message);
  }
}

std::string name_of(const std::vector<NamedBox>& boxes, std::uint8_t signature) {
  const auto named =
      std::find_if(boxes.begin(), boxes.end(), [&](const NamedBox& one) { return one.box.signature == signature; });
  return named->name.empty() ? fmt::format("colour {}", signature) : named->name;
}

void say_how_good(const TrainedColour& one, const std::string& name, const RgbPicture& picture) {
  std::string text = fmt::format("{}: {:.0f} % of its boxes, {} px elsewhere", name, 100 * one.found, one.elsewhere);
  if (is_patchy(one)) text += "; draw the boxes smaller, within the thing, and not into glare or shadow";
  if (is_elsewhere(one, picture.width, picture.height)) {
    text += "; something else looks the same: take it away, or paint the thing in a stronger colour";
  }
  say(text);
}

Exit run(const TrainRequest& request) {
  std::vector<NamedBox> boxes = boxes_of(request);
  number(boxes);
  if (boxes.empty() && request.save.empty()) {
    throw Failure(Exit::kUsage, std::string("no --box is given; ") + kBoxForm +
                                    "; with --save FILE.jpg the picture is kept, to look where things are");
  }
  const RgbPicture picture = picture_of(request);
  for (const NamedBox& box : boxes) check_inside(box, picture);
  if (!request.save.empty()) {
    if (const std::string missing = JpegDecoder::missing(); !missing.empty()) throw Failure(Exit::kUsage, missing);
    write_output(request.save, encode_jpeg(picture));
  }
  if (boxes.empty()) return Exit::kDone;
  std::vector<TrainingBox> plain;
  for (const NamedBox& box : boxes) plain.push_back(box.box);
  std::vector<NamedColour> colours;
  for (const TrainedColour& one : train_colours(picture, plain)) {
    colours.push_back({one, name_of(boxes, one.range.signature)});
    say_how_good(one, colours.back().name, picture);
  }
  write_output(request.output, colours_file(colours));
  return Exit::kDone;
}

Action configure_train(Options command) {
  const auto request = std::make_shared<TrainRequest>();
  command
      .positional("PICTURE", request->picture,
                  "a JPEG file, a film (its first picture), or a camera as run names it, such as v4l2:/dev/video0")
      .required();
  command
      .value("--box", request->boxes,
             "a part of the picture that shows one colour: px from the upper left; boxes of one NAME are one colour")
      .takes("X,Y,W,H[=NAME]")
      .one_word();
  command.value("--boxes", request->box_file, "the same, one a line").takes("FILE");
  command.value("--save", request->save, "keep the picture as a JPEG file").takes("FILE");
  command.value("-o,--output", request->output, "where to write the colours; default: standard output").takes("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command train_command() {
  return {"train",
          "the colours that an ordinary camera looks for, from boxes on a picture",
          "  fencepost train v4l2:/dev/video0 --save view.jpg\n"
          "  fencepost train view.jpg --box 120,80,40,60=orange --box 30,90,20,30=blue -o colours.json\n"
          "  fencepost run --camera v4l2:/dev/video0 --colours colours.json --odometry create2:/dev/ttyUSB0\n",
          configure_train,
          {}};
}

}  // namespace fencepost::host::cli
