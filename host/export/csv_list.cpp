#include "host/export/csv_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "firmware/console/text.hpp"
#include "host/result/lookup.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::exports {
namespace {

/// Text for a cell of RFC 4180 that is JSON, too. AdvantageScope parts rows at each comma and parses values as JSON.
std::string plain(std::string_view text) {
  std::string plain = printable(text);
  std::ranges::replace(plain, ',', ';');
  std::ranges::replace(plain, '"', '\'');
  std::ranges::replace(plain, '\\', '/');
  return plain;
}

class Table {
 public:
  void add(double t, std::string_view key, std::string_view text) { row(t, key, "\"" + plain(text) + "\""); }
  void add(double t, std::string_view key, double value) { row(t, key, fmt::format("{:.4f}", value + 0.0)); }
  void add(double t, std::string_view key, std::uint64_t value) { row(t, key, std::to_string(value)); }

  std::string take() { return std::move(text_); }

 private:
  void row(double t, std::string_view key, const std::string& value) {
    text_ += fmt::format("{:.4f},{},{}\n", t, plain(key), value);
  }

  std::string text_ = "Timestamp,Key,Value\n";
};

void add_object(Table& table, const ResultDocument& document, const ObjectAt& at) {
  const ObjectResult& object = at.object;
  const std::string key = "objects/" + title_of(document, object) + "/";
  if (const Circle* circle = object_circle(object)) {
    table.add(at.t, key + "x", circle->center.x);
    table.add(at.t, key + "y", circle->center.y);
    table.add(at.t, key + "radius", circle->radius);
  }
  table.add(at.t, key + "views", std::uint64_t{object.views});
  table.add(at.t, key + "confidence", object.confidence);
  table.add(at.t, key + "state", record::name(object.state));
}

void add_alert(Table& table, const ResultDocument& document, const record::AlertReport& alert) {
  const double t = alert.t.to_double();
  const record::Signature* known = find_signature(document, alert.signature);
  std::array<char, console::kMaxSentence> sentence{};
  const std::size_t size =
      console::describe(alert, known != nullptr ? known->name.view() : std::string_view(), sentence);
  table.add(t, "alerts/level", record::name(alert.level));
  table.add(t, "alerts/text", std::string_view(sentence.data(), size < 2 ? 0 : size - 2));
  if (!alert.has_place()) return;
  table.add(t, "alerts/distance", alert.distance.to_double());
  table.add(t, "alerts/bearing", alert.bearing.to_double());
}

void add_pose(Table& table, const PoseResult& pose) {
  table.add(pose.t, "robot/x", pose.x);
  table.add(pose.t, "robot/y", pose.y);
  table.add(pose.t, "robot/heading", pose.heading);
}

enum class What : std::uint8_t { kPose, kFrame, kObject, kAlert };

/// One item with its time; rows are written in order of time.
struct Entry {
  double t;
  What what;
  std::size_t index;
};

}  // namespace

std::string csv_of(const Run& run) {
  const std::vector<PoseResult>& path = run.document.path;
  const std::vector<record::AlertReport>& alerts = run.document.alerts;
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < path.size(); ++i) entries.push_back({path[i].t, What::kPose, i});
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    entries.push_back({run.frames[i].t.to_double(), What::kFrame, i});
  }
  for (std::size_t i = 0; i < run.history.size(); ++i) entries.push_back({run.history[i].t, What::kObject, i});
  for (std::size_t i = 0; i < alerts.size(); ++i) entries.push_back({alerts[i].t.to_double(), What::kAlert, i});
  std::ranges::stable_sort(entries, {}, &Entry::t);
  Table table;
  for (const auto& [t, what, i] : entries) {
    if (what == What::kPose) add_pose(table, path[i]);
    if (what == What::kFrame) table.add(t, "camera/blobs", std::uint64_t{run.frames[i].blobs.size()});
    if (what == What::kObject) add_object(table, run.document, run.history[i]);
    if (what == What::kAlert) add_alert(table, run.document, alerts[i]);
  }
  return table.take();
}

}  // namespace fencepost::host::exports
