#include "host/text/wrap.hpp"

#include <algorithm>
#include <vector>

namespace fencepost::host {
namespace {

constexpr std::size_t kStep = 4;  // columns, by which a line goes on where it has no column of its own

std::size_t first_letter(std::string_view line, std::size_t from = 0) {
  return std::min(line.find_first_not_of(' ', from), line.size());
}

/// Between blanks; those within quotes are part of a word.
std::vector<std::string_view> words_of_line(std::string_view line, bool quotes) {
  std::vector<std::string_view> words;
  char quote = 0;
  std::size_t begin = first_letter(line);
  for (std::size_t i = begin; i < line.size(); ++i) {
    const char c = line[i];
    if (quotes && quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    } else if (c == ' ' && quote == 0) {
      if (i > begin) words.push_back(line.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  if (begin < line.size()) words.push_back(line.substr(begin));
  return words;
}

/// Lines of words, the first one behind `out` as it is.
class Filled {
 public:
  Filled(std::string start, std::size_t width, std::size_t hanging, std::string_view end)
      : line_(std::move(start)), width_(width), hanging_(hanging), end_(end) {}
  void add(std::string_view word) {
    if (!empty_ && line_.size() + 1 + word.size() + end_.size() > width_) {
      text_ += line_ + std::string(end_) + "\n";
      line_ = std::string(hanging_, ' ');
      empty_ = true;
    }
    if (!empty_ && line_.back() != ' ') line_ += ' ';
    line_ += word;
    empty_ = false;
  }
  void new_line() {
    text_ += line_.substr(0, line_.find_last_not_of(' ') + 1) + "\n";
    line_ = std::string(hanging_, ' ');
    empty_ = true;
  }
  std::string text() { return text_ + line_; }

 private:
  std::string text_;
  std::string line_;
  std::size_t width_;
  std::size_t hanging_;
  std::string_view end_;
  bool empty_ = true;  ///< nothing but its start
};

std::string wrapped_command(std::string_view line, std::size_t width) {
  const std::size_t indent = first_letter(line);
  Filled filled(std::string(indent, ' '), width, indent + kStep, " \\");
  for (const std::string_view word : words_of_line(line, true)) filled.add(word);
  return filled.text();
}

std::string wrapped_line(std::string_view line, std::size_t width) {
  const std::size_t indent = first_letter(line);
  const std::size_t gap = line.find("  ", indent);
  const std::size_t column = gap == std::string_view::npos ? indent : first_letter(line, gap);
  const bool has_room = 2 * column <= width;
  const std::size_t hanging = has_room ? column : std::min(indent + kStep, 2 * kStep);
  if (gap == std::string_view::npos) {
    Filled filled(std::string(has_room ? indent : hanging, ' '), width, hanging, "");
    for (const std::string_view word : words_of_line(line, false)) filled.add(word);
    return filled.text();
  }
  Filled filled(std::string(line.substr(0, column)), width, hanging, "");
  if (!has_room) filled.new_line();
  for (const std::string_view word : words_of_line(line.substr(column), false)) filled.add(word);
  return filled.text();
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width) {
  std::string out;
  bool commands = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (!line.empty() && line.front() != ' ') commands = line == "Examples:";
    if (line.size() <= width) {
      out += line;
    } else {
      out += commands ? wrapped_command(line, width) : wrapped_line(line, width);
    }
    if (end < text.size()) out += '\n';
    begin = end + 1;
  }
  return out;
}

}  // namespace fencepost::host
