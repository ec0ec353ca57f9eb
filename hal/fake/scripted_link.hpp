// A byte link that plays a script: chunks as they might arrive, with gaps and faults between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/base/fixed.hpp"
#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::fake {

/// One event on the line: bytes, or one failed read.
struct LinkStep {
  std::span<const std::uint8_t> bytes;
  std::optional<base::Error> error;
};

/// Reads never join two steps, as a real port's reads do not wait for more. After the script: kNotReady.
/// What is written is kept, at most `Capacity` bytes in all.
template <std::size_t Capacity>
class ScriptedLink {
 public:
  /// The script and its bytes are borrowed.
  constexpr explicit ScriptedLink(std::span<const LinkStep> script) : script_(script) {}

  constexpr base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    while (step_ < script_.size()) {
      const LinkStep& step = script_[step_];
      if (step.error) {
        next_step();
        return *step.error;
      }
      if (offset_ == step.bytes.size()) {
        next_step();
        continue;
      }
      std::size_t count = 0;
      while (count < in.size() && offset_ < step.bytes.size()) in[count++] = step.bytes[offset_++];
      return count;
    }
    return base::Error::kNotReady;
  }

  constexpr base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (gone_) return base::Error::kGone;
    std::size_t count = 0;
    while (count < out.size() && count < write_limit_ && written_.push_back(out[count])) ++count;
    if (count == 0 && !out.empty()) return base::Error::kFull;
    return count;
  }

  /// At most this many bytes a call from now on; 0 is a port that takes nothing.
  constexpr void limit_writes(std::size_t bytes) { write_limit_ = bytes; }
  /// Writes answer kGone until replugged; reads follow the script.
  constexpr void unplug() { gone_ = true; }
  constexpr void replug() { gone_ = false; }

  [[nodiscard]] constexpr std::span<const std::uint8_t> written() const { return written_.view(); }
  [[nodiscard]] constexpr bool finished() const { return step_ == script_.size(); }

 private:
  constexpr void next_step() {
    ++step_;
    offset_ = 0;
  }

  std::span<const LinkStep> script_;
  std::size_t step_ = 0;
  std::size_t offset_ = 0;
  std::size_t write_limit_ = Capacity;
  bool gone_ = false;
  base::FixedVector<std::uint8_t, Capacity> written_;
};

static_assert(bus::ByteLink<ScriptedLink<64>>);

}  // namespace fencepost::fake
