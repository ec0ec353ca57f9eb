#include "host/import/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fencepost::host {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "##:##:##.###" by pattern.
bool has_form(std::string_view text, std::string_view pattern) {
  if (text.size() < pattern.size()) return false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] == '#' ? !is_digit(text[i]) : text[i] != pattern[i]) return false;
  }
  return true;
}

double digits(std::string_view text) { return number_in(text).value_or(0); }

}  // namespace

StampedLine without_stamp(std::string_view line) {
  constexpr std::string_view kStamp = "##:##:##.### -> ";
  // A line that came without text has lost the blank behind its arrow.
  constexpr std::string_view kBare = "##:##:##.### ->";
  if (!has_form(line, kBare)) return {line, std::nullopt};
  const double hours = digits(line.substr(0, 2));
  const double minutes = digits(line.substr(3, 2));
  const double seconds = digits(line.substr(6, 6));
  if (hours >= 24 || minutes >= 60 || seconds >= 60) return {line, std::nullopt};
  const double t = 3600 * hours + 60 * minutes + seconds;
  return {line.substr(has_form(line, kStamp) ? kStamp.size() : kBare.size()), t};
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  const char line_end = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(line_end), text.size());
    std::string_view line = text.substr(0, end);
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string_view trimmed_text(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string lower(std::string_view text) {
  std::string word(text);
  std::ranges::transform(word, word.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return word;
}

std::optional<double> number_in(std::string_view text) {
  text = trimmed_text(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> value_after(std::string_view line, std::string_view key) {
  for (std::size_t at = line.find(key); at != std::string_view::npos; at = line.find(key, at + 1)) {
    const bool alone =
        at == 0 || line[at - 1] == ' ' || line[at - 1] == ',' || line[at - 1] == ':' || line[at - 1] == '\t';
    std::string_view rest = line.substr(at + key.size());
    if (!alone || rest.empty() || (rest.front() != ':' && rest.front() != '=')) continue;
    rest = rest.substr(1);
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    return number_in(rest.substr(0, std::min(rest.find_first_of(" ,\t("), rest.size())));
  }
  return std::nullopt;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMax = 40;
  std::string shown = "\"";
  for (const char c : text.substr(0, kMax)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > kMax ? "...\"" : "\"");
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!(line = trimmed_text(line)).empty()) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return words;
}

}  // namespace fencepost::host
