// A camera of the kernel (Video for Linux): a webcam on USB, a camera module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/retry.hpp"

namespace fencepost::linux {

/// How pictures come.
enum class PictureCoding : std::uint8_t {
  kYuyv,  ///< rows of Y U Y V
  kJpeg,  ///< each a JPEG file
};

struct V4l2Settings {
  std::string path;  ///< such as /dev/video0
  std::uint16_t width = 320;
  std::uint16_t height = 240;
  std::uint32_t rate = 30;  ///< pictures a second, as near as the camera can
  /// Tried in this order.
  std::vector<PictureCoding> codings = {PictureCoding::kYuyv, PictureCoding::kJpeg};
};

/// Borrowed until the next call of `next`.
struct CodedPicture {
  PictureCoding coding = PictureCoding::kYuyv;
  std::uint16_t width = 0;
  std::uint16_t height = 0;
  std::size_t stride = 0;  ///< bytes from row to row; of a JPEG 0
  std::span<const std::uint8_t> bytes;
  base::Time t;  ///< the kernel's stamp, on the clock that `tend` is given
};

/// Pictures are read where the kernel writes them (mmap), the newest only: a loop that was late does not see old ones.
class V4l2 {
 public:
  /// errors: a sentence: missing, not allowed, in use, no camera, or one that has no such picture.
  static Opened<V4l2> open(V4l2Settings settings);
  ~V4l2();
  V4l2(V4l2&&) noexcept = default;
  V4l2& operator=(V4l2&& other) noexcept;
  V4l2(const V4l2&) = delete;
  V4l2& operator=(const V4l2&) = delete;

  /// errors: kNotReady, kBadInput for a picture that was damaged on its way, kGone
  base::Result<CodedPicture> next();

  /// Once per loop iteration; opens the path again after the camera was gone, at most every kRetryInterval.
  void tend(base::Time now);
  [[nodiscard]] bool connected() const { return fd_.open(); }
  /// Why the last try to open it again failed; empty when none did.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// For WaitSet.
  [[nodiscard]] int descriptor() const { return fd_.get(); }

 private:
  explicit V4l2(V4l2Settings settings) : settings_(std::move(settings)) {}
  Opened<Descriptor> start();
  int map(int fd);
  bool queue(std::uint32_t buffer);
  void give_back();
  void close();
  [[nodiscard]] base::Time on_our_clock(std::int64_t stamp_us) const;

  V4l2Settings settings_;
  Descriptor fd_;
  PictureCoding coding_ = PictureCoding::kYuyv;
  std::size_t stride_ = 0;
  std::vector<std::span<std::uint8_t>> buffers_;  ///< mapped
  int held_ = -1;                                 ///< the buffer that was given last; -1: none
  base::Time now_;
  std::int64_t now_us_ = 0;  ///< the kernel's monotonic clock at `now_`
  Retry retry_;
  std::string problem_;
};

}  // namespace fencepost::linux
