#include "host/evaluate/simulated_truths.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace fencepost::host {

/// A thread that simulates until a fixed number of frames waits.
class SimulatedTruths::Ahead {
 public:
  explicit Ahead(const Scene& scene) : simulating_([this, &scene] { simulate_all(scene); }) {}
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;
  ~Ahead() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    changed_.notify_all();
    simulating_.join();
  }

  /// The frame of that number, if the scene gives it; only the latest ones are searched.
  const FrameTruth* find(std::uint32_t number) {
    while (true) {
      for (const FrameTruth& truth : latest_) {
        if (truth.frame.frame == number) return &truth;
      }
      const bool passed = !latest_.empty() && latest_.back().frame.frame > number + kDisorder;
      if (passed || !take_more()) return nullptr;
    }
  }

 private:
  static constexpr std::size_t kAhead = 64;       ///< frames; with the latest less than 1 MB
  static constexpr std::uint32_t kDisorder = 16;  ///< frames that jitter may bring too late
  struct Stopped {};

  bool take_more() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !waiting_.empty() || over_; });
    if (failed_) std::rethrow_exception(failed_);
    const bool any = !waiting_.empty();
    latest_.insert(latest_.end(), std::make_move_iterator(waiting_.begin()), std::make_move_iterator(waiting_.end()));
    waiting_.clear();
    lock.unlock();
    changed_.notify_all();
    while (latest_.size() > 2 * kAhead) latest_.pop_front();
    return any;
  }

  void give(FrameTruth truth) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kAhead || stopped_; });
    if (stopped_) throw Stopped();
    waiting_.push_back(std::move(truth));
    // Woken less often, the other one does not wait for single frames.
    if (waiting_.size() == 1 || waiting_.size() == kAhead) changed_.notify_all();
  }

  void simulate_all(const Scene& scene) {
    try {
      static_cast<void>(simulate_with_truth(
          scene, [](std::string_view) {},
          [&](FrameTruth truth) {
            take_off_pads(scene, truth);
            give(std::move(truth));
          }));
    } catch (const Stopped&) {
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failed_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<FrameTruth> waiting_;
  bool stopped_ = false;
  bool over_ = false;
  std::exception_ptr failed_;
  std::deque<FrameTruth> latest_;  ///< of the asking thread
  std::thread simulating_;
};

SimulatedTruths::SimulatedTruths(const Scene& scene) : scene_(scene) {}
SimulatedTruths::~SimulatedTruths() = default;

void SimulatedTruths::restart() { ahead_.reset(); }

std::optional<BlobOwners> SimulatedTruths::owners(const recon::WaitingFrame& frame) {
  if (!ahead_) ahead_ = std::make_unique<Ahead>(scene_);
  const FrameTruth* truth = ahead_->find(frame.frame);
  if (truth == nullptr) return std::nullopt;
  return owners_in(*truth, frame);
}

}  // namespace fencepost::host
