// Writes one line field by field. Anything that cannot be written makes the whole line void.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "firmware/record/decimal.hpp"
#include "firmware/record/kinds.hpp"

namespace fencepost::record {

template <class Rep>
concept ShortNumber = std::integral<Rep> && std::in_range<std::int32_t>(std::numeric_limits<Rep>::max());

class FieldWriter {
 public:
  FieldWriter(Kind kind, std::span<char> line);

  void number(std::int64_t raw, const NumberField& field);
  /// Most are this short, which is a third less to pass.
  template <ShortNumber Rep>
  void number(Rep raw, const NumberField& field) {
    short_number(raw, field);
  }
  template <class Quantity>
  void number_or_empty(const std::optional<Quantity>& quantity, const NumberField& field) {
    quantity ? number(quantity->raw, field) : put(',');
  }
  void time_or_arrival(base::Time t, const NumberField& field) { number(t.raw, field); }
  void text(const sensor::Text& text);
  template <class Enum>
  void word(Enum value, Enum last) {
    require(value <= last);
    put(',');
    put(name(value));
  }
  /// The same at the end of a line; nothing for the first enumerator.
  template <class Enum>
  void last_word(Enum value, Enum last) {
    if (value != Enum{}) word(value, last);
  }
  /// Two numbers at the end of a line. Nothing for a 0 at its end, an empty field for one before it.
  template <class First, class Second>
  void last_numbers(First first, const NumberField& first_field, Second second, const NumberField& second_field) {
    if (first != 0) {
      number(first, first_field);
    } else if (second != 0) {
      put(',');
    }
    if (second != 0) number(second, second_field);
  }
  void colour(sensor::Rgb rgb);
  void colour_or_empty(const std::optional<sensor::Rgb>& rgb) { rgb ? colour(*rgb) : put(','); }
  void digest(std::uint64_t value);
  /// The count, then the fields of each.
  template <class Items>
  void list(const Items& items, std::size_t /*fields_each*/) {
    number(static_cast<std::int64_t>(items.size()), {0, static_cast<std::int64_t>(items.capacity()), 0});
    for (const auto& item : items) walk(*this, item);
  }
  /// The same. If an item `has_extra`, all have one field more, written by extra_number().
  template <class Items, class Predicate>
  void list_with_extra(const Items& items, std::size_t fields_each, const Predicate& has_extra) {
    extra_ = std::any_of(items.begin(), items.end(), has_extra);
    list(items, fields_each);
  }
  /// A number that ends an item of list_with_extra(): empty for 0.
  template <class Rep>
  void extra_number(Rep raw, const NumberField& field) {
    if (!extra_) return;
    raw == 0 ? put(',') : number(raw, field);
  }
  /// Writes an empty field, or nothing.
  bool left_empty(bool is_empty) {
    if (is_empty) put(',');
    return is_empty;
  }
  /// Writes `count` empty fields.
  void empty(int count) {
    for (int i = 0; i < count; ++i) put(',');
  }
  void require(bool condition) { void_ = void_ || !condition; }

  /// Adds CRC and line end; the length, or 0 if the line is void.
  std::size_t finish();

 private:
  void short_number(std::int32_t raw, const NumberField& field);
  void put(char c);
  void put(std::string_view characters);
  void put_hex(std::uint64_t value, unsigned digits, std::string_view alphabet);

  std::span<char> line_;
  std::size_t size_ = 0;
  bool void_ = false;
  bool extra_ = false;  ///< the items have one field more
};

}  // namespace fencepost::record
