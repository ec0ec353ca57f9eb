// Does a log's own FPOBJ, FPALR, FPALV, FPCAL and FPDIG agree with what a replay of its inputs gives?
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "firmware/record/encode.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host {

/// Records are compared as lines, by kind, time (or frame) and object. Records that a busy robot dropped may be
/// missing; those it wrote must equal ours.
class Check {
 public:
  template <class Record>
  void logged(const Record& record, std::uint64_t line_number) {
    logged_.push_back({key_of(record), line_of(record), line_number});
  }
  template <class Record>
  void own(const Record& record) {
    own_.emplace(key_of(record), line_of(record));
  }

  /// Compares the records of this run, adds to `outcome`, and clears them.
  void settle(CheckOutcome& outcome);

 private:
  struct Logged {
    std::string key;
    std::string line;
    std::uint64_t line_number;
  };

  static std::string key_of(const record::AlertReport& r) {
    return "alert " + std::to_string(r.t.raw) + " " + std::to_string(r.id);
  }
  static std::string key_of(const record::ObjectReport& r) {
    return "object " + std::to_string(r.t.raw) + " " + std::to_string(r.id);
  }
  static std::string key_of(const record::Heartbeat& r) { return "heartbeat " + std::to_string(r.t.raw); }
  static std::string key_of(const record::CalibrationDoubt& r) { return "doubt " + std::to_string(r.t.raw); }
  static std::string key_of(const record::DigestReport& r) { return "digest " + std::to_string(r.frame); }

  template <class Record>
  static std::string line_of(const Record& record) {
    std::array<char, record::kMaxLine> buffer{};
    const std::size_t size = record::encode(record, buffer);
    return {buffer.data(), size < 2 ? 0 : size - 2};
  }

  std::vector<Logged> logged_;
  std::multimap<std::string, std::string> own_;
};

}  // namespace fencepost::host
