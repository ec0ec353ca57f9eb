// A JeVois as its cable sees it: a module that finds coloured blobs, and the standardized serial messages.
#pragma once

#include <cstdint>
#include <string>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// Commands: `setpar serout|serstyle|serprec|serstamp|sermark|serlimit`, `streamon`, `streamoff`, `ping`. `setpar
/// serlog` changes nothing, `setmapping2` loads the module anew whatever it names; any other gets an error. Things are
/// called blob1, blob2 ... by their signature. Its output while it boots is not documented: it is assumed silent and
/// deaf for three seconds.
class JeVois final : public DeviceModel {
 public:
  static constexpr base::Duration kBoot = base::milliseconds(3'000);

  /// The size of the pictures, which no message contains.
  explicit JeVois(int width = 320, int height = 240, base::Time power_on = {})
      : width_(width), height_(height), power_on_(power_on) {}

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t byte, base::Time now) override;
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;

 private:
  [[nodiscard]] std::string obey(const std::string& command);
  [[nodiscard]] bool set(const std::string& name, const std::string& value);
  [[nodiscard]] std::string message(const sensor::Blob& blob) const;
  [[nodiscard]] std::string stamp() const;
  void load_module();

  int width_;
  int height_;
  base::Time power_on_;
  std::string line_;
  std::string output_ = "None";  ///< serout; on a cable to any port of it, Hard, USB and All are the same
  std::string style_;
  int decimals_ = 0;
  std::string stamps_;
  std::string marks_;
  int limit_ = 0;
  bool streaming_ = false;
  std::uint32_t images_ = 0;
};

}  // namespace fencepost::emulate
