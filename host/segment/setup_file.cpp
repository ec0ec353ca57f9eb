#include "host/segment/setup_file.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "firmware/record/stream_reader.hpp"
#include "host/scene/read_scene.hpp"
#include "host/scene/rgb.hpp"
#include "host/segment/colmap_camera.hpp"
#include "host/segment/opencv_camera.hpp"
#include "host/segment/problem.hpp"

namespace fencepost::host {

namespace {

/// Keeps the first calibration of a stream and each signature once.
struct SetupSink {
  std::optional<sensor::CameraIntrinsics> camera;
  std::vector<record::Signature> signatures;
  void accept(const sensor::CameraIntrinsics& found) {
    if (!camera) camera = found;
  }
  void accept(const record::Signature& found) {
    const auto same = [&](const record::Signature& known) { return known.signature == found.signature; };
    if (std::none_of(signatures.begin(), signatures.end(), same)) signatures.push_back(found);
  }
  template <class Record>
  void accept(const Record&) {}
};

SetupSink read_stream(std::string_view text) {
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  SetupSink sink;
  reader.push(text, sink);
  reader.push("\n", sink);  // a single pasted line is a whole line here
  return sink;
}

bool is_json(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && text[start] == '{';
}

/// The result of `read` on the JSON text; an error of the reader becomes a SegmentProblem.
template <class Read>
auto from_json(std::string_view text, const std::string& name, Read read) {
  try {
    const JsonText json(text, "share/doc/segment.md shows one");
    const JsonNode root = json.root();
    root.expect_object();
    return read(root);
  } catch (const SceneProblem& problem) {
    throw SegmentProblem{problem.where.empty() ? name : name + ": " + problem.where, problem.what, problem.remedy};
  }
}

}  // namespace

sensor::CameraIntrinsics parse_camera(std::string_view text, const std::string& name) {
  if (is_json(text)) {
    return from_json(text, name, [](const JsonNode& root) {
      Scene scene;
      read_camera(root.at("camera"), scene);
      return scene.camera;
    });
  }
  if (is_colmap_calibration(text)) return parse_colmap_calibration(text, name);
  if (is_opencv_calibration(text)) return parse_opencv_calibration(text, name);
  const SetupSink sink = read_stream(text);
  if (sink.camera) return *sink.camera;
  throw SegmentProblem{
      name, "has no calibration",
      "give a scene, its block \"camera\", the $FPCAM line of a log, OpenCV's YAML, or COLMAP's cameras.txt"};
}

std::vector<record::Signature> parse_signatures(std::string_view text, const std::string& name) {
  std::vector<record::Signature> signatures;
  if (is_json(text)) {
    signatures = from_json(text, name, [](const JsonNode& root) {
      std::vector<record::Signature> all;
      for (const SceneSignature& read : read_signatures(root.at("signatures"), 1)) all.push_back(read.recorded());
      return all;
    });
  } else {
    signatures = read_stream(text).signatures;
  }
  if (signatures.empty()) {
    throw SegmentProblem{name, "has no signatures", "give a scene, its \"signatures\", or $FPSIG lines of a log"};
  }
  return signatures;
}

sensor::Rgb parse_rgb(std::string_view digits, const std::string& where) {
  if (const auto rgb = rgb_of(digits)) return *rgb;
  throw SegmentProblem{where, "\"" + std::string(digits.substr(0, 40)) + "\" is not a colour",
                       "write six hex digits RRGGBB, such as c02020"};
}

record::Signature parse_colour(std::string_view text, std::uint8_t number) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  if (equals == std::string_view::npos || name.empty() || name.size() > sensor::kMaxText) {
    throw SegmentProblem{"--colour", "\"" + std::string(text.substr(0, 40)) + "\" is not NAME=RRGGBB",
                         "write for example red=c02020"};
  }
  return {number, parse_rgb(text.substr(equals + 1), "--colour"), sensor::Text(name)};
}

}  // namespace fencepost::host
