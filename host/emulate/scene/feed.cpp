#include "host/emulate/scene/feed.hpp"

#include <algorithm>
#include <array>

#include "firmware/record/stream_reader.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::emulate {
namespace {

/// Takes the inputs of one run.
class Collector {
 public:
  explicit Collector(Feed& feed) : feed_(feed) {}

  void accept(const record::Header&) {
    if (begun()) ++later_runs_;
  }
  void accept(const sensor::CameraIntrinsics& camera) {
    if (later_runs_ > 0) return;
    if (feed_.camera && !(*feed_.camera == camera)) ++other_cameras_;
    if (!feed_.camera) feed_.camera = camera;
  }
  void accept(const record::Signature& signature) {
    if (later_runs_ > 0) return;
    for (record::Signature& known : feed_.signatures) {
      if (known.signature != signature.signature) continue;
      known = signature;
      return;
    }
    feed_.signatures.push_back(signature);
  }
  void accept(const sensor::OdometrySample& sample) {
    if (later_runs_ == 0) feed_.poses.push_back(sample);
  }
  void accept(const sensor::BlobFrame& frame) {
    if (later_runs_ == 0) feed_.frames.push_back(frame);
  }
  template <class Record>
  void accept(const Record&) {}

  void finish(const record::Counts& counts, const std::string& name) {
    if (later_runs_ > 0) {
      feed_.notes.push_back(name + ": " + std::to_string(later_runs_) +
                            " more run(s) follow the first; only the first is played, since time and pose start anew");
    }
    if (other_cameras_ > 0) feed_.notes.push_back(name + ": the calibration changes; the first one is used throughout");
    if (const std::uint32_t rejected = counts.rejected(); rejected > 0) {
      feed_.notes.push_back(name + ": " + std::to_string(rejected) + " line(s) rejected; 'fencepost replay' says why");
    }
    if (begun()) return;
    feed_.problem = name + ": no frame ($FPFRM) and no pose ($FPODO) in " + std::to_string(counts.records) +
                    " records; give a scene (JSON) or a log recorded in console mode log";
  }

 private:
  [[nodiscard]] bool begun() const { return !feed_.frames.empty() || !feed_.poses.empty(); }

  Feed& feed_;
  std::uint32_t later_runs_ = 0;
  std::uint32_t other_cameras_ = 0;
};

}  // namespace

base::Time Feed::begin() const {
  if (poses.empty()) return frames.empty() ? base::Time{} : frames.front().t;
  return frames.empty() ? poses.front().t : std::min(frames.front().t, poses.front().t);
}

base::Time Feed::end() const {
  if (poses.empty()) return frames.empty() ? base::Time{} : frames.back().t;
  return frames.empty() ? poses.back().t : std::max(frames.back().t, poses.back().t);
}

std::optional<sensor::Rgb> Feed::colour_of(std::uint8_t signature) const {
  for (const record::Signature& known : signatures) {
    if (known.signature == signature) return known.rgb;
  }
  return std::nullopt;
}

Feed feed_from_log(std::string_view bytes, const std::string& name) {
  Feed feed;
  Collector collector(feed);
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  for (const char byte : bytes) {
    reader.push(byte, collector);
    if (reader.other_format()) break;
  }
  if (reader.other_format()) {
    feed.problem = name + ":" + std::to_string(reader.line_number()) + ": stream format " +
                   std::to_string(*reader.other_format()) + ", this program reads format " +
                   std::to_string(record::kStreamFormat) + "; use the release that wrote the log";
    return feed;
  }
  reader.finish();
  collector.finish(reader.counts(), name);
  return feed;
}

// Through the stream's own lines, so that a scene and its log give the same bytes on the wire.
Feed feed_from_scene(const host::Scene& scene) {
  std::string log;
  const auto summary = host::simulate(scene, [&](std::string_view line) { log += line; });
  if (summary.ok()) return feed_from_log(log, "scene");
  Feed feed;
  feed.problem = summary.error();
  return feed;
}

}  // namespace fencepost::emulate
