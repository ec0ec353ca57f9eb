#include "tests/boards/attached.hpp"

#include <string>
#include <utility>

namespace fencepost::test {

Attached::Attached(Line& line, std::unique_ptr<emulate::Peer> peer, base::Time now)
    : line_(line), peer_(std::move(peer)) {
  say(peer_->power_up(now));
}

void Attached::pump(base::Time now) {
  const std::string asked = line_.take();
  if (!unplugged_) {
    for (const char byte : asked) say(peer_->take(static_cast<std::uint8_t>(byte), now));
  }
  while (peer_->next() && *peer_->next() <= now) say(peer_->step(*peer_->next()));
}

void Attached::see(const sensor::BlobFrame& frame, base::Time now) { say(peer_->see(frame, now)); }

void Attached::say(const emulate::Bytes& bytes) {
  if (!unplugged_) line_.send({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace fencepost::test
