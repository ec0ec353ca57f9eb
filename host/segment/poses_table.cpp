#include "host/segment/poses_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>

#include "host/import/text_lines.hpp"
#include "host/segment/problem.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {

namespace {

constexpr const char* kHeader = "image,t,x,y,heading";
constexpr double kLargest = 1000;        // m and rad, the stream's ranges
constexpr double kLatest = 999'999;      // s, likewise
constexpr double kTick = 1e-4;           // s, likewise
constexpr double kMadeUpInterval = 0.1;  // s

enum Column : std::size_t { kImage, kX, kY, kHeading, kTime, kColumns };
constexpr std::array<std::string_view, kColumns> kNames = {"image", "x", "y", "heading", "t"};

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    fields.push_back(trimmed_text(line.substr(start, end - start)));
    start = end + 1;
  }
  return fields;
}

/// The index of each column in the header.
class Header {
 public:
  Header(std::string_view line, const std::string& place, PosesTable& table) {
    const std::vector<std::string_view> fields = fields_of(line);
    width_ = fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto* known = std::find(kNames.begin(), kNames.end(), fields[i]);
      if (known == kNames.end()) {
        table.unused_columns.push_back(host::quoted(fields[i]));
        continue;
      }
      auto& at = at_[static_cast<std::size_t>(known - kNames.begin())];
      if (at) throw SegmentProblem{place, "has two columns " + host::quoted(fields[i]), "take one out"};
      at = i;
    }
    for (const Column column : {kImage, kX, kY, kHeading}) {
      if (!at_[column]) {
        throw SegmentProblem{place, "has no column " + host::quoted(kNames[column]),
                             std::string("write as the first line: ") + kHeader};
      }
    }
  }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] bool has_time() const { return at_[kTime].has_value(); }
  [[nodiscard]] std::string_view text(const std::vector<std::string_view>& fields, Column column) const {
    return fields[*at_[column]];
  }
  [[nodiscard]] double number(const std::vector<std::string_view>& fields, Column column,
                              const std::string& place) const {
    const std::string_view field = text(fields, column);
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
      throw SegmentProblem{place, std::string(kNames[column]) + " is " + host::quoted(field) + ", not a number",
                           "correct the line or take it out"};
    }
    if (column != kTime && std::abs(value) > kLargest) {
      throw SegmentProblem{place, std::string(kNames[column]) + " is beyond +-1000",
                           "write metres and radians, from an origin near by"};
    }
    return value;
  }

 private:
  std::array<std::optional<std::size_t>, kColumns> at_;
  std::size_t width_ = 0;
};

ImagePose to_row(std::string_view line, const Header& header, std::size_t number, const std::string& place) {
  const std::vector<std::string_view> fields = fields_of(line);
  if (fields.size() != header.width()) {
    throw SegmentProblem{place,
                         "has " + plural(fields.size(), "column") + " instead of " + std::to_string(header.width()),
                         "correct the line; names of images cannot hold commas"};
  }
  ImagePose row;
  row.line = number;
  row.image = header.text(fields, kImage);
  if (row.image.empty()) throw SegmentProblem{place, "names no image", "write its file name, or take the line out"};
  row.pose = {header.has_time() ? header.number(fields, kTime, place) : 0, header.number(fields, kX, place),
              header.number(fields, kY, place), header.number(fields, kHeading, place)};
  return row;
}

}  // namespace

void settle_times(PosesTable& table, bool has_time) {
  table.made_up_times = !has_time;
  if (!has_time) {
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      table.rows[i].pose.t = kMadeUpInterval * static_cast<double>(i);
    }
    return;
  }
  const double first = table.rows.front().pose.t;
  table.shifted_times = first < 0 || first > kLatest || table.rows.back().pose.t > kLatest;
  std::int64_t previous = -1;  // in the stream's ticks
  for (ImagePose& row : table.rows) {
    if (table.shifted_times) row.pose.t -= first;
    if (row.pose.t > kLatest) {
      throw SegmentProblem{table.place(row), "t is more than 999999 s after the first", "write t in seconds"};
    }
    const std::int64_t tick = row.pose.t < 0 ? -1 : std::llround(row.pose.t / kTick);
    if (tick <= previous) {
      throw SegmentProblem{table.place(row), "t is not later than the line before", "sort the lines by t, in seconds"};
    }
    previous = tick;
  }
}

PosesTable parse_poses(std::string_view text, const std::string& file) {
  PosesTable table;
  table.file = file;
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);  // byte order mark of spreadsheets
  std::optional<Header> header;
  std::set<std::string, std::less<>> seen;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed_text(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::string place = file + ":" + std::to_string(number);
    if (!header) {
      header.emplace(line, place, table);
      continue;
    }
    table.rows.push_back(to_row(line, *header, number, place));
    if (!seen.insert(table.rows.back().image).second) {
      throw SegmentProblem{place, host::quoted(table.rows.back().image) + " is there twice",
                           "take one of the lines out"};
    }
  }
  if (table.rows.empty()) {
    throw SegmentProblem{file, header ? "has a header but no rows" : "is empty",
                         std::string("write a line for each image: ") + kHeader};
  }
  settle_times(table, header->has_time());
  return table;
}

}  // namespace fencepost::host
