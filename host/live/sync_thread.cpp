#include "host/live/sync_thread.hpp"

#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

namespace fencepost::host {
namespace {

bool is_folder(int fd) {
  struct stat about {};
  return ::fstat(fd, &about) == 0 && S_ISDIR(about.st_mode);
}

// 0, or the error. A device or a pipe has nothing to bring to a disk, and some file systems cannot sync a folder.
int sync_now(int fd) {
  while ((is_folder(fd) ? ::fsync(fd) : ::fdatasync(fd)) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOSYS || errno == EROFS ? 0 : errno;
  }
  return 0;
}

}  // namespace

// Signals are handled by the thread that waits for them.
SyncThread::SyncThread() {
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

SyncThread::~SyncThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void SyncThread::sync(linux::Descriptor descriptor) {
  {
    const std::lock_guard lock(mutex_);
    due_.push_back(std::move(descriptor));
  }
  changed_.notify_all();
}

bool SyncThread::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || !due_.empty();
}

int SyncThread::drain() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !working_ && due_.empty(); });
  return error_;
}

int SyncThread::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void SyncThread::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !due_.empty(); });
    if (due_.empty()) return;
    linux::Descriptor descriptor = std::move(due_.front());
    due_.pop_front();
    working_ = true;
    lock.unlock();
    const int error = sync_now(descriptor.get());
    descriptor.close();
    lock.lock();
    working_ = false;
    if (error_ == 0) error_ = error;
    changed_.notify_all();
  }
}

}  // namespace fencepost::host
