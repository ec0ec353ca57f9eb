#include "tests/studies/storm/disk.hpp"

#include <chrono>

namespace fencepost::test {
namespace {

class SteppedSink final : public host::Sink {
 public:
  explicit SteppedSink(std::shared_ptr<Platter> platter) : platter_(std::move(platter)) {}

  Fault write(std::string_view lines, base::Time /*now*/) override {
    std::unique_lock lock(platter_->mutex);
    platter_->inside = true;
    platter_->changed.notify_all();
    platter_->changed.wait(lock, [this] { return platter_->open; });
    platter_->inside = false;
    if (platter_->full) return linux::Problem{"the disk is full"};
    platter_->bytes += lines;
    return std::nullopt;
  }
  Fault tend(base::Time /*now*/) override { return std::nullopt; }
  Fault close() override { return std::nullopt; }
  [[nodiscard]] std::string name() const override { return "storm.log"; }
  [[nodiscard]] std::uint64_t bytes() const override { return 0; }

 private:
  std::shared_ptr<Platter> platter_;
};

}  // namespace

Disk::Disk()
    : writer_(std::make_unique<SteppedSink>(platter_), kCapacity),
      keeper_(
          &writer_, [](std::string_view) {}, "", base::Time{}) {}

Disk::~Disk() {
  set_open(true);
  writer_.close(std::chrono::milliseconds(10'000));
}

std::size_t Disk::take(std::string_view lines, base::Time now) {
  const std::size_t taken = keeper_.take(lines, now);
  settle();
  return taken;
}

void Disk::set_open(bool open) {
  {
    const std::lock_guard lock(platter_->mutex);
    platter_->open = open;
    platter_->changed.notify_all();
  }
  settle();
}

void Disk::set_full() {
  const std::lock_guard lock(platter_->mutex);
  platter_->full = true;
}

std::string Disk::bytes() const {
  const std::lock_guard lock(platter_->mutex);
  return platter_->bytes;
}

// Until the thread has nothing to do, or stands in front of a disk that takes nothing.
void Disk::settle() {
  while (writer_.waiting() > 0) {
    std::unique_lock lock(platter_->mutex);
    if (!platter_->open && platter_->inside) return;
    platter_->changed.wait_for(lock, std::chrono::microseconds(200));
  }
}

}  // namespace fencepost::test
