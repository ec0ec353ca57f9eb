// Counts records while they are recorded, with the same reader as replay.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/record/stream_reader.hpp"
#include "host/recorder/losses.hpp"

namespace fencepost::host {

struct Rates {
  double lines = 0;  ///< a second
  double bytes = 0;  ///< a second
};

class Tally {
 public:
  explicit Tally(base::Time now) : start_(now), measured_at_(now), last_line_(now) {}
  Tally(const Tally&) = delete;
  Tally& operator=(const Tally&) = delete;

  void take(std::string_view bytes, base::Time now);
  /// The stream has ended, perhaps within a line.
  void finish();

  /// Rates since the last call.
  void measure(base::Time now);

  /// As measured last.
  [[nodiscard]] const Rates& rates() const { return rates_; }
  [[nodiscard]] base::Time start() const { return start_; }
  /// When the last line ended; at first the start.
  [[nodiscard]] base::Time last_line() const { return last_line_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint32_t lines() const { return reader_.line_number(); }
  [[nodiscard]] const record::Counts& counts() const { return reader_.counts(); }
  [[nodiscard]] const Losses& losses() const { return losses_; }

 private:
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
  Losses losses_;
  base::Time start_;
  base::Time measured_at_;
  base::Time last_line_;
  std::uint64_t bytes_ = 0;
  std::uint64_t bytes_measured_ = 0;
  std::uint32_t lines_measured_ = 0;
  Rates rates_;
};

}  // namespace fencepost::host
