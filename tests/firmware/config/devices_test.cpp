// The devices that there are, their lenses, and the choices that cannot be had together.
#include "firmware/config/devices.hpp"

#include <gtest/gtest.h>

#include <string>

#include "drivers/odometry/wheel_base.hpp"
#include "drivers/pixy2/camera.hpp"
#include "firmware/config/about_image.hpp"
#include "firmware/config/car.hpp"

namespace fencepost::config {
namespace {

constexpr DeviceLimits everything() { return {(1U << kCameraIds) - 1, (1U << kOdometryIds) - 1, false, 0, true, {}}; }

TEST(CarSettings, AreTheCarsGeometry) {
  Settings settings;
  EXPECT_EQ(car_of(settings).gyro_scale, 10'000);
  EXPECT_EQ(car_of(settings).steer_scale, 1'000);
  EXPECT_EQ(car_of(settings).pm_per_count, 0) << "not configured";
  for (const auto& [key, value] : {std::pair("car.counts", "-2000"),
                                   {"car.wheelbase", "0.17"},
                                   {"steer.scale", "-1.5"},
                                   {"steer.offset", "1.8"},
                                   {"gyro.scale", "1.02"},
                                   {"gyro.bias", "0.9"}}) {
    ASSERT_EQ(settings.set(key, value), std::nullopt) << key;
  }
  const odometry::CarGeometry car = car_of(settings);
  EXPECT_EQ(car.pm_per_count, -500'000'000);  // half a millimetre, backwards
  EXPECT_EQ(car.wheelbase_um, 170'000);
  EXPECT_EQ(car.steer_scale, -1'500);
  EXPECT_EQ(car.steer_offset_urad, 31'416);  // 1.8 deg
  EXPECT_EQ(car.gyro_scale, 10'200);
  EXPECT_EQ(car.gyro_bias_urad_s, 15'708);  // 0.9 deg/s
}

TEST(AboutImage, SaysWhatTheImageIsAndBeginsWith) {
  DeviceLimits limits{0b1010, 0b101, true, 8, true, Devices(CameraId::kPixy2, OdometryId::kConsole)};
  const AboutImage about = about_image("0.1.0", 7, limits);
  EXPECT_EQ(std::string(about.mark.begin(), about.mark.end()), "fencepost image 2");
  EXPECT_EQ(std::string(about.version.begin(), about.version.end()), std::string("0.1.0") + std::string(9, '\0'));
  EXPECT_EQ(about.signatures, 7);
  EXPECT_EQ(about.cameras, 0b1010U);
  EXPECT_EQ(about.odometries, 0b101U);
  EXPECT_EQ(about.one_line, 1U);
  EXPECT_EQ(about.lowest_address, 8U);
  EXPECT_EQ(about.motors, 1U);
  for (std::size_t i = 0; i < kDeviceKeys; ++i)
    EXPECT_EQ(about.initial[i], limits.initial.raw(static_cast<DeviceKey>(i)));
  limits.one_line = limits.motors = false;
  EXPECT_EQ(about_image("", 0, limits).one_line + about_image("", 0, limits).motors, 0U);
  const AboutImage cut = about_image("1.2.3-and-much-more", 1, limits);  // too long: its end is left out
  EXPECT_EQ(std::string(cut.version.begin(), cut.version.end()), "1.2.3-and-much");
  EXPECT_EQ(cut.signatures, 1);
}

TEST(Devices, EachCameraButTheConsolesHasACalibration) {
  for (std::size_t i = 0; i < kCameraIds; ++i) {
    const auto id = static_cast<CameraId>(i);
    const sensor::CameraIntrinsics camera = delivered_calibration(id);
    EXPECT_EQ(camera.width > 0, id != CameraId::kConsole) << info(id).name;
    EXPECT_EQ(camera.width > 0, camera.fx.raw > 0) << info(id).name;
    EXPECT_EQ(camera_named(info(id).name), id);
    EXPECT_LE(info(id).name.size(), sensor::kMaxText);
  }
  for (std::size_t i = 0; i < kOdometryIds; ++i)
    EXPECT_EQ(odometry_named(kOdometries[i].name), static_cast<OdometryId>(i));
  EXPECT_EQ(camera_named("pixy3"), static_cast<CameraId>(kCameraIds));
}

// 158 px by tan 40 deg, and by tan 30 deg.
TEST(Devices, AWiderLensIsTheOtherCamera) {
  Devices devices(CameraId::kPixy2, OdometryId::kConsole);
  EXPECT_EQ(devices.calibration(), pixy2::kPixy2Profile);
  ASSERT_FALSE(devices.set("lens", "80"));
  EXPECT_NEAR(devices.calibration().fx.raw, 18'830, 1);
  EXPECT_NEAR(devices.calibration().fy.raw, 18'830, 1);
  EXPECT_EQ(devices.calibration().cx, pixy2::kPixy2Profile.cx);
  ASSERT_FALSE(devices.set("camera", "pixy2.1"));
  ASSERT_FALSE(devices.set("lens", "60"));
  EXPECT_NEAR(devices.calibration().fx.raw, 27'366, 1);
  ASSERT_FALSE(devices.set("lens", "0"));
  EXPECT_EQ(devices.calibration(), pixy2::kPixy21Profile);
}

// 316 px over 2.618 rad: half of them are 75 degrees, by the angle itself. The robot's and the board's floats agree.
TEST(Devices, AFisheyeIsEquidistant) {
  Devices devices(CameraId::kPixy2, OdometryId::kConsole);
  ASSERT_FALSE(devices.set("lens", "150"));
  EXPECT_EQ(devices.calibration().lens, sensor::Lens::kEquidistant);
  EXPECT_NEAR(devices.calibration().fx.raw, 12'070, 1);
  EXPECT_NEAR(devices.calibration().fy.raw, 12'070, 1);
  ASSERT_FALSE(devices.set("lens", "101"));
  EXPECT_EQ(devices.calibration().lens, sensor::Lens::kEquidistant);
  ASSERT_FALSE(devices.set("lens", "100"));
  EXPECT_EQ(devices.calibration().lens, sensor::Lens::kPinhole);
  ASSERT_FALSE(devices.set("lens", "0"));
  EXPECT_EQ(devices.calibration(), pixy2::kPixy2Profile);
}

// As the robot says them in FPCAM, to the last hundredth of a pixel.
TEST(Devices, LensesToTheLastHundredthOfAPixel) {
  const struct {
    CameraId camera;
    const char* degrees;
    std::int32_t fx, fy;
  } cases[] = {{CameraId::kPixy2, "60", 27'365, 27'365},     {CameraId::kPixy2, "100", 13'257, 13'257},
               {CameraId::kPixy2, "101", 17'925, 17'925},    {CameraId::kPixy2, "150", 12'070, 12'070},
               {CameraId::kHuskylens, "75", 20'850, 20'850}, {CameraId::kCmucam2, "44", 10'890, 23'665},
               {CameraId::kCmucam3, "120", 4'202, 9'194},    {CameraId::kJevois, "65", 25'114, 25'114}};
  for (const auto& [camera, degrees, fx, fy] : cases) {
    Devices devices(camera, OdometryId::kConsole);
    ASSERT_FALSE(devices.set("lens", degrees));
    EXPECT_EQ(devices.calibration().fx.raw, fx) << info(camera).name << ' ' << degrees;
    EXPECT_EQ(devices.calibration().fy.raw, fy) << info(camera).name << ' ' << degrees;
  }
}

TEST(Devices, AConsolesCameraHasNoLensOfItsOwn) {
  Devices devices(CameraId::kConsole, OdometryId::kConsole);
  ASSERT_FALSE(devices.set("lens", "60"));
  EXPECT_EQ(devices.calibration(), sensor::CameraIntrinsics{});
}

TEST(Devices, SaysWhatIsNoValue) {
  Devices devices;
  const Devices before = devices;
  EXPECT_EQ(devices.set("camera", "pixy3"), SettingError::kOutOfRange);
  EXPECT_EQ(devices.set("odometry", "pixy2"), SettingError::kOutOfRange);
  EXPECT_EQ(devices.set("lens", "151"), SettingError::kOutOfRange);
  EXPECT_EQ(devices.set("lens", "wide"), SettingError::kNotANumber);
  EXPECT_EQ(devices.set("alert.stop", "0.3"), SettingError::kUnknownKey);
  EXPECT_EQ(devices, before);
  for (std::size_t i = 0; i < kDeviceKeys; ++i) {
    const auto key = static_cast<DeviceKey>(i);
    const sensor::Text text = devices.text(key);
    EXPECT_FALSE(devices.set(info(key).name, text.view())) << info(key).name;
  }
  EXPECT_EQ(devices, before);
}

// Doubles on the desk, integers on the robot.
TEST(Devices, WheelsAreThoseOfTheirDrawing) {
  struct {
    const char* diameter;
    const char* counts;
    const char* track;
    odometry::WheelBase drawn;
  } const cases[] = {{"65.0", "1440", "130.0", odometry::make_wheel_base({65.0, 1'440.0}, 130.0, 16)},
                     {"60.0", "585", "155", odometry::make_wheel_base({60.0, 585.0}, 155.0, 16)},
                     {"72", "-508.8", "235", odometry::make_wheel_base({72.0, -508.8}, 235.0, 16)}};
  for (const auto& one : cases) {
    Devices devices;
    ASSERT_FALSE(devices.set("wheel.diameter", one.diameter));
    ASSERT_FALSE(devices.set("wheel.counts", one.counts));
    ASSERT_FALSE(devices.set("wheel.track", one.track));
    const odometry::WheelBase wheels = devices.wheels(16);
    EXPECT_NEAR(static_cast<double>(wheels.left_pm_per_count), static_cast<double>(one.drawn.left_pm_per_count), 1);
    EXPECT_EQ(wheels.left_pm_per_count, wheels.right_pm_per_count);
    EXPECT_EQ(wheels.track_pm, one.drawn.track_pm);
  }
}

// Picometres of a count, rounded: pi times 65.0 mm by 1440 counts is 141,808,001.7 pm.
TEST(Devices, WheelsToTheLastPicometre) {
  const struct {
    const char* diameter;
    const char* counts;
    std::int64_t pm;
  } cases[] = {{"65", "1440", 141808002},
               {"186.8", "622.9", 942124752},
               {"156.5", "515.1", 954492818},
               {"39.5", "-2143.7", -57887256}};
  for (const auto& [diameter, counts, pm] : cases) {
    Devices devices;
    ASSERT_FALSE(devices.set("wheel.diameter", diameter));
    ASSERT_FALSE(devices.set("wheel.counts", counts));
    EXPECT_EQ(devices.wheels(16).left_pm_per_count, pm) << diameter << ' ' << counts;
    EXPECT_EQ(devices.wheels(16).right_pm_per_count, pm) << diameter << ' ' << counts;
  }
  EXPECT_EQ(Devices().wheels(32).counter_bits, 32);
  EXPECT_EQ(Devices().wheels(16).track_pm, 130'000'000'000);
}

Refusal refused(std::string_view camera, std::string_view odometry, const DeviceLimits& limits) {
  return refusal(Devices(camera_named(camera), odometry_named(odometry)), limits);
}

TEST(Devices, RefusesWhatCannotWork) {
  DeviceLimits pico = everything();
  pico.one_line = true;
  pico.lowest_address = 8;
  EXPECT_EQ(refused("pixy2", "create2", pico), Refusal::kOneLine);
  EXPECT_EQ(refused("pixy2_i2c", "create2", pico), Refusal::kNone);
  EXPECT_EQ(refused("pixy2", "encoders", pico), Refusal::kNone);
  EXPECT_EQ(refused("nxtcam_i2c", "console", pico), Refusal::kAddress);
  EXPECT_EQ(refused("nxtcam", "console", pico), Refusal::kNone);
  EXPECT_EQ(refused("pixy2", "create2", everything()), Refusal::kNone);
  EXPECT_EQ(refused("nxtcam_i2c", "console", everything()), Refusal::kNone);
  DeviceLimits microbit;
  microbit.cameras = 1U << static_cast<unsigned>(CameraId::kPixy2I2c);
  microbit.odometries = 1;
  EXPECT_EQ(refused("pixy2_i2c", "console", microbit), Refusal::kNone);
  EXPECT_EQ(refused("pixy2", "console", microbit), Refusal::kCameraNotInImage);
  EXPECT_EQ(refused("pixy2_i2c", "encoders", microbit), Refusal::kOdometryNotInImage);
  EXPECT_EQ(refused("pixy3", "console", everything()), Refusal::kCameraNotInImage);
  DeviceLimits one = everything();
  one.lowest_address = 1;
  EXPECT_EQ(refused("nxtcam_i2c", "console", one), Refusal::kNone) << "the lowest it speaks to";
  one.lowest_address = 2;
  EXPECT_EQ(refused("nxtcam_i2c", "console", one), Refusal::kAddress);
  EXPECT_EQ(refused("console", "create2", pico), Refusal::kNone) << "one of them has the line";
}

TEST(Devices, AnImageContainsWhatItsBitsSay) {
  for (std::size_t i = 0; i < kCameraIds; ++i) {
    DeviceLimits only;
    only.cameras = 1U << i;
    for (std::size_t k = 0; k < kCameraIds; ++k) EXPECT_EQ(only.contains(static_cast<CameraId>(k)), i == k);
  }
  for (std::size_t i = 0; i < kOdometryIds; ++i) {
    DeviceLimits only;
    only.odometries = 1U << i;
    for (std::size_t k = 0; k < kOdometryIds; ++k) EXPECT_EQ(only.contains(static_cast<OdometryId>(k)), i == k);
  }
}

TEST(Devices, RefusesALensThatNobodyKnowsAndWheelsWithoutCounts) {
  Devices devices(CameraId::kConsole, OdometryId::kEncoders);
  ASSERT_FALSE(devices.set("lens", "60"));
  EXPECT_EQ(refusal(devices, everything()), Refusal::kNoLens);
  ASSERT_FALSE(devices.set("camera", "pixy2"));
  EXPECT_EQ(refusal(devices, everything()), Refusal::kNone) << "a camera of its own may have another lens";
  ASSERT_FALSE(devices.set("camera", "console"));
  ASSERT_FALSE(devices.set("lens", "0"));
  ASSERT_FALSE(devices.set("wheel.counts", "0"));
  EXPECT_EQ(refusal(devices, everything()), Refusal::kNoCounts);
  EXPECT_NE(reason(Refusal::kNoCounts), "");
}

TEST(Devices, RefusesToDriveWhatTheBoardHasNot) {
  Devices devices(CameraId::kPixy2, OdometryId::kConsole);
  EXPECT_EQ(devices.raw(DeviceKey::kBumper), 0) << "off at first";
  ASSERT_FALSE(devices.set("bumper", "40"));
  EXPECT_EQ(refusal(devices, everything()), Refusal::kNone);
  DeviceLimits without = everything();
  without.motors = false;
  EXPECT_EQ(refusal(devices, without), Refusal::kNoMotors);
  EXPECT_EQ(refused("pixy2", "console", without), Refusal::kNone) << "it is not asked to";
  EXPECT_NE(reason(Refusal::kNoMotors), "");
}

}  // namespace
}  // namespace fencepost::config
