#include "host/scene/json_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "host/text/suggest.hpp"

namespace fencepost::host {

namespace {

std::string listed(const std::vector<std::string_view>& words) {
  std::string list;
  for (const std::string_view word : words) list += (list.empty() ? "" : ", ") + std::string(word);
  return list;
}

std::string kind_of(const nlohmann::json& value) {
  if (value.is_string()) return "the text \"" + value.get<std::string>() + "\"";
  if (value.is_object() || value.is_array() || value.is_null()) return std::string(value.type_name());
  return value.dump();
}

std::string line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_start + 1);
}

/// The place of the first number that is too large for a double: the library names the number, not its place.
std::size_t overflowing_number(const std::string& text) {
  constexpr std::string_view kOfNumbers = "+-.0123456789eE";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i) {
        if (text[i] == '\\') ++i;
      }
    } else if (text[i] == '-' || (text[i] >= '0' && text[i] <= '9')) {
      if (std::isinf(std::strtod(text.c_str() + i, nullptr))) return i;
      i = std::min(text.find_first_not_of(kOfNumbers, i), text.size()) - 1;
    }
  }
  return 0;
}

/// Bytes of a text: four times those of 10,000 objects. A parsed text takes up to forty times as many.
constexpr std::size_t kMaxText = 16'000'000;
/// Brackets within brackets; a scene has 6.
constexpr int kMaxDepth = 32;

nlohmann::json parse_json(std::string_view text, std::string_view example) {
  using nlohmann::json;
  if (text.size() > kMaxText) {
    throw SceneProblem{"line 1", "the text has more than " + std::to_string(kMaxText / 1'000'000) + " MB",
                       "leave out what is not needed"};
  }
  std::vector<std::set<std::string>> open_objects;
  const json::parser_callback_t watch = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMaxDepth) {
      throw SceneProblem{"/", "brackets are nested more than " + std::to_string(kMaxDepth) + " deep",
                         std::string(example)};
    }
    if (event == json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == json::parse_event_t::object_end) open_objects.pop_back();
    if (event == json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second) {
      throw SceneProblem{"key \"" + parsed.get<std::string>() + "\"", "appears twice in one object",
                         "remove one of the two"};
    }
    return true;
  };
  try {
    return json::parse(text, watch);
  } catch (const json::parse_error& error) {
    // The library counts bytes from 1 and points at the last one it read.
    const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
    const bool empty = text.find_first_not_of(" \t\r\n") == std::string_view::npos;
    const bool ended = byte >= text.size();
    throw SceneProblem{line_and_column(text, byte),
                       empty   ? "the file is empty"
                       : ended ? "the JSON ends too early"
                               : "this is not JSON",
                       empty   ? std::string(example)
                       : ended ? "close the open brackets and quotes"
                               : "check for a missing comma, quote or bracket just before it"};
  } catch (const json::out_of_range&) {
    throw SceneProblem{line_and_column(text, overflowing_number(std::string(text))),
                       "this number is too large for double precision", "write one within the range of its key"};
  }
}

}  // namespace

JsonText::JsonText(std::string_view text, std::string_view example)
    : value_(std::make_shared<const nlohmann::json>(parse_json(text, example))) {}

void JsonNode::fail(std::string what, std::string remedy) const {
  throw SceneProblem{pointer_.empty() ? "/" : pointer_, std::move(what), std::move(remedy)};
}

bool JsonNode::has(std::string_view key) const { return value_->contains(key); }
bool JsonNode::is_null() const { return value_->is_null(); }
bool JsonNode::is_array() const { return value_->is_array(); }
bool JsonNode::is_object() const { return value_->is_object(); }
bool JsonNode::is_text() const { return value_->is_string(); }
std::string JsonNode::written() const { return value_->dump(); }

std::vector<std::string> JsonNode::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, member] : value_->items()) keys.push_back(key);
  return keys;
}

void JsonNode::expect_object() const {
  if (!value_->is_object()) fail("must be an object, not " + kind_of(*value_), "write { ... } here");
}

void JsonNode::expect_keys(const std::vector<std::string_view>& allowed) const {
  expect_object();
  for (const auto& [key, member] : value_->items()) {
    if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
    const std::string nearest = nearest_word(key, std::vector<std::string>(allowed.begin(), allowed.end()));
    const std::string remedy =
        nearest.empty() ? "remove it; allowed: " + listed(allowed) : "did you mean \"" + nearest + "\"?";
    JsonNode(member, pointer_ + "/" + key).fail("unknown key \"" + key + "\"", remedy);
  }
}

JsonNode JsonNode::at(std::string_view key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) {
    fail("\"" + std::string(key) + "\" is missing", "add it; share/doc/scene.md shows a whole scene");
  }
  return {*found, pointer_ + "/" + std::string(key)};
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  return at(key);
}

JsonNode JsonNode::at(std::size_t index) const { return {(*value_)[index], pointer_ + "/" + std::to_string(index)}; }

std::size_t JsonNode::size(std::size_t least, std::string_view items) const {
  if (!value_->is_array()) fail("must be a list, not " + kind_of(*value_), "write [ ... ] here");
  if (value_->size() < least) {
    fail("has " + std::to_string(value_->size()) + " " + std::string(items), "give at least " + std::to_string(least));
  }
  return value_->size();
}

double JsonNode::number(double low, double high, std::string_view unit) const {
  const std::string range = fmt::format("{:g} to {:g}{}{}", low, high, unit.empty() ? "" : " ", unit);
  if (!value_->is_number()) fail("must be a number, not " + kind_of(*value_), "allowed: " + range);
  const double value = value_->get<double>();
  if (!(value >= low && value <= high)) fail(value_->dump() + " is out of range", "allowed: " + range);
  return value;
}

double JsonNode::positive(double high, std::string_view unit) const {
  const double value = number(0, high, unit);
  if (value == 0) fail("must be greater than 0", fmt::format("allowed: up to {:g} {}", high, unit));
  return value;
}

std::int64_t JsonNode::integer(std::int64_t low, std::int64_t high) const {
  const std::string range = "whole numbers from " + std::to_string(low) + " to " + std::to_string(high);
  if (!value_->is_number_integer()) fail("must be a whole number, not " + kind_of(*value_), "allowed: " + range);
  const bool too_big =
      value_->is_number_unsigned() &&
      value_->get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const auto value = value_->get<std::int64_t>();
  if (too_big || value < low || value > high) fail(value_->dump() + " is out of range", "allowed: " + range);
  return value;
}

std::uint64_t JsonNode::unsigned_integer() const {
  if (!value_->is_number_unsigned()) {
    fail("must be a whole number that is not negative, not " + kind_of(*value_), "for example 1");
  }
  return value_->get<std::uint64_t>();
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail("must be a text, not " + kind_of(*value_), "put it in double quotes");
  return value_->get<std::string>();
}

bool JsonNode::truth() const {
  if (!value_->is_boolean()) fail("must be true or false, not " + kind_of(*value_), "write it without quotes");
  return value_->get<bool>();
}

Point JsonNode::point() const {
  if (size(2, "numbers") > 2) fail("has more than two numbers", "give [x, y] in metres");
  return {at(std::size_t{0}).number(-kWorldLimit, kWorldLimit, "m"),
          at(std::size_t{1}).number(-kWorldLimit, kWorldLimit, "m")};
}

double JsonNode::number_or(std::string_view key, double fallback, double low, double high,
                           std::string_view unit) const {
  const auto node = find(key);
  return node ? node->number(low, high, unit) : fallback;
}

}  // namespace fencepost::host
