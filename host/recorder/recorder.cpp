#include "host/recorder/recorder.hpp"

#include <algorithm>
#include <utility>

#include "host/recorder/status_text.hpp"

namespace fencepost::host {
namespace {

constexpr base::Duration kStatusInterval = base::milliseconds(500);
constexpr base::Duration kGreetingInterval = base::milliseconds(3000);  ///< a boot loader takes two seconds
constexpr int kGreetings = 5;
constexpr base::Duration kHintAfter = base::milliseconds(8000);
constexpr int kDrainTimeoutMs = 1000;          ///< for the reader of standard output, at the end
constexpr std::size_t kMaxOutgoing = 1 << 16;  ///< bytes; then what is typed has to wait
constexpr int kReadsPerIteration = 16;         ///< so that a flood does not starve the keyboard

}  // namespace

Recorder::Recorder(const Parts& parts, RecorderSettings settings)
    : parts_(parts), settings_(std::move(settings)), now_(parts.clock.now()), tally_(now_) {}

RecordingEnd Recorder::run() {
  while (true) {
    turn();
    if (over()) return end();
    sleep();
  }
}

void Recorder::turn() {
  now_ = parts_.clock.now();
  parts_.port.tend(now_);
  watch_connection();
  receive();
  take_typed();
  greet_again();
  send();
  if (!fault_) fault_ = parts_.log.tend(now_);
  parts_.display.flush();
  hint();
  show_status();
}

bool Recorder::over() const {
  if (fault_ || parts_.interrupted != 0) return true;
  if (settings_.ends_with_port && !parts_.port.connected()) return true;
  return settings_.length && now_ - tally_.start() >= *settings_.length;
}

void Recorder::watch_connection() {
  if (parts_.port.connected() == connected_) return;
  connected_ = !connected_;
  connected_ ? connected() : lost();
}

void Recorder::connected() {
  if (std::exchange(was_connected_, true)) parts_.display.say(settings_.port_name + " is back");
  // The rest of the line that was cut off never comes; without this the next line would be lost with it.
  if (within_line_) keep("\n");
  connected_at_ = now_;
  bytes_then_ = tally_.bytes();
  records_then_ = tally_.counts().records;
  greetings_ = 0;
}

void Recorder::lost() {
  outgoing_.clear();
  if (settings_.ends_with_port) return;
  parts_.display.say(settings_.port_name + " has gone; the recording goes on when it is back");
}

void Recorder::receive() {
  for (int i = 0; i < kReadsPerIteration && !fault_; ++i) {
    const auto count = parts_.port.read(buffer_);
    if (!count || *count == 0) break;
    keep({static_cast<const char*>(static_cast<const void*>(buffer_.data())), *count});
  }
  watch_connection();
}

// The file comes first: shown bytes are in it whatever happens next.
void Recorder::keep(std::string_view bytes) {
  fault_ = parts_.log.write(bytes, now_);
  if (fault_) return;
  within_line_ = bytes.back() != '\n';
  tally_.take(bytes, now_);
  parts_.display.take(bytes);
}

void Recorder::take_typed() {
  if (parts_.keyboard == nullptr || outgoing_.size() >= kMaxOutgoing) return;
  const std::string typed = parts_.keyboard->read();
  if (typed.empty()) return;
  if (connected_) {
    outgoing_ += typed;
  } else {
    parts_.display.say("not sent: " + settings_.port_name + " is not there");
  }
}

void Recorder::greet_again() {
  if (!connected_ || settings_.greeting.empty() || greetings_ >= kGreetings) return;
  const bool answered = tally_.counts().records != records_then_;
  if (greetings_ > 0 && (answered || now_ - greeted_at_ < kGreetingInterval)) return;
  outgoing_ += settings_.greeting;
  greeted_at_ = now_;
  ++greetings_;
}

void Recorder::send() {
  while (!outgoing_.empty()) {
    const auto* bytes = static_cast<const std::uint8_t*>(static_cast<const void*>(outgoing_.data()));
    const auto count = parts_.port.write({bytes, outgoing_.size()});
    if (!count) return watch_connection();
    outgoing_.erase(0, *count);
  }
}

void Recorder::hint() {
  if (hinted_ || !connected_ || settings_.ends_with_port || now_ - connected_at_ < kHintAfter) return;
  hinted_ = true;
  if (tally_.counts().records != records_then_) return;
  const bool silent = tally_.bytes() == bytes_then_;
  parts_.display.say(silent ? "nothing came from " + settings_.port_name + " yet; check power, wiring and --baud"
                            : "no records came from " + settings_.port_name +
                                  " yet; check --baud, or type 'mode log' if the robot is in another mode");
}

void Recorder::show_status() {
  if (now_ - status_at_ >= kStatusInterval) {
    status_at_ = now_;
    tally_.measure(now_);
    if (parts_.keyboard != nullptr) parts_.keyboard->tend();
  }
  const std::string typing = parts_.keyboard != nullptr ? parts_.keyboard->typing() : std::string();
  const std::size_t width = Display::status_width();
  std::string tail = typing.empty() ? "" : "  > " + typing;
  if (tail.size() > width) tail = tail.substr(tail.size() - width);
  parts_.display.set_status(status_line(tally_, status_at_, connected_, width - tail.size()) + tail);
}

void Recorder::sleep() {
  linux::WaitSet set;
  set.add_readable(parts_.interrupted_descriptor);
  set.add_readable(parts_.port.descriptor());
  if (parts_.keyboard != nullptr && outgoing_.size() < kMaxOutgoing) set.add_readable(parts_.keyboard->descriptor());
  if (!outgoing_.empty()) set.add_writable(parts_.port.descriptor());
  set.add_writable(parts_.display.descriptor());
  base::Time deadline = now_ + (connected_ ? kStatusInterval : linux::kRetryInterval);
  if (settings_.length) deadline = std::min(deadline, tally_.start() + *settings_.length);
  set.wait_until(parts_.clock, deadline);
}

// Also takes the bytes that the kernel holds already.
RecordingEnd Recorder::end() {
  if (!fault_) receive();
  tally_.finish();
  LogFile::Fault closing = parts_.log.close();
  parts_.display.finish(kDrainTimeoutMs);
  return {parts_.interrupted, fault_ ? std::move(fault_) : std::move(closing)};
}

}  // namespace fencepost::host
