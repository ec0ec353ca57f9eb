// A run that goes on while its log is made: the log, and the loop that it is fed to.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/encode.hpp"
#include "host/replay/replay.hpp"
#include "host/web/page_replay.hpp"

namespace fencepost::host {

class LiveLog final : private AlertSink {
 public:
  static constexpr double kLongest = 3600;  ///< s of a run; the map needs no such limit, the log's size does

  LiveLog();
  LiveLog(const LiveLog&) = delete;
  LiveLog& operator=(const LiveLog&) = delete;

  /// The next line of the log, its end included.
  void add(std::string_view line);
  /// False: a value is outside the range of its record, and nothing was written.
  template <class Record>
  bool write(const Record& record) {
    std::array<char, record::kMaxLine> line{};
    const std::size_t length = record::encode(record, line);
    if (length > 0) add({line.data(), length});
    return length > 0;
  }
  /// The log has ended: frames that still wait are counted.
  void finish() { page_.finish(); }

  [[nodiscard]] const PageReplay& page() const { return page_; }
  /// All records so far.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// The result document of now, without path, with the alerts since the last call alone, and the models that alerts go
  /// by.
  [[nodiscard]] std::string state();
  /// A STOP is in force.
  [[nodiscard]] bool stopped() const;

 private:
  void run_begins() override {}
  void hear(const record::AlertReport& alert) override;

  std::string text_;
  std::vector<record::AlertReport> in_force_;  ///< the latest of each object
  std::vector<record::AlertReport> fresh_;
  PageReplay page_;
};

}  // namespace fencepost::host
