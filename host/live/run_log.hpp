// The log of a run on disk, in one file or in parts.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "host/live/calibration_lines.hpp"
#include "host/live/log_file.hpp"
#include "host/live/write_behind.hpp"

namespace fencepost::host {

struct RunLogSettings {
  std::string path;
  bool overwrite = false;
  std::uint64_t part_bytes = 0;  ///< 0: no limit
  base::Duration part_age{};     ///< 0: no limit
  std::string profile;           ///< named at the start of later parts, which have no FPHDR
};

/// Later parts begin with a comment and the calibration in force, but without FPHDR: the run goes on. So all parts, one
/// after the other, are one log with the run's digest, and each alone is a recording that begins late.
class RunLog final : public Sink {
 public:
  /// errors: a sentence
  static linux::Opened<RunLog> open(const RunLogSettings& settings, base::Time now);

  [[nodiscard]] Fault write(std::string_view lines, base::Time now) override;
  [[nodiscard]] Fault tend(base::Time now) override { return file_.tend(now); }
  [[nodiscard]] Fault close() override { return file_.close(); }
  /// "run.log", or "run.log to run-0003.log".
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::uint64_t bytes() const override { return file_.bytes(); }

 private:
  RunLog(std::unique_ptr<CalibrationLines> calibration, LogFile file, std::string first, bool parts)
      : calibration_(std::move(calibration)), file_(std::move(file)), first_(std::move(first)), parts_(parts) {}

  std::unique_ptr<CalibrationLines> calibration_;  ///< the file keeps its address
  LogFile file_;
  std::string first_;
  bool parts_;  ///< there may be more than one
};

}  // namespace fencepost::host
