// Speaks as a KIPR XBC that runs fencepost_xbc.ic.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace fencepost::emulate {

/// A blob as the XBC's tracking functions report it.
struct XbcBlob {
  int channel = 0;
  int index = 0;
  int x = 0;
  int y = 0;
  int size = 0;
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  int angle = 0;  ///< mrad
};

/// 100 * area / (area of the box), as the XBC has it.
int xbc_confidence(const XbcBlob& blob);

class XbcDevice {
 public:
  std::string power_up();
  std::string feed(std::string_view bytes);
  /// The next frame.
  std::string frame(std::span<const XbcBlob> blobs);

  /// The number that the next frame will have.
  void set_frame_number(std::uint32_t number) { number_ = number; }

 private:
  std::uint32_t number_ = 1;
};

}  // namespace fencepost::emulate
