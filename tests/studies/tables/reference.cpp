#include "tests/studies/tables/reference.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

#include "tests/studies/common/noise_levels.hpp"
#include "tests/studies/tables/quality_run.hpp"
#include "tests/studies/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields{""};
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

template <class Number>
Number number(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end) throw std::runtime_error("'" + text + "' is no number");
  return value;
}

double percent(const std::string& text) {
  const auto value = number<double>(text);
  if (!(value >= 0 && value <= 100)) throw std::runtime_error("'" + text + "' is outside 0..100");
  return value;
}

std::optional<std::uint32_t> views_of(const std::string& text) {
  const auto views = number<std::uint32_t>(text);
  if (views == kTourViews) return std::nullopt;
  if (std::find(kTableViews.begin(), kTableViews.end(), views) == kTableViews.end()) {
    throw std::runtime_error("'" + text + "' is no column of the tables");
  }
  return views;
}

ReferenceCell cell_of(const std::string& line) {
  const std::vector<std::string> fields = fields_of(line);
  if (fields.size() != 5) throw std::runtime_error("not five fields");
  const auto& levels = noise_levels();
  if (std::none_of(levels.begin(), levels.end(), [&](const auto& level) { return level.key == fields[0]; })) {
    throw std::runtime_error("'" + fields[0] + "' is no noise level");
  }
  return {fields[0], fields[1], views_of(fields[2]), percent(fields[3]), percent(fields[4])};
}

}  // namespace

std::vector<ReferenceCell> load_reference(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<ReferenceCell> cells;
  bool named = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.starts_with('#')) continue;
    try {
      if (named) cells.push_back(cell_of(line));
      if (!named && line != "level,model,views,recklessness,paranoia") throw std::runtime_error("names expected");
      named = true;
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ", line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (cells.empty()) throw std::runtime_error(path + " has no figures");
  return cells;
}

}  // namespace fencepost::test
