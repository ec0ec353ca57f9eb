#include "firmware/app/text.hpp"

#include <array>

#include "firmware/record/decimal.hpp"

namespace fencepost::app {
namespace {

// Directions within this of straight ahead or behind have no side (degrees).
constexpr std::int32_t kNoSide = 2;

class Sentence {
 public:
  explicit Sentence(std::span<char> out) : out_(out) {}

  void put(std::string_view text) {
    for (const char c : text) {
      if (size_ < out_.size()) out_[size_] = c;
      ++size_;
    }
  }
  void number(std::int64_t raw, unsigned decimals) {
    std::array<char, record::kMaxDecimal> digits{};
    put({digits.data(), record::write_decimal(raw, decimals, digits)});
  }
  void pad_to(std::size_t column) {
    while (size_ < column) put(" ");
  }
  [[nodiscard]] std::size_t size() const { return size_ <= out_.size() ? size_ : 0; }

 private:
  std::span<char> out_;
  std::size_t size_ = 0;
};

std::string_view word(record::AlertLevel level) {
  switch (level) {
    case record::AlertLevel::kClear: return "CLEAR";
    case record::AlertLevel::kNotice: return "NOTICE";
    case record::AlertLevel::kWarn: return "WARN";
    case record::AlertLevel::kStop: return "STOP";
  }
  return "CLEAR";
}

// Half away from zero.
std::int64_t divide_rounded(std::int64_t value, std::int64_t by) {
  return (value < 0 ? value - by / 2 : value + by / 2) / by;
}

void put_bearing(Sentence& sentence, base::Radians bearing) {
  const std::int64_t degrees = divide_rounded(static_cast<std::int64_t>(bearing.raw) * 180, 31416);
  const std::int64_t size = degrees < 0 ? -degrees : degrees;
  if (size <= kNoSide) {
    sentence.put("ahead");
  } else if (size >= 180 - kNoSide) {
    sentence.put("behind");
  } else {
    sentence.number(size, 0);
    sentence.put(degrees > 0 ? " deg left" : " deg right");
  }
}

}  // namespace

std::size_t describe(const record::AlertReport& alert, std::string_view name, std::span<char> out) {
  constexpr std::size_t kNameColumn = 8;
  Sentence sentence(out);
  sentence.put(word(alert.level));
  sentence.pad_to(kNameColumn);
  if (name.empty()) {
    sentence.put("signature ");
    sentence.number(alert.signature, 0);
  } else {
    sentence.put(name);
  }
  sentence.put("  ");
  sentence.number(divide_rounded(alert.distance.raw, 100), 2);
  sentence.put(" m  ");
  put_bearing(sentence, alert.bearing);
  if (alert.ttc && alert.level >= record::AlertLevel::kWarn) {
    sentence.put("  in ");
    sentence.number(divide_rounded(alert.ttc->raw, 1000), 1);
    sentence.put(" s");
  }
  sentence.put("\r\n");
  return sentence.size();
}

}  // namespace fencepost::app
