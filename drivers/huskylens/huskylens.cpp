#include "drivers/huskylens/huskylens.hpp"

#include <array>
#include <utility>

#include "drivers/serial/largest_first.hpp"

namespace fencepost::huskylens {
namespace {

using sensor::LinkState;

constexpr std::uint8_t kPatience = 5;
constexpr std::uint8_t kRefusals = 20;  // a second of them
// HuskyLens 2 does not count its images: no more of them are asked for than it takes.
constexpr base::Duration kImage2 = base::milliseconds(30);
// It loads another network before it says that it has.
constexpr base::Duration kAlgorithm2 = base::milliseconds(1'000);

constexpr std::array<std::uint8_t, 6> kKnock = {0x55, 0xAA, 0x11,
                                                0x00, 0x2C, 0x3C};  // the last byte is the sum of the others, as below
constexpr std::array<std::uint8_t, 8> kColour = {0x55, 0xAA, 0x11, 0x02, 0x2D, 0x04, 0x00, 0x43};
constexpr std::array<std::uint8_t, 6> kAskBlocks = {0x55, 0xAA, 0x11, 0x00, 0x21, 0x31};
constexpr std::array<std::uint8_t, 16> kKnock2 = {0x55, 0xAA, 0x20, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x29};
constexpr std::array<std::uint8_t, 16> kColour2 = {0x55, 0xAA, 0x30, 0, 10, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x3E};
constexpr std::array<std::uint8_t, 6> kAskBlocks2 = {0x55, 0xAA, 0x21, 0x05, 0x00, 0x25};

}  // namespace

void Session::take(std::uint8_t byte, base::Time now) {
  const std::uint32_t damaged = scanner_.damaged();
  scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
    take_message(message_of(message), first_byte, now);
  });
  if (waiting_ && !scanner_.pending().empty()) deadline_ = now + patience();
  if (scanner_.damaged() == damaged || !waiting_) return;
  // It was of the answer, most likely: there is no point in waiting on.
  ++counts_.broken;
  answered(now, base::milliseconds(20));
}

void Session::take_message(const Message& message, base::Time first_byte, base::Time now) {
  if (message.generation != generation_ && step_ != Step::kKnock) return;
  heard_ = true;
  missed_ = 0;
  if (!waiting_) return;  // the rest of an answer that was given up
  deadline_ = now + patience();
  switch (message.kind) {
    case Kind::kDone: known_ = generation_ = message.generation; return take_done(now);
    case Kind::kBusy:
      ++counts_.busy;
      work_ = LinkState::kUnready;
      answered(now, base::milliseconds(50));
      if (++refused_ >= kRefusals) begin_again();
      return;
    case Kind::kInfo: return take_info(info_in(message), first_byte, now);
    case Kind::kBlock:
      if (!building_) return;
      take_block(message);
      --left_;
      return finish_if_whole(now);
    case Kind::kArrow:
      if (!building_) return;
      --left_;
      return finish_if_whole(now);
    case Kind::kOther: return;
  }
}

void Session::take_done(base::Time now) {
  refused_ = 0;
  if (step_ == Step::kBlocks) return;
  step_ = step_ == Step::kKnock && options_.select_colour ? Step::kAlgorithm : Step::kBlocks;
  new_image_ = now;
  answered(now, {});
}

void Session::take_info(const Info& info, base::Time first_byte, base::Time now) {
  if (step_ != Step::kBlocks) return;
  refused_ = 0;
  frame_ = {};
  frame_.t = first_byte;
  left_ = info.objects;
  taught_ = info.taught;
  building_number_ = info.number;
  building_ = true;
  finish_if_whole(now);
}

void Session::take_block(const Message& block) {
  if (id_in(block) == 0) ++counts_.not_learned;
  const std::uint16_t width = options_.generation == Generation::kTwo ? kWidth2 : kWidth;
  const std::optional<sensor::Blob> blob = blob_in(block, width);
  if (blob && !serial::insert_largest_first(frame_, *blob)) ++counts_.blobs_dropped;
}

void Session::finish_if_whole(base::Time now) {
  if (!building_ || left_ > 0) return;
  if (building_number_ && number_ == building_number_) {
    ++counts_.stale;
    if (now - new_image_ >= options_.frozen) work_ = LinkState::kUnready;
    return answered(now, base::milliseconds(5));
  }
  number_ = building_number_;
  new_image_ = now;
  work_ = !taught_ ? LinkState::kUnready : frame_.blobs.empty() ? LinkState::kEmpty : LinkState::kOk;
  // Two answers that came in one heap have one time: the older one is given.
  if (!last_t_ || frame_.t > *last_t_) {
    frame_.frame = counts_.frames++;
    last_t_ = frame_.t;
    complete_ = frame_;
    fresh_ = true;
  }
  answered(now, building_number_ ? base::Duration{} : kImage2);
}

void Session::answered(base::Time now, base::Duration pause) {
  waiting_ = building_ = false;
  next_ = now + pause;
}

void Session::expire(base::Time now) {
  if (!waiting_ || now < deadline_) return;
  ++counts_.timeouts;
  answered(now, {});
  scanner_.reset();
  if (++missed_ >= kPatience) restart();
}

void Session::restart() {
  if (step_ == Step::kKnock) choose_generation();
  begin_again();
  work_ = LinkState::kUnready;
  heard_ = false;
}

// Also where it answers, and refuses: it was switched off and on unnoticed, and runs what it begins with.
void Session::begin_again() {
  ++counts_.restarts;
  step_ = Step::kKnock;
  missed_ = refused_ = 0;
  number_.reset();
}

void Session::step(base::Time now) {
  expire(now);
  if (waiting_ || absent_ || now < next_) return;
  put_question();
  waiting_ = true;
  deadline_ = now + patience();
}

base::Duration Session::patience() const {
  const bool loads = step_ == Step::kAlgorithm && generation_ == Generation::kTwo;
  return loads ? kAlgorithm2 : options_.timeout;
}

void Session::put_question() {
  const bool two = generation_ == Generation::kTwo;
  switch (step_) {
    case Step::kKnock: return two ? wire::replace(outbox_, kKnock2) : wire::replace(outbox_, kKnock);
    case Step::kAlgorithm: return two ? wire::replace(outbox_, kColour2) : wire::replace(outbox_, kColour);
    case Step::kBlocks: return two ? wire::replace(outbox_, kAskBlocks2) : wire::replace(outbox_, kAskBlocks);
  }
}

// One that has answered is seldom left: its successor may be the other, but a HuskyLens 2 is deafened by each try.
void Session::choose_generation() {
  constexpr std::uint8_t kRounds = 6;
  if (known_ == generation_ && ++rounds_ < kRounds) return;
  rounds_ = 0;
  generation_ = generation_ == Generation::kOne ? Generation::kTwo : Generation::kOne;
}

void Session::lose_link() {
  if (std::exchange(absent_, true)) return;
  scanner_.reset();
  outbox_.clear();
  waiting_ = building_ = false;
  next_ = {};
  restart();
}

LinkState Session::link() const {
  if (absent_) return LinkState::kAbsent;
  return heard_ ? work_ : LinkState::kSilent;
}

}  // namespace fencepost::huskylens
