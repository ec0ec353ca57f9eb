// The way from the sensors to the robot, and the faults on it.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>

#include "firmware/record/stream_reader.hpp"

namespace fencepost::test {

enum class Fault : unsigned char {
  kNone,
  kCameraSilent,    ///< no frames
  kCameraFrozen,    ///< the last frame's boxes again and again
  kCameraNonsense,  ///< boxes outside the image
  kOdometrySilent,  ///< no samples
};

/// A fault from `from` until `until`, s of stream time.
struct Outage {
  Fault fault = Fault::kNone;
  double from = 0;
  double until = std::numeric_limits<double>::infinity();
};

class Wire {
 public:
  explicit Wire(const Outage& outage) : outage_(outage) {}

  /// The part of a line that arrives, line end included; empty: nothing. Valid until the next call.
  std::string_view carry(std::string_view line);

  // The sink of the reader.
  void accept(const sensor::CameraIntrinsics& camera) { width_ = camera.width; }
  void accept(const sensor::OdometrySample& sample);
  void accept(const sensor::BlobFrame& frame);
  template <class Record>
  void accept(const Record& /*untouched*/) {}

 private:
  [[nodiscard]] bool out(base::Time t) const { return t.to_double() >= outage_.from && t.to_double() < outage_.until; }

  Outage outage_;
  std::int32_t width_ = 0;
  sensor::BlobFrame last_;  ///< before the fault
  std::string line_;        ///< as it arrives
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

}  // namespace fencepost::test
