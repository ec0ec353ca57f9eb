#include "drivers/cmucam/dialect.hpp"

#include <array>

namespace fencepost::cmucam {
namespace {

// Half the field of view's tangents.
constexpr double kTanAcross = 0.405042;  // tan(44.1/2 deg)
constexpr double kTanDown = 0.302881;    // tan(33.7/2 deg)

consteval base::Pixels2 focal(double pixels, double tangent) { return base::Pixels2::nearest(pixels / 2 / tangent); }
consteval base::Pixels2 middle(double pixels) { return base::Pixels2::nearest((pixels - 1) / 2); }

// Registers of the OV6620: 18 = 44 white balance on, 40 off (RGB); 19 = 33 gain on, 32 off. A colour window is
// meaningful only while both are frozen.
constexpr std::array<std::string_view, 1> kWarmUpOv6620 = {"CR 18 44 19 33"};               // both on
constexpr std::array<std::string_view, 2> kSetUpOv6620 = {"CR 18 40 19 32", "PM 1"};        // both off
constexpr std::array<std::string_view, 3> kSetUpHigh = {"CR 18 40 19 32", "HR 1", "PM 1"};  // off, high resolution
// The OV7620's registers are not in our sources: it keeps its power-up values.
constexpr std::array<std::string_view, 1> kSetUpOv7620 = {"PM 1"};
// A CMUcam4 has commands for its gain (AG) and white balance (AW).
constexpr std::array<std::string_view, 2> kWarmUp4 = {"AG 1", "AW 1"};         // both on
constexpr std::array<std::string_view, 3> kSetUp4 = {"AG 0", "AW 0", "PM 1"};  // both off

constexpr base::Duration kThreeFramesAt17 = base::milliseconds(200);
constexpr base::Duration kAnswersAtOnce = base::milliseconds(1'000);
constexpr base::Duration kStartsFor2s = base::milliseconds(2'250);
constexpr base::Duration kUsualCommand = base::milliseconds(500);
constexpr base::Duration kCommand4 = base::milliseconds(1'000);
// Its library waits as long for a packet as for an ACK; on a bad cable that costs half of the samples. A packet comes
// with the next frame or two, of 30 /s.
constexpr base::Duration kPacket4 = base::milliseconds(400);

consteval Dialect cmucam2(std::uint16_t width, std::uint16_t height, double rows,
                          std::span<const std::string_view> warm_up, std::span<const std::string_view> set_up) {
  return {.model = "cmucam2",
          .banner = "CMUcam2 v",
          .width = width,
          .height = height,
          .first_pixel = 1,
          .fx = focal(width, kTanAcross),
          .fy = focal(rows, kTanDown),
          .cy = middle(rows),
          .pixels = PixelCount::kUnknown,
          .min_confidence = 2,
          .reset_timeout = kAnswersAtOnce,
          .command_timeout = kUsualCommand,
          .reply_timeout = kThreeFramesAt17,
          .warm_up = warm_up,
          .set_up = set_up};
}

consteval Dialect cmucam3(std::uint16_t width, std::uint16_t height, double rows,
                          std::span<const std::string_view> set_up) {
  Dialect dialect = cmucam2(width, height, rows, kWarmUpOv6620, set_up);
  dialect.model = "cmucam3";
  dialect.first_pixel = 0;
  dialect.pixels = PixelCount::kCount;
  dialect.reset_timeout = kStartsFor2s;
  return dialect;
}

}  // namespace

constexpr Dialect kCmuCam1 = {.model = "cmucam1",
                              .banner = "CMUcam v",
                              .width = 80,
                              .height = 143,
                              .first_pixel = 1,
                              .fx = focal(80, kTanAcross),
                              .fy = focal(143, kTanDown),
                              .cy = middle(143),
                              .pixels = PixelCount::kEighths,
                              .min_confidence = 8,
                              .reset_timeout = kAnswersAtOnce,
                              .command_timeout = kUsualCommand,
                              .reply_timeout = kThreeFramesAt17,
                              .warm_up = kWarmUpOv6620,
                              .set_up = kSetUpOv6620};
constexpr Dialect kCmuCam2 = cmucam2(88, 143, 143, kWarmUpOv6620, kSetUpOv6620);
constexpr Dialect kCmuCam2High = cmucam2(176, 255, 286, kWarmUpOv6620, kSetUpHigh);
constexpr Dialect kCmuCam2Ov7620 = cmucam2(159, 239, 239, {}, kSetUpOv7620);
constexpr Dialect kCmuCam3 = cmucam3(88, 144, 144, kSetUpOv6620);
constexpr Dialect kCmuCam3High = cmucam3(176, 255, 288, kSetUpHigh);
constexpr Dialect kCmuCam4 = {.model = "cmucam4",
                              .banner = "CMUcam4 v",
                              .width = 160,
                              .height = 120,
                              .first_pixel = 0,
                              .has_raw = false,
                              .fx = focal(160, kTanAcross),
                              .fy = focal(120, kTanDown),
                              .cy = middle(120),
                              .pixels = PixelCount::kByConfidence,
                              .min_confidence = 8,
                              .darkest = 0,
                              .brightest = 255,
                              .reset_timeout = kStartsFor2s,
                              .command_timeout = kCommand4,
                              .reply_timeout = kPacket4,
                              .warm_up = kWarmUp4,
                              .set_up = kSetUp4};

sensor::CameraIntrinsics nominal_intrinsics(const Dialect& dialect, const sensor::CameraMount& mount) {
  sensor::CameraIntrinsics intrinsics;
  intrinsics.model = dialect.model;
  intrinsics.width = dialect.width;
  intrinsics.height = dialect.height;
  intrinsics.fx = dialect.fx;
  intrinsics.fy = dialect.fy;
  intrinsics.cx = {(dialect.width - 1) * base::Pixels2::kPerUnit / 2};
  intrinsics.cy = dialect.cy;
  intrinsics.mount = mount;
  intrinsics.latency = dialect.has_raw ? base::milliseconds(88) : base::milliseconds(50);
  return intrinsics;
}

}  // namespace fencepost::cmucam
