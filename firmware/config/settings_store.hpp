// A robot's settings in flash: an append log of short lines, in two pages that take turns.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/base/crc16.hpp"
#include "hal/bus/flash_pages.hpp"

namespace fencepost::config {

/// A page begins with its head, a word of a sequence number and its complement. Entries follow. Each begins with a word
/// of length and complement. The line follows, padded with 0xFF to whole words, then a word of its CRC-16 and the
/// complement. In an entry that continues in the next one, CRC and complement change places. Words are written in this
/// order, but the head of a page last, so an unfinished page does not count. A power cut therefore loses all entries
/// that were being written together, and nothing older.
template <bus::FlashPages Flash>
class SettingsStore {
 public:
  static constexpr std::size_t kMaxLine = 256;

  explicit SettingsStore(Flash& flash) : flash_(flash) {}

  /// Calls `take(line)` for each whole entry, oldest first; for those that belong together, only if all are there.
  template <class Take>
  void load(Take&& take) {
    active_ = flash_.size() > kHead ? newest() : std::nullopt;
    end_ = kHead;
    if (!active_) return;
    std::size_t begin = end_;  // of those that belong together
    while (const std::optional<Entry> entry = entry_at(end_)) {
      end_ += entry->size;
      if (entry->state == State::kMoreFollow) continue;
      for (std::size_t at = begin; entry->state == State::kLast && at < end_;) {
        const Entry one = *entry_at(at);
        take(one.line);
        at += one.size;
      }
      begin = end_;
    }
    // A cut-off length, or a beginning that would be completed by a stranger: nothing can be put behind these.
    if (begin != end_ || !blank(*active_, end_)) end_ = flash_.size();
  }

  /// After load(). Adds entries that count together or not at all: `tell(put)` calls `put(line)` for each. False: there
  /// is no room, or the part refused, and none of them counts; rewrite() then may help.
  template <class Tell>
  [[nodiscard]] bool append(Tell&& tell) {
    if (!active_) return false;
    Put put(*this, *active_, end_, State::kMoreFollow);
    tell(put);
    const bool whole = put.finish();
    end_ = whole ? put.end() : flash_.size();  // whatever is left of them, nothing can be put behind it
    return whole;
  }

  /// Makes the other page the newest: `tell(put)` calls `put(line)` for each line of the state as it is now. Erases
  /// first where it must. False: something was too long, did not fit or was refused; then all is as before.
  template <class Tell>
  [[nodiscard]] bool rewrite(Tell&& tell) {
    if (flash_.size() <= kHead) return false;
    const std::size_t other = active_ ? 1 - *active_ : 0;
    if (!blank(other, 0) && !flash_.erase(other)) return false;
    Put put(*this, other, kHead, State::kLast);  // they count by the page's head
    tell(put);
    const auto next = static_cast<std::uint16_t>(active_ ? *sequence(*active_) + 1 : 1);
    if (!put.finish() || !flash_.program(other, 0, pair(next))) return false;
    active_ = other;
    end_ = put.end();
    return true;
  }

  /// Bytes that can be appended still.
  [[nodiscard]] std::size_t room() const { return active_ ? flash_.size() - end_ : 0; }

 private:
  static constexpr std::size_t kWord = bus::kFlashWord;
  static constexpr std::size_t kHead = kWord;
  using Word = std::array<std::uint8_t, kWord>;

  enum class State : std::uint8_t { kCutOff, kMoreFollow, kLast };

  struct Entry {
    std::string_view line;
    State state = State::kCutOff;
    std::size_t size = 0;
  };

  /// Lines on their way into a page. The last word of the latest line waits until it is known whether another follows.
  /// After the first line that does not fit, or that the part refuses, none is written.
  class Put {
   public:
    Put(SettingsStore& store, std::size_t page, std::size_t end, State between)
        : store_(store), page_(page), end_(end), between_(between) {}

