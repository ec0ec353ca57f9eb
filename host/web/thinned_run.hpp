// The data for the page of a log that is too long to be in it. Looks at some times, path and alerts as fine as they can
// be shown, and all final results.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "host/result/to_json.hpp"
#include "host/web/page_replay.hpp"

namespace fencepost::host {

struct ThinnedText {
  std::string packed;  ///< JSON, as gzip packs it
  std::string said;    ///< a sentence: how much of the run it has
};

/// In memory that does not grow with the log.
class ThinnedRun final : private AlertSink {
 public:
  /// `options`: profile and camera. `alerts` gets all alerts.
  ThinnedRun(const ReplayOptions& options, AlertSink& alerts);
  ThinnedRun(const ThinnedRun&) = delete;
  ThinnedRun& operator=(const ThinnedRun&) = delete;

  void take(std::string_view bytes);
  void finish();

  [[nodiscard]] const LogReplay& log() const { return replay_.log(); }
  /// After `finish`, with the alerts of the run. In `most` bytes, if thinning can do that.
  [[nodiscard]] ThinnedText text(const EachAlert& alerts, std::size_t most) const;

 private:
  struct Look {
    double time = 0;
    std::string json;
  };
  /// Evenly thinned when they become too many.
  struct Looks {
    std::vector<Look> kept;
    std::size_t bytes = 0;
    /// Whether it had to drop every other one.
    bool add(Look look);
    /// Every 2^level-th of them.
    void collect(std::size_t level, std::vector<const Look*>& some) const;
  };
  static constexpr std::size_t kMaxLooks = 128;
  static constexpr std::size_t kMaxBytes = 6'000'000;  ///< of looks
  static constexpr double kFirstStep = 0.25;           ///< s

  void run_begins() override;
  void hear(const record::AlertReport& alert) override;
  void after_input();
  [[nodiscard]] Look look() const;
  [[nodiscard]] ReplayOptions heard(ReplayOptions options);

  AlertSink& alerts_;
  PageReplay replay_;
  Looks even_;
  double step_ = kFirstStep;
  Looks stops_;
  std::uint64_t stop_count_ = 0;
  std::uint64_t stop_stride_ = 1;
  bool stop_begins_ = false;
  std::set<std::uint32_t> stopped_;  ///< objects whose last alert is a stop
};

}  // namespace fencepost::host
