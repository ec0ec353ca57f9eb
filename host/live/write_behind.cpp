#include "host/live/write_behind.hpp"

#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>
#include <utility>

namespace fencepost::host {
namespace {

constexpr base::Duration kTendInterval = base::milliseconds(1'000);
/// Large, since some disks take the same time for any portion; small enough that a slow one shows that it moves.
constexpr std::size_t kPortion = 64 * 1024;

/// Up to the last line end within `size`; all of it if a line is longer than that.
std::size_t whole_lines(std::string_view lines, std::size_t size) {
  if (size >= lines.size()) return lines.size();
  const std::size_t end = size == 0 ? std::string_view::npos : lines.rfind('\n', size - 1);
  return end == std::string_view::npos ? 0 : end + 1;
}

}  // namespace

/// Lives as long as the thread, which may hang in a write when the program ends.
struct WriteBehind::Shared {
  explicit Shared(std::unique_ptr<Sink> to, std::size_t most) : capacity(most), sink(std::move(to)) {
    name = sink->name();
  }

  void run();
  void write(std::unique_lock<std::mutex>& lock);
  void settle(const Fault& answer);

  const std::size_t capacity;
  std::unique_ptr<Sink> sink;  ///< the thread's alone
  mutable std::mutex mutex;    ///< of all below
  std::condition_variable changed;
  std::string queue;
  std::size_t writing = 0;
  base::Time now;
  base::Time tended;
  bool tend_due = false;
  bool stop = false;
  bool closed = false;
  Fault fault;
  std::uint64_t portions = 0;
  std::uint64_t lost = 0;
  std::uint64_t bytes = 0;
  std::string name;
};

void WriteBehind::Shared::run() {
  std::unique_lock lock(mutex);
  while (!closed) {
    changed.wait(lock, [this] { return stop || tend_due || !queue.empty(); });
    if (!queue.empty()) {
      write(lock);
      continue;
    }
    const bool last = stop;
    const base::Time at = now;
    tend_due = false;
    lock.unlock();
    const Fault answer = last ? sink->close() : sink->tend(at);
    lock.lock();
    settle(answer);
    closed = last;
    changed.notify_all();
  }
}

void WriteBehind::Shared::write(std::unique_lock<std::mutex>& lock) {
  std::size_t size = whole_lines(queue, kPortion);
  if (size == 0) size = queue.size();
  const std::string portion = queue.substr(0, size);
  queue.erase(0, size);
  writing = size;
  const base::Time at = now;
  const std::uint64_t before = bytes;
  lock.unlock();
  const Fault answer = sink->write(portion, at);
  lock.lock();
  writing = 0;
  settle(answer);
  if (answer) lost += size - std::min<std::uint64_t>(size, bytes - before);
  ++portions;
  changed.notify_all();
}

void WriteBehind::Shared::settle(const Fault& answer) {
  bytes = sink->bytes();
  name = sink->name();
  if (!answer) return;
  if (!fault) fault = answer;
  lost += queue.size();
  queue.clear();
}

// Signals are handled by the thread that waits for them.
WriteBehind::WriteBehind(std::unique_ptr<Sink> sink, std::size_t capacity)
    : shared_(std::make_shared<Shared>(std::move(sink), capacity)) {
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([shared = shared_] { shared->run(); }).detach();
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

WriteBehind::~WriteBehind() {
  const std::lock_guard lock(shared_->mutex);
  shared_->stop = true;
  shared_->changed.notify_all();
}

std::size_t WriteBehind::put(std::string_view lines, base::Time now) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->fault || shared_->stop) return 0;
  const std::size_t room = shared_->capacity - std::min(shared_->capacity, shared_->queue.size() + shared_->writing);
  const std::size_t taken = whole_lines(lines, room);
  if (taken == 0) return 0;
  shared_->queue += lines.substr(0, taken);
  shared_->now = now;
  shared_->changed.notify_all();
  return taken;
}

void WriteBehind::tend(base::Time now) {
  const std::lock_guard lock(shared_->mutex);
  if (now - shared_->tended < kTendInterval) return;
  shared_->now = shared_->tended = now;
  shared_->tend_due = true;
  shared_->changed.notify_all();
}

bool WriteBehind::close(std::chrono::milliseconds patience) {
  std::unique_lock lock(shared_->mutex);
  shared_->stop = true;
  shared_->changed.notify_all();
  while (!shared_->closed) {
    const std::uint64_t before = shared_->portions;
    shared_->changed.wait_for(lock, patience,
                              [this, before] { return shared_->closed || shared_->portions != before; });
    if (!shared_->closed && shared_->portions == before) return false;
  }
  return true;
}

WriteBehind::Fault WriteBehind::fault() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->fault;
}

std::size_t WriteBehind::waiting() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->queue.size() + shared_->writing;
}

base::Duration WriteBehind::stalled(base::Time now) {
  const std::lock_guard lock(shared_->mutex);
  const bool idle = shared_->queue.empty() && shared_->writing == 0;
  if (idle || shared_->portions != portions_seen_) moved_ = now;
  portions_seen_ = shared_->portions;
  return now - moved_;
}

std::uint64_t WriteBehind::lost() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->lost;
}

std::string WriteBehind::name() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->name;
}

std::uint64_t WriteBehind::bytes() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->bytes;
}

}  // namespace fencepost::host
