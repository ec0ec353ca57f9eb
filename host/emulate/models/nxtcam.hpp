// An NXTCam v4: its registers on I2C, and its serial side.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "host/emulate/models/i2c_device.hpp"
#include "host/emulate/models/not_emulated.hpp"

namespace fencepost::emulate {

class NxtCam final : public I2cDevice {
 public:
  static constexpr base::Duration kBoot = base::milliseconds(1'000);

  explicit NxtCam(base::Time power_on);

  std::optional<std::vector<std::uint8_t>> transfer(std::uint8_t address, const std::vector<std::uint8_t>& out,
                                                    std::size_t expected, base::Time now) override;

  /// A new frame is tracked; blobs in our convention, at most eight are kept. Objects beyond the count keep old data.
  void show(const std::vector<sensor::Blob>& blobs);
  void restart(base::Time now);
  /// Bit c: colour c was trained. From the factory: colour 0, a white light.
  void teach(std::uint8_t colours) { taught_ = colours; }
  /// The product name at register 10: another one for a test of it.
  void set_product(const std::string& product) { product_ = product; }
  [[nodiscard]] bool tracking() const { return tracking_; }

  /// The serial side, AVRcam's dialect: the reply to a byte from the host. Commands are of capitals, digits and spaces.
  /// The firmware stores no other character; LF after CR is dropped too.
  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time now);
  /// The packet of the frame last shown, if tracking is on.
  [[nodiscard]] std::vector<std::uint8_t> packet() const;
  /// Serial commands that it does not know, and those that it accepts though they change nothing here.
  [[nodiscard]] const std::vector<std::string>& not_emulated() const { return not_emulated_.names(); }

 private:
  /// A whole line: its answer.
  std::string obey(const std::string& line);
  [[nodiscard]] std::string picture() const;
  void command(std::uint8_t letter, base::Time now);
  void write_text(std::size_t at, const std::string& text);
  void fill_map();

  std::array<std::uint8_t, 256> registers_{};
  base::Time power_on_;
  bool tracking_ = false;
  bool locked_ = false;
  bool sort_by_size_ = false;
  std::uint8_t taught_ = 1;
  std::string product_ = "NXTCam";
  std::string line_;
  std::vector<sensor::Blob> seen_;                   ///< whether tracked or not
  std::optional<std::array<std::uint8_t, 48>> map_;  ///< of colours, if one was sent
  NotEmulated not_emulated_;
};

}  // namespace fencepost::emulate