    void operator()(std::string_view line) {
      right_ = right_ && line.size() <= kMaxLine && end_ + space_for(line) <= store_.flash_.size() && close(between_);
      if (!right_) return;
      std::size_t at = end_;
      right_ = program(at, pair(static_cast<std::uint16_t>(line.size())));
      at += kWord;
      // Whole words at once: some parts are held up by each call, not by each word.
      const std::span<const std::uint8_t> bytes = octets(line);
      const auto whole = bytes.first(bytes.size() / kWord * kWord);
      right_ = right_ && (whole.empty() || store_.flash_.program(page_, at, whole));
      if (const auto rest = bytes.subspan(whole.size()); right_ && !rest.empty()) {
        Word word{0xFF, 0xFF, 0xFF, 0xFF};
        std::copy(rest.begin(), rest.end(), word.begin());
        right_ = program(at + whole.size(), word);
      }
      check_ = base::crc16(line);
      any_ = true;
      end_ += space_for(line);
    }
    /// There are no more. False: not all of them are in the page.
    [[nodiscard]] bool finish() { return right_ && close(State::kLast); }
    [[nodiscard]] std::size_t end() const { return end_; }

   private:
    bool program(std::size_t at, const Word& word) { return store_.flash_.program(page_, at, word); }
    bool close(State state) {
      return !any_ || program(end_ - kWord, pair(state == State::kLast ? check_ : inverse(check_)));
    }

    SettingsStore& store_;
    std::size_t page_;
    std::size_t end_;
    State between_;
    bool right_ = true;
    bool any_ = false;
    std::uint16_t check_ = 0;  ///< of the latest
  };

  static std::span<const std::uint8_t> octets(std::string_view line) {
    return {static_cast<const std::uint8_t*>(static_cast<const void*>(line.data())), line.size()};
  }
  // A number of 16 bits and its complement: flash that is cut off in writing or erasing has no such thing.
  static Word pair(std::uint16_t value) {
    const auto low = static_cast<std::uint8_t>(value & 0xFF);
    const auto high = static_cast<std::uint8_t>(value >> 8);
    return {low, high, static_cast<std::uint8_t>(~low), static_cast<std::uint8_t>(~high)};
  }
  static std::uint16_t inverse(std::uint16_t value) { return static_cast<std::uint16_t>(~value); }
  [[nodiscard]] std::optional<std::uint16_t> pair_at(std::size_t page, std::size_t offset) const {
    const auto bytes = flash_.page(page).subspan(offset, kWord);
    if ((bytes[0] ^ bytes[2]) != 0xFF || (bytes[1] ^ bytes[3]) != 0xFF) return std::nullopt;
    return static_cast<std::uint16_t>(bytes[0] | (bytes[1] << 8));
  }
  [[nodiscard]] std::optional<std::uint16_t> sequence(std::size_t page) const { return pair_at(page, 0); }

  [[nodiscard]] std::optional<std::size_t> newest() const {
    const auto first = sequence(0);
    const auto second = sequence(1);
    if (!first && !second) return std::nullopt;
    if (!first || !second) return first ? 0U : 1U;
    const auto ahead = static_cast<std::int16_t>(static_cast<std::uint16_t>(*second - *first));
    return ahead > 0 ? 1U : 0U;
  }

  static constexpr std::size_t padded(std::size_t size) { return (size + kWord - 1) / kWord * kWord; }
  static std::size_t space_for(std::string_view line) { return 2 * kWord + padded(line.size()); }

  [[nodiscard]] bool blank(std::size_t page, std::size_t from) const {
    for (const std::uint8_t byte : flash_.page(page).subspan(from)) {
      if (byte != 0xFF) return false;
    }
    return true;
  }

  [[nodiscard]] std::optional<Entry> entry_at(std::size_t offset) const {
    const auto page = flash_.page(*active_);
    if (offset + 2 * kWord > page.size()) return std::nullopt;
    const auto length = pair_at(*active_, offset);
    if (!length || *length > kMaxLine) return std::nullopt;
    const std::size_t size = 2 * kWord + padded(*length);
    if (offset + size > page.size()) return std::nullopt;
    const auto bytes = page.subspan(offset + kWord, *length);
    const std::string_view line(static_cast<const char*>(static_cast<const void*>(bytes.data())), bytes.size());
    const auto check = pair_at(*active_, offset + size - kWord);
    const std::uint16_t right = base::crc16(line);
    const State whole = check == right ? State::kLast : check == inverse(right) ? State::kMoreFollow : State::kCutOff;
    return Entry{line, whole, size};
  }

  Flash& flash_;
  std::optional<std::size_t> active_;
  std::size_t end_ = 0;
};

}  // namespace fencepost::config
