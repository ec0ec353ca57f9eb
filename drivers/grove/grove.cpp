#include "drivers/grove/grove.hpp"

#include "drivers/serial/largest_first.hpp"

namespace fencepost::grove {
namespace {

// Without a frame for so long it is started again. No model of boxes is slower.
constexpr base::Duration kPatience = base::milliseconds(800);
// A model that is being loaded.
constexpr base::Duration kLoading = base::milliseconds(3'000);

// Without end, each result, no picture.
constexpr std::string_view kStart = "AT+BREAK\r\nAT+INVOKE=-1,0,1\r\n";

// No sensor that it takes has more columns.
constexpr std::int32_t kMaxPixels = 4'095;
// Percent.
constexpr std::int32_t kMaxScore = 100;
// Signature 255.
constexpr std::int32_t kMaxTarget = 254;
// They fit into 32 bits.
constexpr std::uint8_t kMaxDigits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

/// Nearest: `twice` half pixels of `size` pixels, cut off at the picture's edges, to a part of `pixels`.
std::int32_t edge_pixels(std::int32_t twice, std::int32_t size, std::int32_t pixels) {
  return (std::clamp<std::int32_t>(twice, 0, 2 * size) * pixels + size) / (2 * size);
}

}  // namespace

Event Decoder::feed(std::uint8_t byte, base::Time now) {
  const char c = static_cast<char>(byte);
  if (c == '\r' || c == '\n') return end_line(c == '\r');
  advance(c, now);
  return Event::kNone;
}

Event Decoder::end_line(bool carriage_return) {
  const State ended = state_;
  state_ = carriage_return ? State::kBegin : State::kOutside;
  if (ended == State::kEnd) return finish();
  if (ended != State::kOutside && ended != State::kBegin) ++counts_.damaged;
  return Event::kNone;
}

void Decoder::advance(char c, base::Time now) {
  if (c == ' ' && state_ != State::kText && state_ != State::kEscape && state_ < State::kSign) {
    if (state_ == State::kBegin) state_ = State::kOutside;
    return;
  }
  switch (state_) {
    case State::kOutside: return;
    case State::kBegin: return c == '{' ? begin(now) : reset();
    case State::kFirstKey:
      if (c == '}') return close(false);
      [[fallthrough]];
    case State::kKey:
      if (c != '"') return damage();
      in_key_ = true;
      text_size_ = 0;
      state_ = State::kText;
      return;
    case State::kColon:
      if (c != ':') return damage();
      state_ = State::kValue;
      return;
    case State::kFirstValue:
      if (c == ']') return close(true);
      [[fallthrough]];
    case State::kValue: return begin_value(c);
    case State::kText:
      if (c == '"') return end_text();
      if (c == '\\') state_ = State::kEscape;
      if (text_size_ < kMaxText) text_[text_size_] = c;
      if (text_size_ <= kMaxText) ++text_size_;
      return;
    case State::kEscape: state_ = State::kText; return;
    case State::kSign:
    case State::kNumber:
    case State::kFraction: return continue_number(c);
    case State::kWord:
      if (!is_letter(c)) after_value(c);
      return;
    case State::kAfter: return after_value(c);
    case State::kEnd: return damage();
  }
}

void Decoder::begin(base::Time now) {
  begun_ = now;
  depth_ = 0;
  arrays_ = 0;
  type_.reset();
  code_.reset();
  count_.reset();
  invoke_ = has_boxes_ = impossible_ = false;
  over_ = 0;
  resolution_ = {kSide, kSide};
  boxes_.clear();
  open(false);
}

void Decoder::begin_value(char c) {
  in_key_ = false;
  if (c == '{' || c == '[') return open(c == '[');
  if (c == '-' || is_digit(c)) return begin_number(c);
  if (in(Key::kBoxes)) impossible_ = true;
  if (c == '"') {
    text_size_ = 0;
    state_ = State::kText;
  } else if (is_letter(c)) {
    state_ = State::kWord;
  } else {
    damage();
  }
}

void Decoder::begin_number(char c) {
  negative_ = c == '-';
  value_ = 0;
  digits_ = 0;
  state_ = State::kSign;
  if (!negative_) continue_number(c);
}

void Decoder::continue_number(char c) {
  if (is_digit(c)) {
    if (state_ == State::kSign) state_ = State::kNumber;
    if (state_ == State::kFraction || digits_ > kMaxDigits) return;
    if (++digits_ <= kMaxDigits) value_ = 10 * value_ + (c - '0');
    return;
  }
  if (state_ == State::kSign) return damage();
  if (c == '.' && state_ == State::kNumber) {
    state_ = State::kFraction;
    return;
  }
  end_number();
  after_value(c);
}

void Decoder::after_value(char c) {
  state_ = State::kAfter;
  if (c == ' ') return;
  if (c == ',') {
    state_ = in_array() ? State::kValue : State::kKey;
  } else if (c == ']' || c == '}') {
    close(c == ']');
  } else {
    damage();
  }
}

void Decoder::open(bool array) {
  if (depth_ == kMaxDepth) return damage();
  // In `boxes` are arrays of numbers, and nothing else.
  if (in(Key::kBoxes) && (!array || depth_ > 3)) impossible_ = true;
  ++depth_;
  arrays_ = static_cast<std::uint8_t>(arrays_ & ~(1U << depth_));
  if (array) arrays_ = static_cast<std::uint8_t>(arrays_ | 1U << depth_);
  if (depth_ < keys_.size()) keys_[depth_] = Key::kOther;
  number_count_ = 0;
  if (depth_ == 3 && in(Key::kBoxes)) {
    boxes_.clear();
    over_ = 0;
    has_boxes_ = array;
  }
  state_ = array ? State::kFirstValue : State::kFirstKey;
}

void Decoder::close(bool array) {
  if (array != in_array()) return damage();
  if (depth_ == 4 && in(Key::kBoxes)) end_box();
  if (depth_ == 3 && in(Key::kResolution)) {
    resolution_ = {numbers_[0], numbers_[1]};
    if (number_count_ != 2) impossible_ = true;
  }
  --depth_;
  state_ = depth_ == 0 ? State::kEnd : State::kAfter;
}

void Decoder::end_text() {
  const std::string_view text(text_.data(), std::min<std::size_t>(text_size_, kMaxText));
  const bool whole = text_size_ <= kMaxText;
  state_ = State::kAfter;
  if (!in_key_) {
    if (depth_ == 1 && keys_[1] == Key::kName) invoke_ = whole && text == "INVOKE";
    return;
  }
  state_ = State::kColon;
  if (depth_ >= keys_.size()) return;
  constexpr std::array<std::string_view, 8> kNames = {"",     "type",  "name",  "code",
                                                      "data", "count", "boxes", "resolution"};
  const auto found = whole ? std::find(kNames.begin(), kNames.end(), text) : kNames.end();
  keys_[depth_] = found == kNames.end() ? Key::kOther : static_cast<Key>(found - kNames.begin());
}

void Decoder::end_number() {
  const bool whole = state_ == State::kNumber && digits_ <= kMaxDigits;
  const std::int32_t value = negative_ ? -value_ : value_;
  if (depth_ == 1 && whole) {
    if (keys_[1] == Key::kType) type_ = value;
    if (keys_[1] == Key::kCode) code_ = value;
  }
  if (depth_ == 2 && whole && keys_[1] == Key::kData && keys_[2] == Key::kCount) count_ = value;
  if (!in(Key::kBoxes) && !in(Key::kResolution)) return;
  if (!whole || depth_ != (in(Key::kBoxes) ? 4 : 3)) impossible_ = true;
  if (number_count_ < kBoxNumbers) numbers_[number_count_] = value;
  if (number_count_ <= kBoxNumbers) ++number_count_;
}

void Decoder::end_box() {
  const auto& [x, y, width, height, score, target] = numbers_;
  const auto within = [](std::int32_t value, std::int32_t least, std::int32_t most) {
    return least <= value && value <= most;
  };
  if (number_count_ != kBoxNumbers || !within(x, 0, kMaxPixels) || !within(y, 0, kMaxPixels) ||
      !within(width, 1, kMaxPixels) || !within(height, 1, kMaxPixels) || !within(score, 0, kMaxScore) ||
      !within(target, 0, kMaxTarget)) {
    impossible_ = true;
    return;
  }
  const Box box{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(width),
                static_cast<std::int16_t>(height), static_cast<std::uint8_t>(target + 1)};
  if (boxes_.push_back(box)) return;
  ++over_;
  const auto size = [](const Box& a) { return a.width * a.height; };
  const auto smallest =
      std::min_element(boxes_.begin(), boxes_.end(), [size](const Box& a, const Box& b) { return size(a) < size(b); });
  if (size(*smallest) < size(box)) *smallest = box;
}

Event Decoder::finish() {
  if (!type_ || !code_) {
    ++counts_.damaged;
    return Event::kNone;
  }
  if (!invoke_ || *type_ > 1) return Event::kMessage;
  if (*type_ == 0) return *code_ == 0 ? Event::kStarted : Event::kMessage;
  if (*code_ != 0 || !has_boxes_) {
    ++counts_.unused;
    return Event::kMessage;
  }
  for (const std::int32_t pixels : resolution_) impossible_ = impossible_ || pixels < 1 || pixels > kMaxPixels;
  for (const Box& box : boxes_) impossible_ = impossible_ || !shows(box);
  if (impossible_) {
    ++counts_.impossible;
    return Event::kMessage;
  }
  frame_ = {begun_, count_ ? static_cast<std::uint32_t>(*count_) : frame_.frame + 1, {}};
  for (const Box& box : boxes_) (void)serial::insert_largest_first(frame_, blob_of(box));
  counts_.dropped += over_;
  return Event::kFrame;
}

bool Decoder::shows(const Box& box) const {
  const auto [columns, rows] = resolution_;
  return 2 * box.x - box.width < 2 * columns && 2 * box.x + box.width > 0 && 2 * box.y - box.height < 2 * rows &&
         2 * box.y + box.height > 0;
}

sensor::Blob Decoder::blob_of(const Box& box) const {
  constexpr std::int32_t kTenths = 10;
  const auto [columns, rows] = resolution_;
  const auto first = [](std::int32_t edge, std::int32_t size) {
    return static_cast<std::int16_t>(std::min<std::int32_t>(edge_pixels(edge, size, kSide), kSide - 1));
  };
  const auto last = [](std::int32_t edge, std::int32_t size, std::int16_t from) {
    return static_cast<std::int16_t>(std::max<std::int32_t>(edge_pixels(edge, size, kSide) - 1, from));
  };
  // The first pixel's middle is half a pixel from its edge.
  const auto middle = [](std::int32_t at, std::int32_t size) {
    return std::clamp<std::int32_t>(edge_pixels(2 * at, size, kTenths * kSide) - kTenths / 2, 0, kTenths * (kSide - 1));
  };
  sensor::Blob blob;
  blob.signature = box.signature;
  blob.x1 = first(2 * box.x - box.width, columns);
  blob.x2 = last(2 * box.x + box.width, columns, blob.x1);
  blob.y1 = first(2 * box.y - box.height, rows);
  blob.y2 = last(2 * box.y + box.height, rows, blob.y1);
  blob.cx = {middle(box.x, columns)};
  blob.cy = {middle(box.y, rows)};
  return blob;
}

void Decoder::damage() {
  ++counts_.damaged;
  reset();
}

bool Session::take(std::uint8_t byte, base::Time now) {
  const Event event = decoder_.feed(byte, now);
  if (event == Event::kNone) return false;
  hearing_.heard = now;
  if (event == Event::kStarted) next_start_ = now + kLoading;
  if (event != Event::kFrame) return false;
  hearing_.framed = now;
  next_start_ = now + kPatience;
  return true;
}

void Session::step(base::Time now) {
  hearing_.step(now, kPatience);
  if (begun_ && now < next_start_) return;
  begun_ = true;
  outbox_.clear();
  (void)outbox_.put(kStart);
  next_start_ = now + kPatience;
}

void Session::link_lost() {
  decoder_.reset();
  begun_ = false;
  hearing_ = {};
  outbox_.clear();
}

}  // namespace fencepost::grove
