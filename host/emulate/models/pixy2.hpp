// A Pixy2 as its cable sees it: UART, I2C and SPI carry the same bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "host/emulate/models/not_emulated.hpp"

namespace fencepost::emulate {

/// Firmware 3.0.20. For half a second after power-on it says nothing, then that it is busy, until it is ready.
class Pixy2 {
 public:
  static constexpr base::Duration kDeaf = base::milliseconds(500);
  static constexpr base::Duration kBusy = base::milliseconds(1'500);
  static constexpr base::Duration kProgramChange = base::milliseconds(80);
  /// Images: its "Block filtering" of 3 gives a lost block up after 24 ms, in the next image; they are 16.4 ms apart.
  static constexpr int kRepeated = 2;

  explicit Pixy2(base::Time power_on) : power_on_(power_on) {}

  /// A byte from the host; out: what the camera answers to it.
  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time now);

  /// A new image, in which these blobs are, in our convention; what was read of the last one does not matter. One near
  /// to a block of the image before has its index. A lost block is repeated in kRepeated images.
  void see(const std::vector<sensor::Blob>& blobs);
  /// The same without repeats: the next blocks are these blobs.
  void show(const std::vector<sensor::Blob>& blobs);
  /// Power off and on.
  void restart(base::Time now);
  /// Which program runs after power-on.
  void set_default_program(const std::string& name) { default_program_ = program_ = name; }
  /// Somebody holds the button.
  void hold_button(bool held) { button_ = held; }

  /// Whether blocks were ever asked for.
  [[nodiscard]] bool asked() const { return asked_; }
  /// Requests that it does not know, and those that it acknowledges though they change nothing here.
  [[nodiscard]] const std::vector<std::string>& not_emulated() const { return not_emulated_.names(); }

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Block {
    sensor::Blob blob;
    std::uint8_t index = 0;  ///< of its tracker
    std::uint8_t age = 0;    ///< frames before this one that had it
    int repeats = 0;         ///< images that it is repeated in, when it is lost
  };

  void follow(const std::vector<sensor::Blob>& blobs, int repeated);
  [[nodiscard]] bool whole() const;
  Bytes answer(std::uint8_t type, const Bytes& data, base::Time now);
  Bytes answer_program(const Bytes& data, base::Time now);
  Bytes answer_blocks(const Bytes& data);
  static void put(Bytes& bytes, const Block& block);
  static Bytes packet(std::uint8_t type, const Bytes& data);
  static Bytes error(int code);

  base::Time power_on_;
  base::Time changed_{-1'000'000};
  std::string default_program_ = "color_connected_components";
  std::string program_ = default_program_;
  bool button_ = false;
  bool frame_is_new_ = false;
  bool asked_ = false;
  std::vector<Block> blocks_;
  std::uint8_t next_index_ = 0;
  Bytes received_;
  NotEmulated not_emulated_;
};

}  // namespace fencepost::emulate
