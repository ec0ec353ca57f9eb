// One log behind the page: LogReplay, and what the page shows beside the result document.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/replay/log_replay.hpp"

namespace fencepost::host {

class PageReplay final : private RunObserver {
 public:
  /// `profile`: micro, small, full; empty: the log's.
  explicit PageReplay(std::string_view profile) : PageReplay(of_profile(profile)) {}
  /// `options`: of the map and of the data to keep; the observer is this.
  explicit PageReplay(ReplayOptions options) : options_(observed(std::move(options))) {}
  PageReplay(const PageReplay&) = delete;
  PageReplay& operator=(const PageReplay&) = delete;

  /// Up to the first input at or after `until` (s of this run), or up to the next run. How many bytes were used.
  std::size_t feed(std::string_view bytes, double until);
  void finish();

  [[nodiscard]] const LogReplay& log() const { return log_; }
  /// The result document, as `fencepost replay --json` writes it.
  [[nodiscard]] std::string result() const;
  /// The same without the path, which the page reads from memory; `with_alerts`: those of the run so far, which are
  /// many in a long one.
  [[nodiscard]] std::string state(bool with_alerts) const;
  /// Data that the result document lacks: the latest frame with the objects that took its boxes, and settings in force.
  /// Also bad lines, complaints, and how far the robot's own log agrees.
  [[nodiscard]] std::string page() const;

 private:
  struct Boxes {
    recon::WaitingFrame frame;
    double exposure = 0;             ///< s
    std::vector<std::uint32_t> ids;  ///< by blob; record::kNoObject: of none
  };
  struct BadLine {
    std::uint32_t number = 0;
    record::Reject reason{};
  };
  static constexpr std::size_t kBadLines = 100;  ///< listed, of any number counted

  void note(const std::optional<record::LineOutcome>& line);
  void run_begins() override { boxes_.reset(); }
  void frame_placed(const PlacedFrame& placed) override;
  static ReplayOptions of_profile(std::string_view profile);
  ReplayOptions observed(ReplayOptions options);

  ReplayOptions options_;
  LogReplay log_{options_};
  std::optional<Boxes> boxes_;
  std::vector<BadLine> bad_lines_;
  bool finished_ = false;
};

}  // namespace fencepost::host
