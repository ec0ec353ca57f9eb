// Odometry that another controller sends as $FPODO or $FPCAR lines over a port of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/odometry/car_drive.hpp"
#include "firmware/record/decode.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::host {

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

/// A session for serial::Pump. Lines of other kinds are passed over.
class RecordsSession {
 public:
  using Sample = sensor::OdometrySample;

  /// No outbox: nothing is ever sent.
  struct Silence {
    [[nodiscard]] static std::span<const std::uint8_t> waiting() { return {}; }
    static void sent(std::size_t /*count*/) {}
  };

  explicit RecordsSession(const RecordsConfig& config) : config_(config) {}
  RecordsSession(const RecordsSession&) = delete;
  RecordsSession& operator=(const RecordsSession&) = delete;

  bool take(std::uint8_t byte, base::Time now) {
    any_byte_ = arrived_ = now;
    complete_ = false;
    if (byte == '\n' || byte == '\r') {
      static_cast<void>(record::decode(line_, {.arrival = now}, *this));
      line_.clear();
    } else if (line_.size() < record::kMaxLine) {
      line_ += static_cast<char>(byte);
    }
    return complete_;
  }
  [[nodiscard]] const sensor::OdometrySample& sample() const { return sample_; }
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
  void accept(const sensor::OdometrySample& sample) {
    sample_ = sample;
    if (config_.stamp == RecordStamp::kArrival) sample_.t = arrived_;
    heard_ = arrived_;
    complete_ = true;
  }
  void accept(const sensor::CarSample& sample) {
    if (problem_of(sample, config_.car) != odometry::CarProblem::kNone) return;
    sensor::CarSample stamped = sample;
    if (config_.stamp == RecordStamp::kArrival) stamped.t = arrived_;
    accept(car_.take(stamped, config_.car));
  }
  template <class Record>
  void accept(const Record& /*record*/) {}

 private:
  static constexpr base::Duration kQuiet = base::milliseconds(1'000);

  RecordsConfig config_;
  odometry::CarDrive car_;
  std::string line_;
  sensor::OdometrySample sample_;
  bool complete_ = false;
  base::Time arrived_;
  base::Time now_;
  std::optional<base::Time> heard_;
  std::optional<base::Time> any_byte_;
};

}  // namespace fencepost::host
