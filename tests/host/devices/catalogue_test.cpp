// What has to be true of every row, and of the documents that show them.
#include "host/devices/catalogue.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <type_traits>

#include "firmware/config/devices.hpp"
#include "host/devices/emulated.hpp"
#include "host/devices/open_devices.hpp"
#include "host/devices/tables.hpp"

namespace fencepost::devices {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = FENCEPOST_SOURCE_DIR;
constexpr Use kUses[] = {Use::kCamera, Use::kOdometry, Use::kEmulated};

// What a row leaves out does not compile: these have no default.
static_assert(!std::is_default_constructible_v<Row>);
static_assert(!std::is_default_constructible_v<Live>);
static_assert(!std::is_default_constructible_v<Emulated>);
static_assert(!std::is_default_constructible_v<CameraDriver>);
static_assert(!std::is_default_constructible_v<OdometryDriver>);
static_assert(!std::is_default_constructible_v<Option>);
static_assert(!std::is_constructible_v<Given<emulate::Describe>, std::nullptr_t>);

TEST(Catalogue, NamesAreUniqueInEachUse) {
  for (const Use use : kUses) {
    std::set<std::string> names;
    for (const Row* row : rows_for(use)) EXPECT_TRUE(names.insert(*row->name).second) << *row->name;
    EXPECT_GT(names.size(), 5U);
  }
}

TEST(Catalogue, EveryRowHasAUse) {
  std::set<const Row*> used;
  for (const Use use : kUses) {
    for (const Row* row : rows_for(use)) used.insert(row);
  }
  EXPECT_EQ(used.size(), catalogue().size());
}

TEST(Catalogue, EveryCameraWithACableCanBeEmulatedInItsOwnImage) {
  for (const Row* row : rows_for(Use::kCamera)) {
    const auto nominal = nominal_camera(*row);
    if (!nominal) continue;  // the console
    ASSERT_TRUE(row->emulated->has_value()) << *row->name;
    const auto& image = (*row->emulated)->image;
    ASSERT_TRUE(image.has_value()) << *row->name;
    EXPECT_EQ(image->width, nominal->width) << *row->name;
    EXPECT_EQ(image->height, nominal->height) << *row->name;
    EXPECT_GT(image->max_rate, 0) << *row->name;
  }
}

/// A place that the row can have, as written behind its name.
std::string some_place(const Row& row, Use use) {
  switch (places_of(row, use).front()) {
    case PlaceKind::kTty: return ":/dev/no";
    case PlaceKind::kI2c: return ":/dev/i2c-250";
    case PlaceKind::kUsb: return ":usb";
    case PlaceKind::kCan: return ":nocan0";
    case PlaceKind::kTcp:
    case PlaceKind::kSpi:
    case PlaceKind::kNxt:
    case PlaceKind::kNone: break;
  }
  return "";
}

TEST(Catalogue, WhatAnOptionIsWithoutBeingGivenMayBeGiven) {
  for (const Use use : kUses) {
    for (const Row* row : rows_for(use)) {
      for (const Option& option : options_of(*row, use)) {
        if (std::holds_alternative<AnyText>(*option.values)) continue;
        if (!option.places.empty() && option.places.front() != places_of(*row, use).front()) continue;
        const std::string word = *row->name + some_place(*row, use) + "," + *option.name + "=" + *option.fallback;
        const auto spec = parse_device(word, use);
        EXPECT_TRUE(spec.ok()) << spec.error();
      }
    }
  }
}

TEST(Catalogue, EveryEmulatedDeviceSwitchesOn) {
  for (const Row* row : rows_for(Use::kEmulated)) {
    const auto spec = parse_device(
        *row->name + (places_of(*row, Use::kEmulated).front() == PlaceKind::kCan ? ":x" : ""), Use::kEmulated);
    ASSERT_TRUE(spec.ok()) << spec.error();
    const auto model = emulated(*spec).make([](std::uint8_t) { return std::optional<sensor::Rgb>(); });
    ASSERT_NE(model, nullptr) << *row->name;
    static_cast<void>(model->power_up(base::Time{}));
  }
}

TEST(Catalogue, HelpNamesEveryDeviceAndItsOptions) {
  for (const Use use : kUses) {
    const std::string help = help_for(use);
    for (const Row* row : rows_for(use)) {
      EXPECT_NE(help.find("  " + *row->name + " "), std::string::npos) << *row->name;
      for (const Option& option : options_of(*row, use)) {
        EXPECT_NE(help.find(*option.name + "="), std::string::npos) << *row->name << ": " << *option.name;
      }
    }
  }
  EXPECT_NE(help_for(Use::kCamera).find("at /dev/i2c-N, nxt, /dev/tty..., tcp:HOST:PORT"), std::string::npos);
  EXPECT_NE(help_for(Use::kEmulated).find("tick=0.0001 track=0.235 layout=canopen|talon"), std::string::npos);
}

// What a board can have is in the catalogue, through the same lens; `encoders` are the board's own.
TEST(Catalogue, KnowsEveryDeviceOfABoardsImage) {
  std::set<std::string> known = {"odometry encoders"};
  for (const Row& row : catalogue()) {
    for (const std::string& image : row.images) {
      known.insert((*row.role == Role::kCamera ? "camera " : "odometry ") + image);
      if (*row.role == Role::kCamera) {
        const auto nominal = nominal_camera(row).value_or(sensor::CameraIntrinsics{});
        EXPECT_EQ(nominal, config::delivered_calibration(config::camera_named(image))) << image;
      }
    }
  }
  std::set<std::string> there;
  for (const config::DeviceInfo& camera : config::kCameras) there.insert("camera " + std::string(camera.name));
  for (const config::DeviceInfo& odometry : config::kOdometries) there.insert("odometry " + std::string(odometry.name));
  EXPECT_EQ(known, there);
}

// What a camera sees is from its maker, from others, or assumed, and says which.
TEST(Catalogue, EveryLensHasItsSource) {
  std::size_t lenses = 0;
  for (const Row* row : rows_for(Use::kCamera)) {
    const auto nominal = nominal_camera(*row);
    const std::string& source = *std::get<CameraDriver>((*row->live)->driver).lens;
    const std::string kind = source.substr(0, source.find(": "));
    if (!nominal) {
      EXPECT_EQ(kind, "told") << *row->name;
      continue;
    }
    ++lenses;
    EXPECT_GT(nominal->fx.raw, 0) << *row->name;
    EXPECT_TRUE(kind == "maker" || kind == "published" || kind == "assumed") << *row->name << ": " << source;
    EXPECT_GT(source.size(), kind.size() + 10) << *row->name;
  }
  EXPECT_GE(lenses, 19U);
}

TEST(Catalogue, TheDocumentShowsIt) {
  std::ostringstream shown;
  shown << std::ifstream(kSource / "host/share/doc/devices.md").rdbuf();
  const std::string now = devices_document();
  if (shown.str() == now) return;
  const fs::path copy = fs::absolute("devices.md");
  std::ofstream(copy) << now;
  FAIL() << "the catalogue says otherwise: cp " << copy.string() << " host/share/doc/devices.md";
}

}  // namespace
}  // namespace fencepost::devices
