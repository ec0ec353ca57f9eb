// Frames that wait for the odometry at their exposure. At most four, at most 0.2 s of stream time.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::recon {

/// Ids of a camera that tracks are kept in six bits: 1 to this, 0 for none. Ids that differ by a multiple of it, which
/// are seldom in one image, are then the same.
inline constexpr std::uint16_t kMaxTrack = 63;

/// The part of a blob that reconstruction needs, 10 bytes.
struct WaitingBlob {
  Box box;
  std::uint8_t signature = 0;
  bool moves : 1 = false;      ///< by itself; found by looming, not reported by the camera
  bool bearing : 1 = false;    ///< see sensor::Blob: the box has no width and no foot
  std::uint8_t track : 6 = 0;  ///< see sensor::Blob
};

/// Blobs are in canonical order (signature, x1, y1, x2, y2, track): the order in which a camera lists them never
/// matters.
struct WaitingFrame {
  base::Time t;
  std::uint32_t frame = 0;
  std::uint8_t camera = 0;  ///< which of the two calibrations kept was in force when it arrived
  base::FixedVector<WaitingBlob, sensor::kMaxBlobs> blobs;
};

/// Canonical order.
void put_in_order(WaitingFrame& frame);

WaitingFrame make_waiting(const sensor::BlobFrame& frame, std::uint8_t camera);

/// Takes off what boxes are too wide. `pad_of(signature)`: px on each side, see without_pad(). A bearing has no sides.
template <class PadOf>
void take_off_pads(const CameraModel& camera, const PadOf& pad_of, WaitingFrame& frame) {
  bool changed = false;
  for (WaitingBlob& blob : frame.blobs) {
    const std::int16_t pad = blob.bearing ? std::int16_t{0} : pad_of(blob.signature);
    if (pad == 0) continue;
    blob.box = without_pad(camera, blob.box, pad);
    changed = true;
  }
  if (changed) put_in_order(frame);
}

using FrameQueue = base::Ring<WaitingFrame, kMaxWaitingFrames>;

}  // namespace fencepost::recon
