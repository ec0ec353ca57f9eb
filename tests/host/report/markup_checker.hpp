// Is a page well-formed? Enough of an XML reader to answer that for the reports.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::testing {

/// Empty when every element is closed in order, every attribute is quoted and every '&' starts an entity; else what
/// is wrong. Style and script hold no '<' in our pages, so they need no special case.
inline std::string find_fault(std::string_view page) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < page.size();) {
    if (page[i] == '&') {
      const std::size_t end = page.find(';', i);
      if (end == std::string_view::npos || end - i > 7) return "bare & at " + std::to_string(i);
    }
    if (page[i] == '>') return "bare > at " + std::to_string(i);
    if (page[i] != '<') {
      // In style sheets '>' selects children; it is the one place where it may stand alone.
      const bool style = !open.empty() && open.back() == "style";
      i = style ? std::min(page.find('<', i), page.size()) : i + 1;
      continue;
    }
    std::size_t end = i;
    char quote = 0;
    for (++end; end < page.size() && (quote != 0 || page[end] != '>'); ++end) {
      if (quote != 0 && page[end] == '<') return "< inside an attribute at " + std::to_string(end);
      if (page[end] != '"') continue;
      if (quote == 0 && page[end - 1] != '=') return "stray quote at " + std::to_string(end);
      quote = quote == 0 ? '"' : '\0';
    }
    if (end == page.size()) return "tag without end at " + std::to_string(i);
    const std::string_view tag = page.substr(i + 1, end - i - 1);
    const std::string name(tag.substr(0, tag.find_first_of(" /\n", tag.starts_with('/') ? 1 : 0)));
    i = end + 1;
    if (name.starts_with("!")) continue;
    if (name.starts_with("/")) {
      if (open.empty() || open.back() != name.substr(1)) return "wrong end tag " + name;
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

}  // namespace fencepost::host::testing
