// One run as every export takes it: what the log holds and what its replay makes of it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/config/settings.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host::exports {

/// An object as it was after a frame.
struct ObjectAt {
  double t = 0;
  ObjectResult object;  ///< of its models the cylinder and the hybrid
};

struct Run {
  ResultDocument document;
  std::vector<sensor::BlobFrame> frames;
  std::vector<ObjectAt> history;  ///< in order of time
  config::Settings settings;      ///< in force at the end
  std::string name;               ///< of the log, for people
  std::string_view log;           ///< its bytes, which must outlive this
};

/// Remembers objects while a log is replayed: each as it is seen, but not more often than every `interval`.
class History : public RunObserver {
 public:
  explicit History(double interval) : interval_(interval) {}

  void run_begins() override;
  void frame_placed(const PlacedFrame& placed) override;
  [[nodiscard]] std::vector<ObjectAt> take() { return std::move(objects_); }

 private:
  double interval_;                       ///< s
  std::map<std::uint32_t, double> last_;  ///< by id
  std::vector<ObjectAt> objects_;
};

/// The last run of a log. `replayed`: that log with `options` and with `history` as its observer.
Run make_run(std::string_view log, const std::string& name, const ReplayOptions& options, ReplayOutcome replayed,
             History& history);

/// The outline of an object that exports show: of that model; without a name the hybrid's, where it has none the
/// cylinder's. Null: it has none.
const ModelResult* outline_of(const ObjectResult& object, const std::string& model);

/// Sightings confirmed it, now or before: a thing to keep clear of. Maps and solids hold these.
bool is_solid(const ObjectResult& object);

/// "3 red", unique in a run.
std::string title_of(const ResultDocument& document, const ObjectResult& object);

}  // namespace fencepost::host::exports
