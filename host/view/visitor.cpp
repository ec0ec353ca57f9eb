#include "host/view/visitor.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

#include "host/view/request.hpp"

namespace fencepost::host {
namespace {

std::string chunk(std::string_view bytes) { return fmt::format("{:x}\r\n{}\r\n", bytes.size(), bytes); }

}  // namespace

void Visitor::serve(Time now) {
  receive(now);
  do {
    refill();
    send(now);
  } while (fd_.open() && !waits_to_write() && state_ == State::kFollowing && !out_.empty());
  if (fd_.open() && too_slow(now)) fd_.close();
}

// Bytes behind the request are read and dropped: closing with unread bytes would cut off the answer. It reads a little
// at a time, for other visitors wait.
void Visitor::receive(Time now) {
  std::array<char, 4096> buffer{};
  for (int turn = 0; turn < 16 && fd_.open(); ++turn) {
    const ssize_t count = ::recv(fd_.get(), buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) return fd_.close();
    if (state_ != State::kAsking) continue;
    asked_.append(buffer.data(), static_cast<std::size_t>(count));
    const std::size_t end = asked_.find("\r\n\r\n");
    if (end == std::string::npos && asked_.size() <= kLongestHead) continue;
    if (end > kLongestHead) {
      refuse(431, "the request is too long");
    } else {
      answer(std::string_view(asked_).substr(0, end));
    }
    moved_ = now;
  }
}

void Visitor::answer(std::string_view head) {
  const Judgement judgement = judge(head);
  if (!served_) return refuse(503, "too many browsers show this run; close one of them, and load this page again");
  switch (judgement.what) {
    case Judgement::What::kRefused: return refuse(judgement.status, judgement.because);
    case Judgement::What::kPage:
      out_ = answer_head(200, "text/html", fmt::format("Content-Length: {}\r\n", page_.size()));
      out_ += page_;
      state_ = State::kGiven;
      return;
    case Judgement::What::kStream: break;
  }
  GrowingLog::Start start = log_->start();
  place_ = start.place;
  out_ = answer_head(200, "text/plain", "Transfer-Encoding: chunked\r\n");
  if (!start.preamble.empty()) out_ += chunk(start.preamble);
  state_ = State::kFollowing;
}

void Visitor::refuse(int status, std::string_view because) {
  const std::string text = fmt::format("{}\n", because);
  out_ = answer_head(status, "text/plain",
                     fmt::format("{}Content-Length: {}\r\n", status == 405 ? "Allow: GET\r\n" : "", text.size()));
  out_ += text;
  state_ = State::kGiven;
}

// A reader that the log has left behind is cut off, which its page sees: it lacks the last chunk.
void Visitor::refill() {
  if (state_ != State::kFollowing || waits_to_write()) return;
  out_.clear();
  sent_ = 0;
  GrowingLog::Part part = log_->read(place_);
  if (part.lost) return fd_.close();
  place_ = part.place;
  if (!part.bytes.empty()) out_ = chunk(part.bytes);
  if (!part.ended) return;
  out_ = "0\r\n\r\n";
  state_ = State::kGiven;
}

void Visitor::send(Time now) {
  while (fd_.open() && waits_to_write()) {
    const ssize_t count = ::send(fd_.get(), out_.data() + sent_, out_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count < 0) return fd_.close();
    sent_ += static_cast<std::size_t>(count);
    moved_ = now;
  }
  if (!fd_.open() || state_ != State::kGiven) return;
  ::shutdown(fd_.get(), SHUT_WR);
  state_ = State::kLeaving;
}

bool Visitor::too_slow(Time now) const {
  switch (state_) {
    case State::kAsking: return now - moved_ > kAskTime;
    case State::kLeaving: return now - moved_ > kLeaveTime;
    case State::kGiven:
    case State::kFollowing: return waits_to_write() && now - moved_ > kStuckTime;
  }
  return true;
}

}  // namespace fencepost::host
