#include "host/report/label_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::host {
namespace {

constexpr double kLine = 16;       ///< px
constexpr double kAscent = 12;     ///< px of it above the baseline
constexpr double kSideMargin = 4;  ///< px
constexpr int kFarthest = 4;       ///< lines straight on, before other directions are tried
constexpr double kLedTo = 28;      ///< px: from here on a line leads to a label
constexpr double kStep = 12;       ///< px between the rings around what is named
constexpr int kDirections = 16;

/// Where its next character begins; bytes that are no UTF-8 count one each.
std::size_t next_letter(std::string_view text, std::size_t at) {
  ++at;
  while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  return at;
}

double letter_width(std::string_view letter) {
  constexpr std::string_view kNarrow = "iIjl|!.,:;'`()[]{} tfr";
  constexpr std::string_view kWide = "mwMW@%";
  const char first = letter.front();
  if (letter.size() >= 3) return 15;  // of Asian scripts and symbols, most are as wide as high
  if (letter.size() == 2) return 9.5;
  if (kNarrow.find(first) != std::string_view::npos) return 5.5;
  if (kWide.find(first) != std::string_view::npos) return 13;
  return first >= 'A' && first <= 'Z' ? 10 : 8.2;
}

std::vector<std::string_view> letters_of(std::string_view text) {
  std::vector<std::string_view> letters;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = next_letter(text, at);
    letters.push_back(text.substr(at, next - at));
    at = next;
  }
  return letters;
}

/// Its first and last letters, `left` of them, with a mark in place of the rest.
std::string without_middle(const std::vector<std::string_view>& letters, std::size_t left, const std::string& behind) {
  const std::size_t head = (left + 1) / 2;
  std::string text;
  for (std::size_t i = 0; i < head; ++i) text += letters[i];
  text += "\u2026";
  for (std::size_t i = letters.size() - (left - head); i < letters.size(); ++i) text += letters[i];
  return text + behind;
}

std::string cut(std::string_view text, double widest, const std::string& behind) {
  const std::vector<std::string_view> letters = letters_of(text);
  for (std::size_t left = letters.size() - 1; left > 1; --left) {
    std::string shorter = without_middle(letters, left, behind);
    if (text_width(shorter) <= widest) return shorter;
  }
  return "\u2026" + behind;
}

}  // namespace

double text_width(std::string_view text) {
  double width = 0;
  for (const std::string_view letter : letters_of(text)) width += letter_width(letter);
  return width;
}

std::string ShortNames::shortened(const std::string& name) {
  std::string text = text_width(name) <= widest_ ? name : cut(name, widest_, {});
  for (int i = 2; shown_.emplace(text, name).first->second != name; ++i) {
    text = cut(name, widest_, " (" + std::to_string(i) + ")");
  }
  return text;
}

std::optional<LabelSpace::Placed> LabelSpace::place(Point best, Point named, std::string_view text, int direction,
                                                    double reach) {
  Taken label{best, text_width(text) / 2 + kSideMargin};
  const std::optional<Point> found = find(label, named, direction, reach);
  if (!found) return std::nullopt;
  label.at = *found;
  taken_.push_back(label);
  Placed placed{label.at, std::nullopt};
  const Point nearest{std::clamp(named.x, label.at.x - label.half_width, label.at.x + label.half_width),
                      std::clamp(named.y, label.at.y - kAscent, label.at.y + kLine - kAscent)};
  const bool moved = label.at.x != best.x || label.at.y != best.y;
  if (moved && std::hypot(nearest.x - named.x, nearest.y - named.y) >= kLedTo) placed.from = nearest;
  return placed;
}

std::optional<Point> LabelSpace::find(const Taken& best, Point named, int direction, double reach) const {
  const auto fits = [&](Point at) {
    const Taken label{at, best.half_width};
    return inside(label) && clear(label);
  };
  for (int step = 0; step < kFarthest; ++step) {
    const Point at{best.at.x, best.at.y + direction * step * kLine};
    if (fits(at)) return at;
  }
  const double off = std::abs(best.at.y - named.y);
  for (double away = 0; away < reach; away += kStep) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      const Point at{named.x + std::cos(angle) * (off + away + best.half_width),
                     named.y + std::sin(angle) * (off + away) + kLine / 4};
      if (fits(at)) return at;
    }
  }
  return std::nullopt;
}

bool LabelSpace::inside(const Taken& label) const {
  return label.at.x - label.half_width >= bounds_.left && label.at.x + label.half_width <= bounds_.right &&
         label.at.y - kAscent >= bounds_.top && label.at.y <= bounds_.bottom;
}

bool LabelSpace::clear(const Taken& label) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const Taken& other) {
    return std::abs(other.at.y - label.at.y) < kLine - 1 &&
           std::abs(other.at.x - label.at.x) < other.half_width + label.half_width;
  });
}

}  // namespace fencepost::host
