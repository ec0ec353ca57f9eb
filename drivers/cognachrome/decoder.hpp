// The stream of a Cognachrome, by the table of its protocol strings. Sources: Georgia Tech's MissionLab and TeamBots.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::cognachrome {

inline constexpr std::int32_t kWidth = 250;   ///< samples of a row, over an image of 4 by 3
inline constexpr std::int32_t kHeight = 200;  ///< rows
inline constexpr std::size_t kChannels = 3;
inline constexpr std::size_t kMaxFields = 4;  ///< of one blob

enum class Encoding : std::uint8_t {
  kBase254,  ///< `%w`: two bytes of 0 to 253, the higher first; FE and FF are never data
  kHex,      ///< one or two digits, with colons between
};
enum class Field : std::uint8_t { kNone, kColumn, kRow, kPixels, kRootOfPixels, kIgnored };

struct Format {
  std::string_view name;
  std::uint8_t mark = 0;          ///< begins a frame
  std::uint8_t count_digits = 0;  ///< behind it: the frame's number
  std::array<std::uint8_t, kChannels> channels{};
  Encoding encoding = Encoding::kBase254;
  std::array<Field, kMaxFields> fields{};
  /// Protocol strings of header and channels, as tpuvis takes them; empty: they are not known.
  std::array<std::string_view, 1 + kChannels> strings{};

  [[nodiscard]] constexpr std::size_t size() const {
    std::size_t size = 0;
    while (size < kMaxFields && fields[size] != Field::kNone) ++size;
    return size;
  }
};

/// MissionLab's.
inline constexpr Format kBinary = {"binary",
                                   0xFF,
                                   0,
                                   {'a', 'b', 'c'},
                                   Encoding::kBase254,
                                   {Field::kColumn, Field::kRow, Field::kPixels},
                                   {R"(\377)", "a%wC%wR%wN", "b%wC%wR%wN", "c%wC%wR%wN"}};
/// TeamBots'. Its separators are as its reader's comments have them.
inline constexpr Format kHex = {"hex",
                                '$',
                                2,
                                {'#', '&', '^'},
                                Encoding::kHex,
                                {Field::kRootOfPixels, Field::kColumn, Field::kRow, Field::kIgnored},
                                {}};

struct Counts {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;  ///< beyond sixteen, the smallest
  std::uint32_t broken = 0;         ///< frames with bytes that cannot be
};

/// `channel`: 0 to 2, signatures 1 to 3. The box: see the folder's README. errors: empty outside of the image, or
/// without pixels
std::optional<sensor::Blob> blob_of(std::size_t channel, std::int32_t column, std::int32_t row, std::int32_t pixels);

class Decoder {
 public:
  explicit Decoder(const Format& format) : format_(format) {}

  /// True: frame() is complete, until the next byte.
  bool feed(std::uint8_t byte, base::Time now);
  void reset() { state_ = State::kOutside; }

  [[nodiscard]] const sensor::BlobFrame& frame() const { return frame_; }
  [[nodiscard]] bool saw() const { return saw_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  enum class State : std::uint8_t { kOutside, kCount, kRecord, kFields };

  bool begin(base::Time now);
  bool end();
  void take_mark(std::uint8_t byte);
  void take_binary(std::uint8_t byte);
  void take_digit(std::uint8_t byte);
  void next_field();
  void end_record();
  void break_frame();
  [[nodiscard]] bool last_field_is_whole() const { return field_ + 1U == format_.size() && bytes_ > 0; }

  const Format& format_;
  State state_ = State::kOutside;
  bool given_ = true;  ///< frame_ was, and is not yet the one that has begun since
  bool saw_ = false;
  std::uint8_t channel_ = 0;
  std::uint8_t field_ = 0;
  std::uint8_t bytes_ = 0;  ///< of the field, or digits behind the mark
  std::array<std::int32_t, kMaxFields> values_{};
  base::Time mark_at_;
  sensor::BlobFrame frame_;
  Counts counts_;
};

}  // namespace fencepost::cognachrome
