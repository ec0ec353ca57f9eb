#include "host/text/device_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "host/text/suggest.hpp"

namespace fencepost::host {
namespace {

/// The front of `text` up to `at`, which both lose; all of it without.
std::string_view cut(std::string_view& text, char at) {
  const std::size_t end = text.find(at);
  const std::string_view front = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return front;
}

void take_option(DeviceWord& word, std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string name(text.substr(0, equals));
  const bool known = std::any_of(word.options.begin(), word.options.end(),
                                 [&](const DeviceOption& option) { return option.name == name; });
  if (equals == std::string_view::npos) {
    if (word.problem.empty()) word.problem = fmt::format("\"{}\" is no option; write NAME=VALUE", text);
  } else if (known) {
    if (word.problem.empty()) word.problem = fmt::format("{} is given twice; remove one", name);
  } else {
    word.options.push_back({name, std::string(text.substr(equals + 1))});
  }
}

}  // namespace

DeviceWord split_device(std::string_view text) {
  DeviceWord word;
  const bool has_options = text.find(',') != std::string_view::npos;
  std::string_view rest = text;
  std::string_view head = cut(rest, ',');
  const bool placed = head.find(':') != std::string_view::npos;
  word.kind = cut(head, ':');
  if (placed) word.place = head;
  if (!has_options) return word;
  while (true) {
    const bool last = rest.find(',') == std::string_view::npos;
    take_option(word, cut(rest, ','));
    if (last) return word;
  }
}

std::optional<std::uint32_t> whole_number(std::string_view text) {
  const bool hex = text.starts_with("0x");
  if (hex) text.remove_prefix(2);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(value) : std::nullopt;
}

std::string listed(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

std::string no_such(std::string_view what, std::string_view word, const std::vector<std::string>& known) {
  return fmt::format("there is no {} \"{}\";{} allowed: {}", what, word, did_you_mean(word, known), listed(known));
}

}  // namespace fencepost::host
