#include "host/recorder/losses.hpp"

namespace fencepost::host {
namespace {

// Its clock restarts with every run, its counters only with every boot.
bool booted_again(const record::StatusReport& now, const record::StatusReport& before) {
  return now.frames < before.frames || now.odometry < before.odometry || now.blobs < before.blobs ||
         now.records_dropped < before.records_dropped || now.blobs_dropped < before.blobs_dropped ||
         now.refused < before.refused || now.rejected < before.rejected;
}

}  // namespace

// The camera's count may continue or restart.
void Losses::accept(const record::Header& /*header*/) { last_frame_.reset(); }

void Losses::accept(const sensor::BlobFrame& frame) {
  if (last_frame_ && frame.frame > *last_frame_) frames_missing_ += frame.frame - *last_frame_ - 1;
  last_frame_ = frame.frame;
}

void Losses::accept(const record::StatusReport& status) {
  if (last_status_) {
    const record::StatusReport before = booted_again(status, *last_status_) ? record::StatusReport() : *last_status_;
    reported_.records_dropped += status.records_dropped - before.records_dropped;
    reported_.blobs_dropped += status.blobs_dropped - before.blobs_dropped;
    reported_.refused += status.refused - before.refused;
    reported_.rejected += status.rejected - before.rejected;
  }
  last_status_ = status;
}

void Losses::accept(const record::LinkReport& link) {
  constexpr std::size_t kMax = 64;  // of names that a damaged or hostile stream makes up there is no end
  const std::string device(link.device.view());
  if (links_.size() < kMax || links_.contains(device)) links_[device] = link;
}

}  // namespace fencepost::host
