#include "host/import/csv/columns.hpp"

#include <algorithm>

#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

bool is_data(std::string_view line) {
  line = trimmed_text(line);
  return !line.empty() && line.front() != '#';
}

std::string_view unquoted(std::string_view field) {
  field = trimmed_text(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') return field.substr(1, field.size() - 2);
  return field;
}

}  // namespace

double CsvRow::number(std::size_t column) const {
  const std::optional<double> value = number_in(fields_[column]);
  if (value) return *value;
  throw ImportProblem{place_, quoted(fields_[column]) + " is not a number", "correct the line or take it out"};
}

CsvReader::CsvReader(std::string_view text, std::string file) : file_(std::move(file)), lines_(lines_of(text)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets write one
  if (!lines_.empty() && lines_[0].starts_with(kByteOrderMark)) lines_[0].remove_prefix(kByteOrderMark.size());
  const auto header = std::ranges::find_if(lines_, is_data);
  if (header == lines_.end()) throw ImportProblem{file_, "has no rows", "check that the copy is complete"};
  header_line_ = static_cast<std::size_t>(header - lines_.begin());
  for (const char other : {';', '\t'}) {
    if (header->find(',') == std::string_view::npos && header->find(other) != std::string_view::npos)
      separator_ = other;
  }
  for (const std::string_view name : fields(*header)) {
    names_.push_back(lower(name));
    const auto first = std::ranges::find(names_, names_.back());
    if (!name.empty() && &*first != &names_.back()) refuse_both(names_.size() - 1, names_.size() - 1);
  }
}

void CsvReader::refuse_both(std::size_t first, std::size_t second) const {
  throw ImportProblem{file_ + ":" + std::to_string(header_line_ + 1),
                      "has columns " + quoted(std::string_view(names_[first])) + " and " +
                          quoted(std::string_view(names_[second])) + " for one thing",
                      "rename the one that is not meant"};
}

std::vector<std::string_view> CsvReader::fields(std::string_view line) const {
  std::vector<std::string_view> list;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(separator_, start), line.size());
    list.push_back(unquoted(line.substr(start, end - start)));
    start = end + 1;
  }
  return list;
}

std::optional<std::size_t> CsvReader::find(std::initializer_list<std::string_view> names) const {
  std::optional<std::size_t> found;
  for (const std::string_view name : names) {
    const auto at = std::ranges::find(names_, name);
    if (at == names_.end()) continue;
    const auto column = static_cast<std::size_t>(at - names_.begin());
    if (found) refuse_both(*found, column);
    found = column;
  }
  return found;
}

std::size_t CsvReader::need(std::initializer_list<std::string_view> names) const {
  if (const auto at = find(names)) return *at;
  std::string known;
  for (const std::string_view name : names) known += (known.empty() ? "" : ", ") + std::string(name);
  throw ImportProblem{file_ + ":" + std::to_string(header_line_ + 1),
                      "has no column \"" + std::string(*names.begin()) + "\"",
                      "name it in the first line; known names of it: " + known};
}

void CsvReader::each(const std::function<void(const CsvRow&)>& take) const {
  for (std::size_t i = header_line_ + 1; i < lines_.size(); ++i) {
    if (!is_data(lines_[i])) continue;
    CsvRow row(fields(lines_[i]), file_ + ":" + std::to_string(i + 1));
    const std::size_t width = fields(lines_[i]).size();
    if (width != names_.size()) {
      throw ImportProblem{row.place(),
                          "has " + plural(width, "column") + " instead of " + std::to_string(names_.size()),
                          "correct the line or take it out"};
    }
    take(row);
  }
}

}  // namespace fencepost::host
