// Does a log's own FPOBJ, FPALR, FPALV, FPSPD, FPCAL and FPDIG agree with what a replay of its inputs gives?
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>

#include "firmware/record/encode.hpp"
#include "firmware/record/line_reader.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host {

/// Records are compared as lines, by kind, time (or frame) and object. Records that a busy robot dropped may be
/// missing; those it wrote must equal ours. Either may come first, but no more than kWindow others of ours between
/// them: a log is compared as it is read.
class Check {
 public:
  static constexpr std::size_t kWindow = 1U << 14U;  ///< some minutes of everything that a robot says; 4 MB

  template <class Record>
  void logged(const Record& record, std::uint64_t line_number) {
    take_logged({key_of(record), line_of(record), line_number, told_});
  }
  template <class Record>
  void own(const Record& record) {
    take_own(key_of(record), line_of(record));
  }

  /// A line that is no readable record, with its first characters. It counts as damaged if it may have been one of the
  /// compared records.
  void unread(std::string_view start, const record::LineOutcome& line);
  static constexpr std::size_t kStart = 7;  ///< characters of a line that it looks at: "$FPALR,"

  /// Compares the rest of this run, and forgets the run.
  void settle();
  /// Drops the comparison: the run had begun before the log, so the robot knew more.
  void withdraw();
  [[nodiscard]] const CheckOutcome& outcome() const { return outcome_; }

 private:
  struct Logged {
    std::string key;
    std::string line;
    std::uint64_t line_number;
    std::uint64_t told;  ///< our own records up to then
  };

  void take_logged(Logged logged);
  void take_own(std::string key, std::string line);
  [[nodiscard]] bool agrees(const Logged& logged) const;
  void settle_first();

  static std::string key_of(const record::AlertReport& r) {
    return "alert " + std::to_string(r.t.raw) + " " + std::to_string(r.id);
  }
  static std::string key_of(const record::ObjectReport& r) {
    return "object " + std::to_string(r.t.raw) + " " + std::to_string(r.id);
  }
  static std::string key_of(const record::Heartbeat& r) { return "heartbeat " + std::to_string(r.t.raw); }
  static std::string key_of(const record::SpeedLimit& r) { return "speed " + std::to_string(r.t.raw); }
  static std::string key_of(const record::CalibrationDoubt& r) { return "doubt " + std::to_string(r.t.raw); }
  static std::string key_of(const record::DigestReport& r) { return "digest " + std::to_string(r.frame); }

  template <class Record>
  static std::string line_of(const Record& record) {
    std::array<char, record::kMaxLine> buffer{};
    const std::size_t size = record::encode(record, buffer);
    return {buffer.data(), size < 2 ? 0 : size - 2};
  }

  using Own = std::multimap<std::string, std::string>;

  std::deque<Logged> waiting_;  ///< for one of ours
  Own own_;
  std::deque<Own::iterator> own_in_order_;
  std::uint64_t told_ = 0;
  CheckOutcome outcome_;
};

}  // namespace fencepost::host
