#include "tests/bench/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>

namespace fencepost::bench {
namespace {

constexpr std::string_view kBegin = "<!-- measured -->\n";
constexpr std::string_view kEnd = "<!-- end -->\n";

std::string in_ns(double ns) { return ns < 100 ? fmt::format("{:.1f}", ns) : fmt::format("{:.0f}", ns); }

double of(const std::vector<Measured>& all, const Measured& like, Kind kind) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Measured& m) {
    return m.contender.kind == kind && (kind == Kind::kPolygon || m.contender.cells == like.contender.cells);
  });
  return found == all.end() ? 0 : found->ns;
}

// The first polygon is ours.
std::string row(const std::vector<Measured>& all, const Measured& m, Kind unit) {
  const double one = of(all, m, unit);
  return fmt::format("| {} | {} | {:.2f} |\n", m.contender.name, in_ns(m.ns), one > 0 ? m.ns / one : 0);
}

}  // namespace

std::string tables(const std::vector<Measured>& all) {
  std::string text = "| exact polygon | ns | times the clip |\n|---|---|---|\n";
  for (const Measured& m : all) {
    if (m.contender.kind == Kind::kPolygon) text += row(all, m, Kind::kPolygon);
  }
  text += "\n| grid | cells | ns | times the limit |\n|---|---|---|---|\n";
  for (const Measured& m : all) {
    if (m.contender.kind == Kind::kPolygon) continue;
    const std::string rest = row(all, m, Kind::kLimit).substr(2 + m.contender.name.size());
    text += "| " + m.contender.name + " | " + std::to_string(m.contender.cells) + rest;
  }
  return text;
}

std::string machine() {
  std::string processor = "an unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    processor = line.substr(line.find(':') + 2);
    break;
  }
  const std::time_t now = std::time(nullptr);
  std::tm day{};
  gmtime_r(&now, &day);
#ifdef __clang__
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "gcc " __VERSION__;
#endif
  return fmt::format("{}, {}, {:04}-{:02}-{:02}", processor, compiler, day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
}

bool write_between_marks(const std::string& path, const std::string& text) {
  std::ifstream in(path);
  std::stringstream read;
  read << in.rdbuf();
  std::string page = read.str();
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  if (!in || begin == std::string::npos || end == std::string::npos || end < begin) return false;
  page.replace(begin + kBegin.size(), end - begin - kBegin.size(), text);
  std::ofstream out(path, std::ios::trunc);
  out << page;
  return out.good();
}

}  // namespace fencepost::bench
