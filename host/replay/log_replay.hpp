// One log through a runner, in any portions: `replay()` gives it all at once, the page of host/web a little at a time.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/stream_reader.hpp"
#include "host/replay/check.hpp"
#include "host/replay/complaints.hpp"
#include "host/replay/kept_path.hpp"
#include "host/replay/own_log.hpp"
#include "host/replay/replay.hpp"
#include "host/replay/runner.hpp"

namespace fencepost::host {

class LogReplay {
 public:
  /// `options` must outlive this.
  explicit LogReplay(const ReplayOptions& options);
  LogReplay(const LogReplay&) = delete;
  LogReplay& operator=(const LogReplay&) = delete;
  ~LogReplay() = default;

  /// The outcome of a line at its end, nothing within a line.
  std::optional<record::LineOutcome> push(char byte) {
    std::string_view bytes(&byte, 1);
    return take(bytes);
  }
  /// Takes one line off the front of `bytes`, or all of them if none ends there.
  std::optional<record::LineOutcome> take(std::string_view& bytes);
  /// Later bytes are not used: there are frames enough, the requested run is over, or the stream has another format.
  [[nodiscard]] bool ended() const { return complete_ || reader_.other_format().has_value(); }
  /// The stream has ended: an unfinished line and the frames that still wait are counted. At most once, at the end.
  /// What became of that line, if there is one.
  std::optional<record::LineOutcome> finish();

  /// The results so far; `path` only on request, since it is long.
  [[nodiscard]] ResultDocument now(bool with_path = true) const;
  [[nodiscard]] const CheckOutcome& check() const { return check_.outcome(); }
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_.all(); }
  /// Why none of it could be used, if so; `name` of the log in the message. After `finish`.
  [[nodiscard]] std::optional<Unreadable> why_unreadable(const std::string& name) const;

  /// Poses of this run: every sample, or with `options.most_poses` the first and every n-th.
  [[nodiscard]] const std::vector<PoseResult>& path() const { return path_.poses(); }
  /// Number of all samples of this run.
  [[nodiscard]] std::uint64_t path_count() const { return path_.count(); }
  /// The time of the latest input of this run, s.
  [[nodiscard]] double time() const { return time_; }
  /// How many have begun.
  [[nodiscard]] std::uint32_t runs() const { return runs_; }
  /// In force; nothing before the first run.
  [[nodiscard]] const config::Settings* settings() const { return runner_ ? &runner_->settings() : nullptr; }
  [[nodiscard]] const std::optional<sensor::CameraIntrinsics>& camera() const { return camera_; }

  // The sink of the reader.
  void accept(const record::Header& header);
  void accept(const sensor::CameraIntrinsics& camera);
  void accept(const record::Signature& signature);
  void accept(const record::Setting& setting);
  void accept(const sensor::OdometrySample& sample);
  void accept(const sensor::CarSample& sample);
  void accept(const sensor::BlobFrame& frame);
  void accept(const record::Heartbeat& beat);
  void accept(const record::ObjectReport& report) { compare(report); }
  void accept(const record::AlertReport& report) { compare(report); }
  void accept(const record::DigestReport& report) { compare(report); }
  void accept(const record::SpeedLimit& report) { compare(report); }
  void accept(const record::CalibrationDoubt& report) { compare(report); }
  template <class Record>
  void accept(const Record&) {}

 private:
  void drove_to(const sensor::OdometrySample& sample);
  /// False: it is not asked for.
  bool pass_to(base::Time t);
  template <class Record>
  void compare(const Record& record) {
    if (options_.check) check_.logged(record, reader_.line_number() + 1);
  }
  template <class Record>
  void hear(const Record& record) {
    if (options_.check) check_.own(record);
  }
  Runner& runner();
  void begin_run(const record::Header& logged);
  void end_run();
  void hear_alert(const record::AlertReport& alert);
  void hear_doubt(const record::CalibrationDoubt& doubt);
  void fill_counts(LogCounts& log) const;

  const ReplayOptions& options_;
  OwnLog own_log_;
  Check check_;
  std::array<char, Check::kStart> start_{};  ///< of the line that is read, for the check
  std::size_t started_ = 0;
  std::ptrdiff_t returns_ = 0;  ///< CRs in the first line
  Complaints complaints_;
  std::unique_ptr<Runner> runner_;
  std::string profile_;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
  KeptPath path_;
  sensor::OdometrySample last_;  ///< of the path
  std::vector<record::AlertReport> alerts_;
  std::vector<record::CalibrationDoubt> calibration_;
  std::vector<record::Signature> signatures_;
  std::optional<sensor::CameraIntrinsics> camera_;
  LogCounts before_;  ///< of runs that have ended: the frames that they refused
  double time_ = 0;
  std::uint32_t runs_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t frames_taken_ = 0;
  std::uint64_t odometry_ = 0;
  std::uint64_t used_ = 0;
  bool headed_ = false;  ///< an FPHDR has come
  bool over_ = false;    ///< the last run has ended
  bool complete_ = false;
};

}  // namespace fencepost::host
