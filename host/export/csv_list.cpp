#include "host/export/csv_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "firmware/console/text.hpp"
#include "host/result/lookup.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::exports {
namespace {

struct Row {
  double t;
  std::string line;
};

/// RFC 4180.
std::string cell(std::string_view text) {
  const std::string plain = printable(text);
  if (plain.find_first_of(",\"\r\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

class Table {
 public:
  void add(double t, std::string_view key, std::string_view value) {
    rows_.push_back({t, fmt::format("{:.4f},{},{}\n", t, cell(key), cell(value))});
  }
  void add(double t, std::string_view key, double value) { add(t, key, fmt::format("{:.4f}", value + 0.0)); }
  void add(double t, std::string_view key, std::uint64_t value) { add(t, key, std::to_string(value)); }

  std::string text() {
    std::ranges::stable_sort(rows_, {}, &Row::t);
    std::string all = "Timestamp,Key,Value\n";
    for (const Row& row : rows_) all += row.line;
    return all;
  }

 private:
  std::vector<Row> rows_;
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

}  // namespace

std::string csv_of(const Run& run) {
  Table table;
  for (const PoseResult& pose : run.document.path) {
    table.add(pose.t, "robot/x", pose.x);
    table.add(pose.t, "robot/y", pose.y);
    table.add(pose.t, "robot/heading", pose.heading);
  }
  for (const sensor::BlobFrame& frame : run.frames) {
    table.add(frame.t.to_double(), "camera/blobs", std::uint64_t{frame.blobs.size()});
  }
  for (const ObjectAt& at : run.history) add_object(table, run.document, at);
  for (const record::AlertReport& alert : run.document.alerts) add_alert(table, run.document, alert);
  return table.text();
}

}  // namespace fencepost::host::exports
