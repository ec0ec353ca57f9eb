// One run as every export takes it: the log's data and its replay's results.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/config/settings.hpp"
#include "firmware/record/stream_reader.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host::exports {

/// An object as it was after a frame.
struct ObjectAt {
  double t = 0;
  ObjectResult object;  ///< of its models the cylinder and the hybrid, one of them with an outline
};

struct Run {
  ResultDocument document;
  std::vector<sensor::BlobFrame> frames;
  std::vector<ObjectAt> history;  ///< in order of time
  config::Settings settings;      ///< in force at the end
  std::string name;               ///< of the log, for people
  std::string_view log;           ///< its bytes, which must outlive this
};

/// Remembers objects while a log is replayed: each as it is seen, but not more often than every `interval`; without
/// `outlines` only its numbers.
class History : public RunObserver {
 public:
  explicit History(double interval, bool outlines = true) : interval_(interval), outlines_(outlines) {}

  void run_begins() override;
  void frame_placed(const PlacedFrame& placed) override;
  [[nodiscard]] std::vector<ObjectAt> take() { return std::move(objects_); }

 private:
  double interval_;  ///< s
  bool outlines_;
  std::map<std::uint32_t, double> last_;  ///< by id
  std::vector<ObjectAt> objects_;
};

/// Data of a log's last run that its replay does not give: its frames, and its settings at the end. Takes the same
/// bytes as the replay, in any portions.
class RunInputs {
 public:
  /// `options`: of the replay; must outlive this. Without `frames` they are not kept.
  RunInputs(const ReplayOptions& options, bool frames) : options_(options), with_frames_(frames) {}
  void take(std::string_view bytes);

  // The sink of the reader.
  void accept(const record::Header& header);
  void accept(const sensor::BlobFrame& frame);
  void accept(const record::Setting& setting);
  template <class Record>
  void accept(const Record& /*record*/) {}

  [[nodiscard]] std::vector<sensor::BlobFrame>& frames() { return frames_; }
  [[nodiscard]] const config::Settings& settings() const { return settings_; }

 private:
  const ReplayOptions& options_;
  bool with_frames_;
  std::vector<sensor::BlobFrame> frames_;
  config::Settings settings_;
  std::uint64_t taken_ = 0;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

/// The last run of a log. `replayed`: that log with `history` as its observer; `log`: its bytes, for formats that have
/// them inside.
Run make_run(std::string_view log, const std::string& name, RunInputs& inputs, ReplayOutcome replayed,
             History& history);

/// The outline of an object that exports show: of that model; without a name the hybrid's, where it has none the
/// cylinder's. Null: it has none.
const ModelResult* outline_of(const ObjectResult& object, const std::string& model);

/// Sightings confirmed it, now or before: a thing to keep clear of. Maps and solids hold these.
bool is_solid(const ObjectResult& object);

/// "3 red", unique in a run.
std::string title_of(const ResultDocument& document, const ObjectResult& object);

}  // namespace fencepost::host::exports
