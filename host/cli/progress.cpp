#include "host/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

#include "host/cli/interrupt.hpp"
#include "host/cli/terminal.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::cli {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kQuiet{1};  ///< shorter work shows no progress
constexpr Seconds kBetween{0.1};
constexpr Seconds kQuietLines{10};
constexpr Seconds kBetweenLines{60};
constexpr std::size_t kWidth = 79;
constexpr double kMinShare = 0.01;  ///< a smaller share is no basis for the remaining time
constexpr std::string_view kErase = "\r\x1b[K";

std::atomic<Progress*> latest = nullptr;

void write_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

bool is_redrawn() { return is_terminal(STDERR_FILENO) && can_redraw(); }

Progress::Write writer(OffTerminal elsewhere) {
  if (!is_redrawn() && elsewhere == OffTerminal::kSilent) return {};
  return write_to_stderr;
}

Seconds steady() { return std::chrono::steady_clock::now().time_since_epoch(); }

}  // namespace

std::string time_words(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 3600;
  const auto whole = [](double value) { return static_cast<std::uint64_t>(std::llround(std::max(0.0, value))); };
  if (seconds < kMinute - 0.5) return fmt::format("{} s", whole(seconds));
  if (seconds < 10 * kMinute - 5) {
    const std::uint64_t tens = whole(seconds / 10);
    return tens % 6 == 0 ? fmt::format("{} min", tens / 6) : fmt::format("{} min {} s", tens / 6, 10 * (tens % 6));
  }
  const std::uint64_t minutes = whole(seconds / kMinute);
  if (seconds < kHour - kMinute / 2) return fmt::format("{} min", minutes);
  return minutes % 60 == 0 ? fmt::format("{} h", minutes / 60) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

Progress::Progress(std::string what, OffTerminal elsewhere)
    : Progress(std::move(what), steady, writer(elsewhere), !is_redrawn()) {}

Progress::Progress(std::string what, Clock clock, Write write, bool lines)
    : what_(std::move(what)), clock_(std::move(clock)), write_(std::move(write)), lines_(lines), begin_(clock_()) {
  if (write_) latest = this;
}

Progress::~Progress() {
  Progress* mine = this;
  latest.compare_exchange_strong(mine, nullptr);
  hide();
}

void Progress::at(double done, double all, std::string_view detail) {
  if (!write_) return;
  const std::lock_guard lock(mutex_);
  const Seconds now = clock_();
  if (now - begin_ < (lines_ ? kQuietLines : kQuiet)) return;
  if (shown_at_ && now - *shown_at_ < (lines_ ? kBetweenLines : kBetween)) return;
  shown_at_ = now;
  const std::string text = line(done, all, detail, (now - begin_).count());
  if (lines_) return write_(text + "\n");
  if (text == shown_) return;
  shown_ = text;
  note_progress_line(true);
  write_(std::string(kErase) + text);
}

std::string Progress::line(double done, double all, std::string_view detail, double seconds) const {
  std::string text = what_;
  const auto add = [&](const std::string& part) { text += (text.size() == what_.size() ? ": " : ", ") + part; };
  if (!detail.empty()) add(printable(detail));
  const double share = all > 0 ? std::clamp(done / all, 0.0, 1.0) : 0;
  if (all > 0) add(fmt::format("{} %", static_cast<int>(100 * share)));
  if (share >= kMinShare) add(time_words(seconds * (1 - share) / share) + " left");
  if (!(all > 0)) add(time_words(seconds));
  return text.substr(0, kWidth);
}

void Progress::hide() {
  const std::lock_guard lock(mutex_);
  if (shown_.empty()) return;
  shown_.clear();
  write_(kErase);
  note_progress_line(false);
}

void hide_progress() {
  if (Progress* shown = latest) shown->hide();
}

}  // namespace fencepost::host::cli
