// A JSON value that knows its place in the file, so every error message says where, what and what to do.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// Thrown by the readers below; the reader of the whole file turns it into a message.
struct SceneProblem {
  std::string where;
  std::string what;
  std::string remedy;
};

/// Parses, and refuses duplicate keys in one object: the second would silently win. `example` is the remedy for
/// an empty file. errors: SceneProblem
nlohmann::json parse_json(std::string_view text, std::string_view example);

class JsonNode {
 public:
  JsonNode(const nlohmann::json& value, std::string pointer) : value_(&value), pointer_(std::move(pointer)) {}

  [[noreturn]] void fail(std::string what, std::string remedy) const;

  void expect_object() const;
  /// Fails unless this is an object with no other keys than `allowed`; names the nearest one.
  void expect_keys(std::initializer_list<std::string_view> allowed) const;
  [[nodiscard]] bool has(std::string_view key) const { return value_->contains(key); }
  /// The member; fails when it is missing.
  [[nodiscard]] JsonNode at(std::string_view key) const;
  /// The member, or nothing.
  [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
  [[nodiscard]] JsonNode at(std::size_t index) const;
  /// Length of an array of at least `least` items; fails otherwise.
  [[nodiscard]] std::size_t size(std::size_t least, std::string_view items) const;

  [[nodiscard]] bool is_null() const { return value_->is_null(); }
  [[nodiscard]] bool is_array() const { return value_->is_array(); }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }
  [[nodiscard]] double number(double low, double high, std::string_view unit) const;
  /// Greater than zero.
  [[nodiscard]] double positive(double high, std::string_view unit) const;
  [[nodiscard]] std::int64_t integer(std::int64_t low, std::int64_t high) const;
  [[nodiscard]] std::uint64_t unsigned_integer() const;
  [[nodiscard]] std::string text() const;
  /// true or false.
  [[nodiscard]] bool truth() const;
  /// [x, y] in metres within the world.
  [[nodiscard]] Point point() const;

  /// The same with a fallback for a missing key.
  [[nodiscard]] double number_or(std::string_view key, double fallback, double low, double high,
                                 std::string_view unit) const;

 private:
  const nlohmann::json* value_;
  std::string pointer_;
};

/// Positions lie within this of the origin, m: the record stream's range.
inline constexpr double kWorldLimit = 1000;

}  // namespace fencepost::host
