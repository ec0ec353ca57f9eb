#include "host/recorder/status_text.hpp"

#include <fmt/format.h>

#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

// A robot in mode log says something every second.
constexpr base::Duration kSilence = base::milliseconds(2000);

std::string clock_text(base::Duration duration) {
  const std::int64_t seconds = duration.raw / base::Duration::kPerUnit;
  if (seconds < 3600) return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

void add(std::string& list, std::string_view name, std::uint64_t count) {
  if (count > 0) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", name, count);
}

std::string rejects(const record::Counts& counts) {
  std::string list;
  for (std::size_t i = 0; i < record::kRejectReasons; ++i) {
    add(list, name(static_cast<record::Reject>(i)), counts.rejects[i].lines);
  }
  return list;
}

std::string list_of(const ReportedLosses& losses) {
  std::string list;
  add(list, "records_dropped", losses.records_dropped);
  add(list, "blobs_dropped", losses.blobs_dropped);
  add(list, "refused", losses.refused);
  add(list, "rejected", losses.rejected);
  return list;
}

std::string reported_in_short(const ReportedLosses& losses) {
  std::string list;
  add(list, "records", losses.records_dropped);
  add(list, "blobs", losses.blobs_dropped);
  add(list, "frames", losses.refused);
  add(list, "lines", losses.rejected);
  return list;
}

void add_link(std::string& list, const std::string& link) { list += (list.empty() ? "" : ", ") + link; }

std::string links_not_ok(const Losses& losses) {
  std::string list;
  for (const auto& [device, link] : losses.links()) {
    if (link.state != sensor::LinkState::kOk) add_link(list, fmt::format("{} {}", device, name(link.state)));
  }
  return list;
}

std::string all_links(const Losses& losses) {
  std::string list;
  for (const auto& [device, link] : losses.links()) {
    const std::string detail(link.detail.view());
    add_link(list, fmt::format("{} {}{}", device, name(link.state), detail.empty() ? "" : " (" + detail + ")"));
  }
  return list;
}

std::vector<std::string> items(const Tally& tally, base::Time now, bool connected) {
  std::vector<std::string> all = {
      clock_text(now - tally.start()),
      fmt::format("{:.0f} lines/s", tally.rates().lines),
      in_bytes(tally.rates().bytes) + "/s",
      plural(tally.counts().records_of(record::Kind::kFrame), "frame"),
  };
  const auto add_item = [&all](std::string_view what, const std::string& text) {
    if (!text.empty()) all.push_back(fmt::format("{}{}", what, text));
  };
  const base::Duration silence = now - tally.last_line();
  if (!connected) all.emplace_back("unplugged");
  if (silence >= kSilence) add_item("silent ", clock_text(silence));
  add_item("", links_not_ok(tally.losses()));
  if (tally.losses().frames_missing() > 0) all.push_back(fmt::format("{} missing", tally.losses().frames_missing()));
  add_item("bad: ", rejects(tally.counts()));
  add_item("lost: ", reported_in_short(tally.losses().reported()));
  if (tally.counts().foreign > 0) all.push_back(fmt::format("{} foreign", tally.counts().foreign));
  return all;
}

}  // namespace

std::string in_bytes(double bytes) {
  if (bytes < 999.5) return fmt::format("{:.0f} B", bytes);
  if (bytes < 999'950) return fmt::format("{:.1f} kB", bytes / 1e3);
  if (bytes < 999.95e6) return fmt::format("{:.1f} MB", bytes / 1e6);
  return fmt::format("{:.2f} GB", bytes / 1e9);
}

std::string status_line(const Tally& tally, base::Time now, bool connected, std::size_t width) {
  constexpr std::string_view kGap = "  ";
  constexpr std::string_view kMore = " ..";
  std::string line;
  const std::vector<std::string> all = items(tally, now, connected);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string longer = line + std::string(line.empty() ? "" : kGap) + all[i];
    const std::size_t spare = i + 1 < all.size() ? kMore.size() : 0;
    if (longer.size() + spare > width) return (line + std::string(kMore)).substr(0, width);
    line = longer;
  }
  return line;
}

std::vector<std::string> summary(const Tally& tally, base::Time now) {
  const record::Counts& counts = tally.counts();
  std::vector<std::string> lines = {
      fmt::format("{:.1f} s: {}, {}", (now - tally.start()).to_double(), plural(tally.lines(), "line"),
                  in_bytes(static_cast<double>(tally.bytes()))),
      fmt::format("{}: {}, {} of odometry; {}", plural(counts.records, "record"),
                  plural(counts.records_of(record::Kind::kFrame), "frame"), counts.records_of(record::Kind::kOdometry),
                  plural(counts.foreign, "foreign line")),
  };
  const auto add_line = [&lines](std::string_view what, const std::string& text) {
    if (!text.empty()) lines.push_back(fmt::format("{}{}", what, text));
  };
  add_line("rejected lines: ", rejects(counts));
  if (tally.losses().frames_missing() > 0) {
    lines.push_back(fmt::format("missing by their numbers: {}", plural(tally.losses().frames_missing(), "frame")));
  }
  add_line("losses reported by the robot: ", list_of(tally.losses().reported()));
  add_line("links at the end: ", all_links(tally.losses()));
  return lines;
}

}  // namespace fencepost::host
