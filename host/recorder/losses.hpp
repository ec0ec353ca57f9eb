// Losses that a recording reveals.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "firmware/record/records.hpp"

namespace fencepost::host {

/// Losses that a robot reports in FPSTA, since its boot.
struct ReportedLosses {
  std::uint64_t records_dropped = 0;
  std::uint64_t blobs_dropped = 0;
  std::uint64_t refused = 0;   ///< frames
  std::uint64_t rejected = 0;  ///< lines that came to the robot
  friend constexpr bool operator==(const ReportedLosses&, const ReportedLosses&) = default;
};

/// Takes the records of a live stream (record::RecordSink).
class Losses {
 public:
  void accept(const record::Header& header);
  void accept(const sensor::BlobFrame& frame);
  void accept(const record::StatusReport& status);
  void accept(const record::LinkReport& link);
  template <class Record>
  void accept(const Record& /*record*/) {}

  /// Frame numbers that were passed over within a run.
  [[nodiscard]] std::uint64_t frames_missing() const { return frames_missing_; }
  /// Since the first FPSTA; a robot that boots again counts from zero.
  [[nodiscard]] const ReportedLosses& reported() const { return reported_; }
  /// The state last reported by each device, of the first 64.
  [[nodiscard]] const std::map<std::string, record::LinkReport>& links() const { return links_; }

 private:
  std::optional<std::uint32_t> last_frame_;
  std::uint64_t frames_missing_ = 0;
  std::optional<record::StatusReport> last_status_;
  ReportedLosses reported_;
  std::map<std::string, record::LinkReport> links_;
};

}  // namespace fencepost::host
