// What a robot has been told, in flash: an append log of short lines, in two pages that take turns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/base/crc16.hpp"
#include "hal/bus/flash_pages.hpp"

namespace fencepost::config {

/// A page: its head, two words: a sequence number and its complement. Then entries: a word of length and complement,
/// the line, padded with 0xFF to whole words, and a word with the line's CRC-16 and its complement. Words are written
/// in this order, but a page's head last of all: a page that was not finished is none.
/// A cut of the power therefore loses the entry that was being written, and nothing that was there before.
template <bus::FlashPages Flash>
class SettingsStore {
 public:
  static constexpr std::size_t kMaxLine = 256;

  explicit SettingsStore(Flash& flash) : flash_(flash) {}

  /// Calls `take(line)` for each whole entry, oldest first.
  template <class Take>
  void load(Take&& take) {
    active_ = flash_.size() > kHead ? newest() : std::nullopt;
    end_ = kHead;
    if (!active_) return;
    while (const std::optional<Entry> entry = entry_at(end_)) {
      if (entry->whole) take(entry->line);
      end_ += entry->size;
    }
    if (!blank(*active_, end_)) end_ = flash_.size();  // a cut-off length: nothing can be put behind it
  }

  /// After load(). Adds an entry. False: there is no room, or the part refused; rewrite() then may help.
  [[nodiscard]] bool append(std::string_view line) {
    if (!active_ || line.size() > kMaxLine || end_ + space_for(line) > flash_.size()) return false;
    return put(*active_, end_, line);
  }

  /// Makes the other page the newest: `tell(put)` calls `put(line)` for each line of the state as it is now. Erases
  /// first where it must. False: something was too long, did not fit or was refused; then all is as before.
  template <class Tell>
  [[nodiscard]] bool rewrite(Tell&& tell) {
    if (flash_.size() <= kHead) return false;
    const std::size_t other = active_ ? 1 - *active_ : 0;
    if (!blank(other, 0) && !flash_.erase(other)) return false;
    std::size_t end = kHead;
    bool fits = true;
    tell([&](std::string_view line) {
      fits = fits && line.size() <= kMaxLine && end + space_for(line) <= flash_.size() && put(other, end, line);
    });
    const auto next = static_cast<std::uint16_t>(active_ ? *sequence(*active_) + 1 : 1);
    if (!fits || !flash_.program(other, 0, pair(next))) return false;
    active_ = other;
    end_ = end;
    return true;
  }

  /// Bytes that can be appended still.
  [[nodiscard]] std::size_t room() const { return active_ ? flash_.size() - end_ : 0; }

 private:
  static constexpr std::size_t kWord = bus::kFlashWord;
  static constexpr std::size_t kHead = kWord;
  using Word = std::array<std::uint8_t, kWord>;

  struct Entry {
    std::string_view line;
    bool whole = false;
    std::size_t size = 0;
  };

  // A number of 16 bits and its complement: flash that is cut off in writing or erasing has no such thing.
  static Word pair(std::uint16_t value) {
    const auto low = static_cast<std::uint8_t>(value & 0xFF);
    const auto high = static_cast<std::uint8_t>(value >> 8);
    return {low, high, static_cast<std::uint8_t>(~low), static_cast<std::uint8_t>(~high)};
  }
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
    return Entry{line, check && *check == base::crc16(line), size};
  }

  // Advances `end` whether or not the part does as it is told: what was begun is used up.
  bool put(std::size_t page, std::size_t& end, std::string_view line) {
    const std::size_t begin = end;
    end += space_for(line);
    if (!flash_.program(page, begin, pair(static_cast<std::uint16_t>(line.size())))) return false;
    for (std::size_t i = 0; i < line.size(); i += kWord) {
      Word word{0xFF, 0xFF, 0xFF, 0xFF};
      for (std::size_t k = 0; k < kWord && i + k < line.size(); ++k) word[k] = static_cast<std::uint8_t>(line[i + k]);
      if (!flash_.program(page, begin + kWord + i, word)) return false;
    }
    return flash_.program(page, end - kWord, pair(base::crc16(line)));
  }

  Flash& flash_;
  std::optional<std::size_t> active_;
  std::size_t end_ = 0;
};

}  // namespace fencepost::config
