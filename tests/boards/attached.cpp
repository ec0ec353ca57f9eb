#include "tests/boards/attached.hpp"

#include <string>
#include <utility>

namespace fencepost::test {

Attached::Attached(Line& line, std::unique_ptr<emulate::DeviceModel> model, base::Time now)
    : line_(line), model_(std::move(model)) {
  say(model_->power_up(now));
}

void Attached::pump(base::Time now) {
  const std::string asked = line_.take();
  if (!unplugged_) {
    for (const char byte : asked) say(model_->take(static_cast<std::uint8_t>(byte), now));
  }
  while (model_->next() && *model_->next() <= now) say(model_->step(*model_->next()));
}

void Attached::see(const sensor::BlobFrame& frame, base::Time now) { say(model_->see(frame, now)); }

void Attached::say(const emulate::Bytes& bytes) {
  if (!unplugged_) line_.send({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace fencepost::test
