#include "drivers/pixy1/usb.hpp"

#include "drivers/serial/largest_first.hpp"
#include "drivers/wire/endian.hpp"

namespace fencepost::pixy1 {
namespace {

constexpr base::Duration kAnswer = base::milliseconds(300);
constexpr base::Duration kNoImage = base::milliseconds(500);
constexpr std::uint8_t kPushed = 0x18;
constexpr std::uint8_t kTypeHint =
    0x64;  // types of arguments; bit 0x40 marks those that only a host with hints on gets
constexpr std::uint8_t kHint8 = 0x41;
constexpr std::uint8_t kHint16 = 0x42;
constexpr std::uint8_t kWords = 0x82;
constexpr std::uint32_t kBlocks = 0x31'42'43'43;          // "CCB1"
constexpr std::uint32_t kBlocksAndCodes = 0x32'42'43'43;  // "CCB2"
constexpr std::size_t kWordsOfBlock = 5;
constexpr std::size_t kWordsOfCode = 6;

/// Arguments, one after the other, aligned to their size from the header's start.
class Arguments {
 public:
  explicit Arguments(std::span<const std::uint8_t> message) : bytes_(message) {}

  /// The next one, if it is of that type and of so many bytes.
  std::optional<std::uint32_t> take(std::uint8_t type, std::size_t size) {
    if (at_ >= bytes_.size() || bytes_[at_] != type) return std::nullopt;
    const std::size_t value = (at_ + size) / size * size;
    if (value + size > bytes_.size() || bytes_[value - 1] != type) return std::nullopt;
    at_ = value + size;
    return static_cast<std::uint32_t>(wire::little(bytes_, value, size));
  }
  /// The next one, if it is an array of words.
  std::optional<std::span<const std::uint8_t>> take_words() {
    const std::optional<std::uint32_t> count = take(kWords, 4);
    if (!count || *count > bytes_.size() || at_ + 2 * *count > bytes_.size()) return std::nullopt;
    const std::span<const std::uint8_t> words = bytes_.subspan(at_, 2 * *count);
    at_ += words.size();
    return words;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = chirp::kHeader;
};

// Its edges as words: signature, left, right, top, bottom.
std::optional<sensor::Blob> blob_at(std::span<const std::uint8_t> words) {
  const std::uint16_t signature = wire::little_u16(words, 0);
  const std::int32_t left = wire::little_u16(words, 2);
  const std::int32_t right = wire::little_u16(words, 4) - 1;
  const std::int32_t top = wire::little_u16(words, 6);
  const std::int32_t bottom = wire::little_u16(words, 8);
  if (signature == 0 || signature > 255 || left > right || right >= kWidth || top > bottom || bottom >= kHeight) {
    return std::nullopt;
  }
  sensor::Blob blob;
  blob.signature = static_cast<std::uint8_t>(signature);
  blob.x1 = static_cast<std::int16_t>(left);
  blob.x2 = static_cast<std::int16_t>(right);
  blob.y1 = static_cast<std::int16_t>(top);
  blob.y2 = static_cast<std::int16_t>(bottom);
  blob.cx = {5 * (left + right)};
  blob.cy = {5 * (top + bottom)};
  return blob;
}

// False: one cannot be.
bool add_blocks(Pushed& pushed, std::span<const std::uint8_t> words, std::size_t words_of_one) {
  const std::size_t size = 2 * words_of_one;
  if (words.size() % size != 0) return false;
  for (std::size_t at = 0; at < words.size(); at += size) {
    if (words_of_one == kWordsOfCode && wire::little_u16(words, at) > 255) {
      ++pushed.dropped;
      continue;
    }
    const std::optional<sensor::Blob> blob = blob_at(words.subspan(at, size));
    if (!blob) return false;
    if (!serial::insert_largest_first(pushed.frame, *blob)) ++pushed.dropped;
  }
  return true;
}

}  // namespace

wire::Verdict examine_message(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kMessageMark[] = {0x55, 0x55, 0xAA, 0xAA};
  for (std::size_t i = 0; i < 4 && i < bytes.size(); ++i) {
    if (bytes[i] != kMessageMark[i]) return {wire::Front::kNoise, wire::skip_to(bytes, kMessageMark[0])};
  }
  if (bytes.size() < chirp::kHeader) return {};
  const std::uint32_t length = wire::little_u32(bytes, chirp::kHeader - 4);
  if (length > kLongestMessage - chirp::kHeader) return {wire::Front::kNoise, wire::skip_to(bytes, kMessageMark[0])};
  if (bytes.size() < chirp::kHeader + length) return {};
  return {wire::Front::kMessage, chirp::kHeader + length};
}

std::optional<Pushed> blocks_in(std::span<const std::uint8_t> message) {
  if (message.size() <= chirp::kHeader || message[4] != kPushed) return std::nullopt;
  Arguments arguments(message);
  const std::optional<std::uint32_t> what = arguments.take(kTypeHint, 4);
  if (what != kBlocks && what != kBlocksAndCodes) return std::nullopt;
  if (!arguments.take(kHint8, 1)) return std::nullopt;
  const std::optional<std::uint32_t> width = arguments.take(kHint16, 2);
  const std::optional<std::uint32_t> height = arguments.take(kHint16, 2);
  if (width != kWidth || height != kHeight) return std::nullopt;
  Pushed pushed;
  const auto blocks = arguments.take_words();
  if (!blocks || !add_blocks(pushed, *blocks, kWordsOfBlock)) return std::nullopt;
  if (what == kBlocks) return pushed;
  const auto codes = arguments.take_words();
  if (!codes || !add_blocks(pushed, *codes, kWordsOfCode)) return std::nullopt;
  return pushed;
}

bool UsbSession::take(std::uint8_t byte, base::Time now) {
  bool complete = false;
  scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
    complete = take_message(message, first_byte, now) || complete;
  });
  return complete;
}

