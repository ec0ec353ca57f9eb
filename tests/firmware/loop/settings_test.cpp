#include "firmware/config/settings.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fencepost::test {
namespace {

using config::Key;
using config::SettingError;
using config::Settings;

TEST(Settings, StartWithTheDocumentedDefaults) {
  const Settings settings;
  const std::pair<Key, std::string_view> defaults[] = {
      {Key::kAlertStop, "0.25"},   {Key::kAlertWarn, "0.50"},     {Key::kAlertNotice, "1.00"},
      {Key::kAlertTtcStop, "0.8"}, {Key::kAlertTtcWarn, "2.0"},   {Key::kRobotFront, "0.00"},
      {Key::kRobotRear, "0.00"},   {Key::kRobotWidth, "0.20"},    {Key::kRobotMargin, "0.05"},
      {Key::kConfirmK, "3"},       {Key::kConfirmN, "5"},         {Key::kAlertRate, "5"},
      {Key::kCameraNoise, "0.00"}, {Key::kCorrectDrift, "3.0"},   {Key::kCorrectPose, "auto"},
      {Key::kCarCounts, "0.0"},    {Key::kCarWheelbase, "0.000"}, {Key::kSteerScale, "1.000"},
      {Key::kSteerOffset, "0.00"}, {Key::kGyroScale, "1.0000"},   {Key::kGyroBias, "0.000"}};
  static_assert(std::size(defaults) == config::kKeys);
  for (const auto& [key, text] : defaults) EXPECT_EQ(settings.text(key).view(), text) << config::info(key).name;
}

TEST(Settings, TakeEveryKeyWithinItsRangeOnly) {
  for (const config::KeyInfo& entry : config::kKeyInfo) {
    Settings settings;
    if (entry.unit == "off|on|auto") continue;
    if (entry.low >= 0) {
      EXPECT_EQ(settings.set(entry.name, "-1"), SettingError::kOutOfRange) << entry.name;
    }
    EXPECT_EQ(settings.set(entry.name, "10000000"), SettingError::kOutOfRange) << entry.name;
    EXPECT_EQ(settings.set(entry.name, "much"), SettingError::kNotANumber) << entry.name;
    EXPECT_EQ(settings, Settings{}) << entry.name;
    EXPECT_EQ(settings.set(entry.name, entry.name == "car.wheelbase" || entry.name == "gyro.scale" ? "1.5" : "3.5"),
              std::nullopt)
        << entry.name;  // whole numbers round to 4
    EXPECT_FALSE(settings == Settings{}) << entry.name;
  }
}

TEST(Settings, EndsOfTheRobotAreToldInHundredthsOfAMetre) {
  Settings settings;
  for (const char* key : {"robot.front", "robot.rear"}) {
    EXPECT_EQ(settings.set(key, "0.01"), std::nullopt) << key;
    EXPECT_EQ(settings.set(key, "5"), std::nullopt) << key;
    EXPECT_EQ(settings.set(key, "5.01"), SettingError::kOutOfRange) << key;
    EXPECT_EQ(settings.set(key, "-0.01"), SettingError::kOutOfRange) << key;
  }
  EXPECT_FLOAT_EQ(settings.number(Key::kRobotFront), 5);
}

TEST(Settings, SwitchesAreOnOrOff) {
  Settings settings;
  EXPECT_EQ(settings.set("correct.pose", "on"), std::nullopt);
  EXPECT_EQ(settings.text(Key::kCorrectPose).view(), "on");
  EXPECT_EQ(settings.set("correct.pose", "off"), std::nullopt);
  EXPECT_EQ(settings.raw(Key::kCorrectPose), config::kCorrectOff);
  EXPECT_EQ(settings.set("correct.pose", "auto"), std::nullopt);
  EXPECT_EQ(settings.raw(Key::kCorrectPose), config::kCorrectAuto);
  EXPECT_EQ(settings.set("correct.pose", "on"), std::nullopt);
  EXPECT_EQ(settings.set("correct.pose", "1"), SettingError::kNotANumber);
  EXPECT_EQ(settings.set("correct.posture", "on"), SettingError::kUnknownKey);
}

TEST(Settings, NumbersAreInTheirUnit) {
  Settings settings;
  ASSERT_FALSE(settings.set("alert.ttc_stop", "1.25").has_value());  // rounded to its decimals
  EXPECT_FLOAT_EQ(settings.number(Key::kAlertTtcStop), 1.3F);
  EXPECT_FLOAT_EQ(settings.number(Key::kRobotWidth), 0.2F);
  const std::pair<std::string_view, std::pair<Key, float>> told[] = {{"confirm.k", {Key::kConfirmK, 7}},
                                                                     {"correct.drift", {Key::kCorrectDrift, 12.5F}},
                                                                     {"robot.margin", {Key::kRobotMargin, 0.25F}},
                                                                     {"car.wheelbase", {Key::kCarWheelbase, 0.125F}},
                                                                     {"gyro.scale", {Key::kGyroScale, -1.0625F}}};
  for (const auto& [name, value] : told) {
    ASSERT_EQ(settings.set(name, std::to_string(value.second)), std::nullopt) << name;
    EXPECT_EQ(settings.number(value.first), value.second) << name << ": none to four decimals";
  }
}

}  // namespace
}  // namespace fencepost::test
