// Rules of two lines, as users of blob cameras write them: the largest block decides, no block means go.
#pragma once

#include <array>

#include "firmware/record/stream_reader.hpp"
#include "tests/studies/hazards/listener.hpp"

namespace fencepost::test {

/// Both are set with a block of 10 cm at alert.stop.
inline constexpr double kPeerBlock = 0.10;  ///< m, wide and high

/// The pinhole's range from the height in the image, height x f / pixels: within alert.stop?
bool stops_by_range(const sensor::CameraIntrinsics& camera, const sensor::Blob& block);
/// Wider than the block at that distance?
bool stops_by_width(const sensor::CameraIntrinsics& camera, const sensor::Blob& block);

/// Asks one of them about the first block of each frame.
class PeerRule final : public Listener {
 public:
  using Stops = bool (*)(const sensor::CameraIntrinsics& camera, const sensor::Blob& block);
  explicit PeerRule(Stops stops) : stops_(stops) {}

  void hear(std::string_view line) override { reader_.push(line, *this); }

  // The sink of the reader.
  void accept(const sensor::CameraIntrinsics& camera) { camera_ = camera; }
  void accept(const sensor::BlobFrame& frame);
  template <class Record>
  void accept(const Record& /*not heard*/) {}

 private:
  Stops stops_;
  sensor::CameraIntrinsics camera_;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

}  // namespace fencepost::test
