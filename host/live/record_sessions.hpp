// Others' programs that send record lines over a port of their own: a camera's $FPFRM, a controller's $FPODO or $FPCAR.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/odometry/car_drive.hpp"
#include "firmware/record/decode.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::host {

/// A session for serial::Pump. Lines of other kinds are passed over. `Derived` accepts the records that it takes as
/// samples, and completes with each.
template <class Derived, class SampleType>
class LineSession {
 public:
  using Sample = SampleType;

  /// No outbox: nothing is ever sent.
  struct Silence {
    [[nodiscard]] static std::span<const std::uint8_t> waiting() { return {}; }
    static void sent(std::size_t /*count*/) {}
  };

  bool take(std::uint8_t byte, base::Time now) {
    any_byte_ = now;
    complete_ = false;
    if (byte == '\n' || byte == '\r') {
      static_cast<void>(record::decode(line_, {.arrival = now}, static_cast<Derived&>(*this)));
      line_.clear();
    } else if (line_.size() < record::kMaxLine) {
      // A piece of a line before the `$`, cut off by an unplug or a start of the program, is dropped.
      if (byte == '$') line_.clear();
      if (line_.empty()) began_ = now;
      line_ += static_cast<char>(byte);
    }
    return complete_;
  }
  [[nodiscard]] const Sample& sample() const { return sample_; }
  void step(base::Time now) { now_ = now; }
  void link_lost() {
    line_.clear();
    heard_.reset();
    any_byte_.reset();
  }
  static Silence& outbox() {
    static Silence silence;
    return silence;
  }

  /// unready: bytes come, but no good line within the last second.
  [[nodiscard]] sensor::LinkState link() const {
    if (heard_ && now_ - *heard_ < kQuiet) return sensor::LinkState::kOk;
    return any_byte_ && now_ - *any_byte_ < kQuiet ? sensor::LinkState::kUnready : sensor::LinkState::kSilent;
  }

  // The sink of the decoder.
  template <class Record>
  void accept(const Record& /*record*/) {}

 protected:
  void complete(const Sample& sample) {
    sample_ = sample;
    heard_ = any_byte_;
    complete_ = true;
  }
  [[nodiscard]] base::Time began() const { return began_; }        ///< when the line's first byte arrived
  [[nodiscard]] base::Time arrived() const { return *any_byte_; }  ///< when its last did

 private:
  static constexpr base::Duration kQuiet = base::milliseconds(1'000);

  std::string line_;
  Sample sample_;
  bool complete_ = false;
  base::Time began_;
  base::Time now_;
  std::optional<base::Time> heard_;
  std::optional<base::Time> any_byte_;
};

struct FramesConfig {};

/// A frame's t is when the first byte of its line arrived, whatever time it bears.
class FramesSession : public LineSession<FramesSession, sensor::BlobFrame> {
 public:
  explicit FramesSession(const FramesConfig& /*config*/) {}

  [[nodiscard]] sensor::LinkState link() const {
    const sensor::LinkState link = LineSession::link();
    return link == sensor::LinkState::kOk && sample().blobs.empty() ? sensor::LinkState::kEmpty : link;
  }

  /// Its program sends the largest 16 and no count of the others.
  [[nodiscard]] static std::uint32_t dropped() { return 0; }

  using LineSession::accept;
  void accept(sensor::BlobFrame frame) {
    frame.t = began();
    complete(frame);
  }
};

/// Which clock the samples' times are of.
enum class RecordStamp : std::uint8_t {
  kArrival,  ///< ours: each sample is stamped when its line is read, whatever time it bears
  kOwn,      ///< the sender's, which then must be ours too; an empty time is stamped on arrival
};

struct RecordsConfig {
  RecordsConfig(RecordStamp stamps, const odometry::CarGeometry& of_car = {}) : stamp(stamps), car(of_car) {}
  RecordStamp stamp;
  odometry::CarGeometry car;  ///< whose readings $FPCAR lines are
};

class RecordsSession : public LineSession<RecordsSession, sensor::OdometrySample> {
 public:
  explicit RecordsSession(const RecordsConfig& config) : config_(config) {}
  RecordsSession(const RecordsSession&) = delete;
  RecordsSession& operator=(const RecordsSession&) = delete;

  using LineSession::accept;
  void accept(sensor::OdometrySample sample) {
    if (config_.stamp == RecordStamp::kArrival) sample.t = arrived();
    complete(sample);
  }
  void accept(sensor::CarSample sample) {
    if (problem_of(sample, config_.car) != odometry::CarProblem::kNone) return;
    if (config_.stamp == RecordStamp::kArrival) sample.t = arrived();
    accept(car_.take(sample, config_.car));
  }

 private:
  RecordsConfig config_;
  odometry::CarDrive car_;
};

}  // namespace fencepost::host