bool UsbSession::take_message(std::span<const std::uint8_t> message, base::Time first_byte, base::Time now) {
  message_at_ = now;
  if (message[4] != kPushed) {
    take_answer(message, now);
    return false;
  }
  const std::optional<Pushed> pushed = blocks_in(message);
  if (!pushed) return false;
  counts_.blobs_dropped += pushed->dropped;
  frame_at_ = now;
  deadline_ = now + kNoImage;
  // Two that came in one heap have one time: the older one is given.
  if (last_t_ && first_byte <= *last_t_) return false;
  last_t_ = first_byte;
  frame_ = pushed->frame;
  frame_.t = first_byte;
  frame_.frame = counts_.frames++;
  return true;
}

void UsbSession::take_answer(std::span<const std::uint8_t> message, base::Time now) {
  const std::optional<chirp::Message> answer = chirp::message_in(message);
  if (!answer || answer->result < 0) return;
  if (answer->type == chirp::Type::kInitialised && phase_ == Phase::kClosed) {
    phase_ = Phase::kInitialised;
    send(chirp::enumerate("run"), now + kAnswer);
  } else if (answer->type == chirp::Type::kEnumerated && phase_ == Phase::kInitialised) {
    phase_ = Phase::kRunning;
    send(chirp::call(static_cast<std::uint16_t>(answer->result)), now + kNoImage);
  }
}

void UsbSession::send(const chirp::Transfer& transfer, base::Time until) {
  outbox_.clear();
  (void)outbox_.put(transfer.view());
  deadline_ = until;
}

void UsbSession::step(base::Time now) {
  if (message_at_ && now - *message_at_ > kNoImage) message_at_.reset();
  if (frame_at_ && now - *frame_at_ > kNoImage) frame_at_.reset();
  if (deadline_ && now < *deadline_) return;
  // A message whose rest never came answers nothing, and would swallow the next.
  scanner_.reset();
  phase_ = Phase::kClosed;
  send(chirp::initialise(), now + kAnswer);
}

void UsbSession::link_lost() {
  scanner_.reset();
  outbox_.clear();
  phase_ = Phase::kClosed;
  deadline_.reset();
  message_at_.reset();
  frame_at_.reset();
}

sensor::LinkState UsbSession::link() const {
  using enum sensor::LinkState;
  if (!message_at_) return kSilent;
  if (!frame_at_) return kUnready;
  return frame_.blobs.empty() ? kEmpty : kOk;
}

}  // namespace fencepost::pixy1
