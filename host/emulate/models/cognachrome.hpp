// A Newton Labs Cognachrome as its cable sees it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// Its vision task on stream 3, as Georgia Tech's MissionLab uses it: keys, prompts and protocol strings. Of the
/// strings it knows octal characters and `%w` with C, R and N; it sends sixty fields a second after `r`. The other
/// preset is the stream that TeamBots reads, without any conversation: at most four objects, each with the root of its
/// size. Channels A to C are signatures 1 to 3. The real start-up time is not known: a second is assumed.
class Cognachrome final : public DeviceModel {
 public:
  enum class Preset : std::uint8_t { kVision, kTeamBots };
  static constexpr base::Duration kStart = base::milliseconds(1'000);
  static constexpr base::Duration kField = {167};

  /// `baud` of its line; 0: as fast as it goes.
  Cognachrome(Preset preset, std::uint32_t baud) : preset_(preset), baud_(baud) { static_cast<void>(power_up({})); }

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t byte, base::Time now) override;
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;
  [[nodiscard]] std::optional<base::Time> next() const override { return next_field_; }
  Bytes step(base::Time now) override;
  [[nodiscard]] bool in_use() const override { return tracking_; }
  [[nodiscard]] bool talks_unasked() const override { return preset_ == Preset::kTeamBots; }

  void show(const std::vector<sensor::Blob>& blobs) { blobs_ = blobs; }
  [[nodiscard]] const std::array<std::string, 4>& strings() const { return strings_; }

 private:
  enum class Asks : std::uint8_t { kKey, kChannel, kFilter, kWhich, kString, kObjects };

  std::string answer(char key);
  std::string answer_key(char key);
  std::string answer_which(char key);
  [[nodiscard]] std::string prompt() const;
  [[nodiscard]] Bytes field();
  [[nodiscard]] std::string hex_field();

  Preset preset_;
  std::uint32_t baud_;
  base::Time power_on_;
  base::Time next_field_;
  base::Time free_;  ///< when the line has sent all
  bool break_ = false;
  int stream_ = 0;
  bool tracking_ = false;
  char channel_ = 'a';
  Asks asks_ = Asks::kKey;
  std::size_t which_ = 0;  ///< string that is asked for: header, A, B, C
  std::string line_;
  std::array<std::string, 4> strings_;
  std::vector<sensor::Blob> blobs_;
  unsigned count_ = 0;
};

/// "2 objects", else the text.
std::string describe_cognachrome(bool from_host, std::span<const std::uint8_t> bytes);

}  // namespace fencepost::emulate
