// Whether a camera that streams by itself was heard lately, and with frames.
#pragma once

#include <optional>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::serial {

struct Hearing {
  std::optional<base::Time> heard;   ///< none: not lately
  std::optional<base::Time> framed;  ///< a good frame, likewise

  void step(base::Time now, base::Duration patience) {
    if (heard && now - *heard > patience) heard.reset();
    if (framed && now - *framed > patience) framed.reset();
  }
  /// kUnready: it talks, and no frame came.
  [[nodiscard]] sensor::LinkState link(const sensor::BlobFrame& latest) const {
    if (!heard) return sensor::LinkState::kSilent;
    if (!framed) return sensor::LinkState::kUnready;
    return latest.blobs.empty() ? sensor::LinkState::kEmpty : sensor::LinkState::kOk;
  }
};

}  // namespace fencepost::serial
