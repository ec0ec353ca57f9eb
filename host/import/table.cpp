#include "host/import/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "host/import/text_lines.hpp"
#include "host/text/gunzip.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {

namespace {

[[noreturn]] void refuse_long(const std::string& path) {
  throw ImportProblem{path, "has more than " + std::to_string(kMaxWhole / 1'000'000) + " MB",
                      "leave out the rows that are not needed"};
}

std::string read_whole(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_regular_file(path, none) && std::filesystem::file_size(path, none) > kMaxWhole) {
    refuse_long(path);
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  // A folder opens but does not read.
  if (!file || std::filesystem::is_directory(path, none)) {
    throw ImportProblem{path, "cannot be read", "check the name and the permissions"};
  }
  if (!is_gzip(bytes.view())) return std::move(bytes).str();
  if (std::optional<std::string> unpacked = gunzip(bytes.view())) {
    if (unpacked->size() > kMaxWhole) refuse_long(path);
    return std::move(*unpacked);
  }
  throw ImportProblem{path, "is damaged or cut off", "try 'gzip -t' on it, and copy it again"};
}

std::vector<std::string> read_lines(const std::string& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets write one
  std::string whole = read_whole(path);
  if (whole.starts_with(kByteOrderMark)) whole.erase(0, kByteOrderMark.size());
  std::istringstream text(std::move(whole));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw ImportProblem{path, "is empty", "check that the copy is complete"};
  return lines;
}

double to_number(std::string_view field, const std::string& place) {
  field = trimmed_text(field);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
    throw ImportProblem{place, "\"" + std::string(field) + "\" is not a number", "correct the line or take it out"};
  }
  return value;
}

std::vector<std::string> words_in(const std::string& line, std::string_view separators) {
  std::vector<std::string> words;
  const std::string_view text = std::string_view(line).substr(0, line.find('#'));
  for (std::size_t begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return words;
}

void expect_count(std::size_t found, std::size_t expected, const std::string& names, const std::string& place) {
  if (found == expected) return;
  throw ImportProblem{place, "has " + plural(found, "column") + " instead of " + std::to_string(expected),
                      "expected: " + names};
}

}  // namespace

Table read_space_table(const std::string& path, std::size_t columns, const std::string& column_names) {
  Table table{path, {}};
  const std::vector<std::string> lines = read_lines(path);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    TableRow row{i + 1, {}};
    const std::string place = path + ":" + std::to_string(row.line);
    for (const std::string& word : words_in(lines[i], " \t")) row.values.push_back(to_number(word, place));
    if (row.values.empty()) continue;
    expect_count(row.values.size(), columns, column_names, place);
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw ImportProblem{path, "has no rows", "expected: " + column_names};
  return table;
}

WordTable read_words(const std::string& path) {
  WordTable table{path, {}};
  const std::vector<std::string> lines = read_lines(path);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    WordRow row{i + 1, words_in(lines[i], " \t,")};
    if (!row.words.empty()) table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw ImportProblem{path, "has no rows", "check that the copy is complete"};
  return table;
}

double WordTable::number(const WordRow& row, std::size_t index) const {
  return to_number(row.words.at(index), place(row));
}

int WordTable::whole(const WordRow& row, std::size_t index) const {
  constexpr double kMaxMagnitude = 1e6;
  const double value = number(row, index);
  if (std::abs(value) <= kMaxMagnitude && value == std::floor(value)) return static_cast<int>(value);
  throw ImportProblem{place(row), "\"" + row.words[index] + "\" is not a whole number",
                      "correct the line or take it out"};
}

void WordTable::expect_at_least(const WordRow& row, std::size_t columns, const std::string& column_names) const {
  if (row.words.size() < columns) expect_count(row.words.size(), columns, column_names, place(row));
}

Table read_csv_table(const std::string& path, const std::string& header) {
  Table table{path, {}};
  const std::vector<std::string> lines = read_lines(path);
  if (trimmed_text(lines[0]) != header)
    throw ImportProblem{path + ":1", "is not the expected header", "write: " + header};
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed_text(lines[i]).empty()) continue;
    TableRow row{i + 1, {}};
    const std::string place = path + ":" + std::to_string(row.line);
    std::istringstream fields(lines[i] + ",");
    std::vector<std::string> texts;
    for (std::string field; std::getline(fields, field, ',');) texts.push_back(field);
    expect_count(texts.size(), columns, header, place);
    for (const std::string& text : texts) row.values.push_back(to_number(text, place));
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) throw ImportProblem{path, "has a header but no rows", "check that the copy is complete"};
  return table;
}

}  // namespace fencepost::host
