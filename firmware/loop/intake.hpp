// Records as inputs: those that came over the console, and those of the self-test.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "firmware/loop/pipeline.hpp"
#include "firmware/record/decode.hpp"

namespace fencepost::loop {

enum class Purpose : std::uint8_t { kRun, kSelftest };

/// Hands the contents of one line to the pipeline. A log that is played into a robot also has kinds that are no inputs.
/// They are skipped unread, except for a header, whose format may be another.
template <class Profile>
struct Intake {
  Pipeline<Profile>& pipeline;
  Purpose purpose = Purpose::kRun;
  bool input = false;  ///< it was odometry or a frame
  bool table_full = false;
  std::optional<record::Reject> reject{};
  odometry::CarProblem car_problem = odometry::CarProblem::kNone;

  void accept(const sensor::CameraIntrinsics& camera) {
    purpose == Purpose::kRun ? pipeline.set_camera(camera) : pipeline.accept_selftest(camera);
  }
  void accept(const record::Signature& signature) {
    if (purpose == Purpose::kRun) table_full = !pipeline.set_signature(signature);
  }
  void accept(const sensor::OdometrySample& sample) { accept_input(sample); }
  void accept(const sensor::BlobFrame& frame) { accept_input(frame); }
  void accept(const sensor::CarSample& sample) {
    if (purpose != Purpose::kRun || pipeline.testing()) return;
    car_problem = pipeline.problem_of(sample);
    if (const auto pose = pipeline.integrate(sample)) {
      accept_input(*pose);
    } else {
      reject = pose.error();
    }
  }
  template <class Record>
  void accept(const Record& /*record*/) {}

  template <class Record>
  static constexpr bool wants() {
    return kIsAnyOf<Record, record::Header, sensor::CameraIntrinsics, record::Signature, sensor::OdometrySample,
                    sensor::BlobFrame, sensor::CarSample>;
  }

 private:
  template <class Record, class... Kinds>
  static constexpr bool kIsAnyOf = (std::is_same_v<Record, Kinds> || ...);

  template <class Input>
  void accept_input(const Input& item) {
    input = true;
    if (purpose == Purpose::kRun) {
      reject = pipeline.accept(item);
    } else {
      pipeline.accept_selftest(item);
    }
  }
};

}  // namespace fencepost::loop
