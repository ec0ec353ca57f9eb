#include "firmware/view/side.hpp"

#include <array>

#include "firmware/console/sentence.hpp"
#include "firmware/console/top_view.hpp"
#include "firmware/view/font.hpp"
#include "firmware/view/palette.hpp"

namespace fencepost::view {
namespace {

constexpr std::int32_t kSignTop = 2;
constexpr std::int32_t kDistanceTop = 24;
constexpr std::int32_t kBearingTop = 42;
constexpr std::int32_t kObjectsTop = 56;
constexpr std::int32_t kObjectPitch = 10;
constexpr std::int32_t kLinksTop = 141;
constexpr std::int32_t kModeTop = 151;
constexpr std::size_t kNameRoom = 4;

// A line without its end.
class Line {
 public:
  console::Sentence& sentence() { return sentence_; }
  Label at(std::int32_t x, std::int32_t y, std::uint8_t colour, std::uint8_t size = 1) {
    const std::size_t end = sentence_.end();
    return {point_at(x, y), size, colour, std::string_view(characters_.data(), end > 2 ? end - 2 : 0)};
  }

 private:
  std::array<char, 64> characters_{};
  console::Sentence sentence_{characters_};
};

std::string_view short_name(sensor::LinkState state) { return sensor::works(state) ? "ok" : "--"; }

}  // namespace

LevelSign level_sign(record::AlertLevel level) {
  LevelSign sign;
  sign.ground = {kSideLeft - 1, kSignTop, 239, kSignTop + 17, colour_of(level)};
  const std::string_view word = record::name(level);
  const auto width = static_cast<std::int32_t>(2 * kLetterPitch * word.size());
  sign.word = {point_at(kSideLeft + (77 - width) / 2, kSignTop + 2), 2, kOnLevel, word};
  return sign;
}

Label distance_label(const std::optional<console::Nearest>& nearest) {
  Line line;
  if (nearest) {
    line.sentence().metres(nearest->distance).put("m");
  } else {
    line.sentence().put("-.--m");
  }
  return line.at(kSideLeft, kDistanceTop, kText, 2);
}

Label bearing_label(const std::optional<console::Nearest>& nearest) {
  Line line;
  if (nearest) line.sentence().bearing(nearest->bearing);
  return line.at(kSideLeft, kBearingTop, kText);
}

ObjectLine object_line(std::size_t row, std::size_t slot, std::string_view name,
                       const std::optional<base::Metres>& distance) {
  const std::int32_t top = kObjectsTop + static_cast<std::int32_t>(row) * kObjectPitch;
  const char letter = console::letter_of(slot);
  Line line;
  line.sentence().put({&letter, 1}).put(" ").put(name.substr(0, kNameRoom)).pad_to(kNameRoom + 2);
  if (distance) line.sentence().metres_to(kNameRoom + 7, *distance);
  const auto colour = static_cast<std::uint8_t>(kObjects + slot);
  return {{kSideLeft, static_cast<std::int16_t>(top), kSideLeft + 6, static_cast<std::int16_t>(top + 6), colour},
          line.at(kSideLeft + 10, top, kText)};
}

Label links_label(const console::Links& links) {
  Line line;
  line.sentence().put("cam ").put(short_name(links.camera)).put(" odo ").put(short_name(links.odometry));
  return line.at(kSideLeft, kLinksTop, kFaint);
}

Label mode_label(console::Mode mode) {
  Line line;
  line.sentence().put("mode ").put(console::name(mode));
  return line.at(kSideLeft, kModeTop, kFaint);
}

ScaleBar scale_bar(const Window& window) {
  const std::int32_t length = window.grid_mm() / window.mm();
  Line line;
  line.sentence().number(window.grid_mm() / 100, 1).put(" m");
  return {{3, 155, static_cast<std::int16_t>(3 + length), 156, kFaint}, line.at(3, 145, kFaint)};
}

}  // namespace fencepost::view
