#include "host/cli/manual.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace fencepost::host::cli {
namespace {

/// Roff takes a dot or a quote that begins a line for an order, and - for a hyphen, which cannot be copied into a
/// shell.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else {
      out += c == '-' ? std::string("\\-") : std::string(1, c);
    }
  }
  return out;
}

std::string dashed(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

/// "Options:": a heading above indented lines.
bool is_heading(const std::string& line) {
  return !line.empty() && std::isupper(static_cast<unsigned char>(line[0])) != 0 && line.back() == ':';
}

class Page {
 public:
  void take(const std::string& line) {
    if (is_heading(line)) return begin(line.substr(0, line.size() - 1));
    if (line.rfind("Usage: ", 0) == 0) return usage(line.substr(7));
    if (line.empty()) return leave_table();
    const std::size_t indent = line.find_first_not_of(' ');
    if (table_ && indent == 2) return entry(line.substr(2));
    if (table_ && indent > 2) return print(line.substr(indent));
    if (as_is_ && indent > 0) return print(line);
    leave_examples();
    if (section_.empty() || section_ == "EXAMPLES" || table_ended_) begin_text();
    print(line);
  }
  std::string text() {
    leave_examples();
    return out_;
  }

 private:
  void begin(std::string section) {
    leave_examples();
    std::transform(section.begin(), section.end(), section.begin(),
                   [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
    section_ = section;
    table_ended_ = false;
    as_is_ = section == "EXAMPLES";
    table_ = !as_is_;
    out_ += ".SH \"" + escaped(section) + "\"\n";
    if (as_is_) out_ += ".nf\n";
  }
  void begin_text() {
    out_ += text_begun_ ? ".SH NOTES\n" : ".SH DESCRIPTION\n";
    section_ = "text";
    table_ = table_ended_ = false;
    text_begun_ = true;
  }
  void usage(const std::string& line) {
    leave_examples();
    out_ += ".SH SYNOPSIS\n" + escaped(line) + "\n";
    section_.clear();
  }
  void entry(const std::string& line) {
    const std::size_t gap = line.find("  ");
    out_ += ".TP\n.B \"" + escaped(line.substr(0, gap)) + "\"\n";
    if (gap != std::string::npos) print(line.substr(line.find_first_not_of(' ', gap)));
  }
  void print(const std::string& line) { out_ += escaped(line) + "\n"; }
  void leave_table() {
    table_ended_ = table_ended_ || table_;
    table_ = false;
  }
  void leave_examples() {
    if (as_is_) out_ += ".fi\n";
    as_is_ = false;
  }

  std::string out_;
  std::string section_;
  bool table_ = false;  ///< names and their meanings
  bool table_ended_ = false;
  bool as_is_ = false;
  bool text_begun_ = false;
};

}  // namespace

std::string manual_page(const std::string& name, const std::string& summary, const std::string& version,
                        const std::string& help) {
  std::string title = dashed(name);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  Page page;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) page.take(line);
  const std::size_t last = name.rfind(' ');
  std::string text = ".TH " + escaped(title) + " 1 \"\" \"fencepost " + version + "\" \"Fencepost\"\n.SH NAME\n" +
                     escaped(dashed(name)) + " \\- " + escaped(summary) + "\n" + page.text();
  if (last != std::string::npos) text += ".SH SEE ALSO\n.BR " + escaped(dashed(name.substr(0, last))) + " (1)\n";
  return text;
}

}  // namespace fencepost::host::cli
