// Reads the fields of one opened line in order. The first fault stays; what is read after it means nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "firmware/record/decimal.hpp"
#include "firmware/record/line.hpp"

namespace fencepost::record {

class FieldReader {
 public:
  FieldReader(const Line& line, std::optional<base::Time> arrival);

  template <class Rep>
  void number(Rep& raw, const NumberField& field) {
    raw = static_cast<Rep>(next_number(field));
  }
  template <class Quantity>
  void number_or_empty(std::optional<Quantity>& quantity, const NumberField& field) {
    quantity.reset();
    if (skip_empty()) return;
    quantity.emplace();
    number(quantity->raw, field);
  }
  void time_or_arrival(base::Time& t, const NumberField& field);
  void text(sensor::Text& text);
  /// One of the names of the enumerators up to `last`.
  template <class Enum>
  void word(Enum& value, Enum last) {
    const std::string_view text = next();
    for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(last); ++i) {
      value = static_cast<Enum>(i);
      if (text == name(value)) return;
    }
    fail(text.empty() ? Reject::kNumber : Reject::kRange);
  }
  /// The same at the end of a line, where it may be missing: the first enumerator.
  template <class Enum>
  void last_word(Enum& value, Enum last) {
    value = {};
    if (left_ != 0) word(value, last);
  }
  /// Two numbers at the end of a line. The second, or both, may be missing, and the first may be empty before the
  /// second: 0.
  template <class First, class Second>
  void last_numbers(First& first, const NumberField& first_field, Second& second, const NumberField& second_field) {
    first = 0;
    second = 0;
    if (left_ == 1 || (left_ == 2 && !skip_empty())) number(first, first_field);
    if (left_ != 0) number(second, second_field);
  }
  void colour(sensor::Rgb& rgb);
  void colour_or_empty(std::optional<sensor::Rgb>& rgb);
  void digest(std::uint64_t& value);
  /// The count, then that many items of `fields_each` fields, which must be all the fields that are left.
  template <class Items>
  void list(Items& items, std::size_t fields_each) {
    read_items(items, next_count(Items::capacity()), fields_each);
  }
  /// The same, where all items may have one field more, read by extra_number().
  template <class Items, class Predicate>
  void list_with_extra(Items& items, std::size_t fields_each, const Predicate& /*has_extra*/) {
    const std::size_t count = next_count(Items::capacity());
    extra_ = count != 0 && left_ == count * (fields_each + 1);
    read_items(items, count, fields_each + (extra_ ? 1 : 0));
  }
  /// A number that ends an item of list_with_extra(): 0 where it is empty, or missing in all items.
  template <class Rep>
  void extra_number(Rep& raw, const NumberField& field) {
    raw = 0;
    if (extra_ && !skip_empty()) number(raw, field);
  }
  /// True if the next field is empty, which is then read.
  bool left_empty(bool& is_empty) { return is_empty = skip_empty(); }
  /// Reads `count` empty fields.
  void empty(int count) {
    for (int i = 0; i < count; ++i) require(skip_empty());
  }
  void require(bool condition) {
    if (!condition) fail(Reject::kRange);
  }

  [[nodiscard]] std::optional<Reject> fault() const { return fault_; }

 private:
  std::string_view next();
  /// Steps over the next field if it is empty.
  bool skip_empty();
  /// The number of items that follow.
  std::size_t next_count(std::size_t most) {
    return static_cast<std::size_t>(next_number({0, static_cast<std::int64_t>(most), 0}));
  }
  template <class Items>
  void read_items(Items& items, std::size_t count, std::size_t fields_each) {
    items.clear();
    if (left_ != count * fields_each) fail(Reject::kFields);
    for (std::size_t i = 0; i < count && !fault_; ++i) {
      typename std::remove_cvref_t<decltype(items[0])> item;
      walk(*this, item);
      if (!items.push_back(item)) fail(Reject::kRange);
    }
  }
  std::int64_t next_number(const NumberField& field);
  void fail(Reject reason);

  std::string_view rest_;
  std::size_t left_;    ///< fields not yet read
  bool extra_ = false;  ///< the items have one field more
  std::optional<base::Time> arrival_;
  std::optional<Reject> fault_;
};

}  // namespace fencepost::record
