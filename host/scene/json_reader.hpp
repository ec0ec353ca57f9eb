// A JSON value that knows its place in the file, so every error message says where, what and what to do.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// Thrown by the readers below; the reader of the whole file turns it into a message.
struct SceneProblem {
  std::string where;
  std::string what;
  std::string remedy;
};

class JsonNode {
 public:
  JsonNode(const nlohmann::json& value, std::string pointer) : value_(&value), pointer_(std::move(pointer)) {}

  [[noreturn]] void fail(std::string what, std::string remedy) const;

  void expect_object() const;
  /// Fails unless this is an object with no other keys than `allowed`; names the nearest one.
  void expect_keys(const std::vector<std::string_view>& allowed) const;
  [[nodiscard]] bool has(std::string_view key) const;
  /// The keys of an object.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// The member; fails when it is missing.
  [[nodiscard]] JsonNode at(std::string_view key) const;
  /// The member, or nothing.
  [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
  [[nodiscard]] JsonNode at(std::size_t index) const;
  /// Length of an array of at least `least` items; fails otherwise.
  [[nodiscard]] std::size_t size(std::size_t least, std::string_view items) const;

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_text() const;
  [[nodiscard]] double number(double low, double high, std::string_view unit) const;
  /// Greater than zero.
  [[nodiscard]] double positive(double high, std::string_view unit) const;
  [[nodiscard]] std::int64_t integer(std::int64_t low, std::int64_t high) const;
  [[nodiscard]] std::uint64_t unsigned_integer() const;
  [[nodiscard]] std::string text() const;
  /// true or false.
  [[nodiscard]] bool truth() const;
  /// The value as JSON.
  [[nodiscard]] std::string written() const;
  /// [x, y] in metres within the world.
  [[nodiscard]] Point point() const;

  /// The same with a fallback for a missing key.
  [[nodiscard]] double number_or(std::string_view key, double fallback, double low, double high,
                                 std::string_view unit) const;

 private:
  const nlohmann::json* value_;
  std::string pointer_;
};

/// A parsed text. Its nodes are valid as long as it is.
class JsonText {
 public:
  /// Refuses duplicate keys in one object: the second would silently win. `example` is the remedy for an empty file.
  /// errors: SceneProblem
  JsonText(std::string_view text, std::string_view example);
  [[nodiscard]] JsonNode root() const { return {*value_, ""}; }

 private:
  std::shared_ptr<const nlohmann::json> value_;
};

/// Positions lie within this of the origin, m: the record stream's range.
inline constexpr double kWorldLimit = 1000;

}  // namespace fencepost::host
