// A HuskyLens as its cable sees it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// Protocol 0.5.1: knock, algorithm, version, and blocks in each of the ways to ask for them. There are no arrows;
/// learning, names, texts, photos and models are acknowledged alone. A bad checksum or an unknown command gets no
/// answer. Sees coloured blobs while the algorithm is that of colours; signatures are ids. Its first second is not
/// documented: it is assumed deaf.
class HuskyLens final : public DeviceModel {
 public:
  static constexpr base::Duration kDeaf = base::milliseconds(1'000);

  static constexpr int kFaces = 0;
  static constexpr int kColours = 4;

  /// `function`: the one it was left in; a start keeps it.
  explicit HuskyLens(base::Time power_on = {}, int function = kFaces)
      : power_on_(power_on), left_in_(function), algorithm_(function) {}

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t byte, base::Time now) override;
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;

  /// How many colours it has learned.
  void teach(int colours) { learned_ = colours; }
  /// It answers that it is busy.
  void be_busy(bool busy) { busy_ = busy; }
  void show(const std::vector<sensor::Blob>& blobs);

 private:
  [[nodiscard]] Bytes answer(std::uint8_t command, std::span<const std::uint8_t> data);
  [[nodiscard]] Bytes answer_blocks(int id);
  void note(std::uint8_t command);

  base::Time power_on_;
  Bytes received_;
  std::vector<sensor::Blob> blobs_;
  int left_in_;
  int algorithm_;
  int learned_ = 1;
  std::uint16_t images_ = 0;
  bool busy_ = false;
};

/// "ask blocks", "INFO, 2 objects".
std::string describe_huskylens(bool from_host, std::span<const std::uint8_t> bytes);

}  // namespace fencepost::emulate
