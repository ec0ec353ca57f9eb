// The rules for every row of the catalogue, and for the documents that show them.
#include "host/devices/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <type_traits>

#include "firmware/config/devices.hpp"
#include "host/devices/coverage.hpp"
#include "host/devices/emulated.hpp"
#include "host/devices/open_devices.hpp"
#include "host/devices/tables.hpp"

namespace fencepost::devices {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = FENCEPOST_SOURCE_DIR;
constexpr Use kUses[] = {Use::kCamera, Use::kOdometry, Use::kEmulated};

// A row that leaves one of these out does not compile: they have no default.
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
    // Cameras that deliver pictures are played by films.
    if (has(places_of(*row, Use::kCamera), PlaceKind::kVideo) || has(places_of(*row, Use::kCamera), PlaceKind::kFilm))
      continue;
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
    case PlaceKind::kVideo: return ":/dev/video250";
    case PlaceKind::kFilm: return ":no.y4m";
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

// Every device that a board can have is in the catalogue, with the same lens; `encoders` are the board's own.
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

/// All sources under a folder, in one text.
std::string sources(const fs::path& folder) {
  std::ostringstream all;
  for (const auto& file : fs::recursive_directory_iterator(folder)) {
    if (file.path().extension() == ".cpp" || file.path().extension() == ".hpp") {
      all << std::ifstream(file.path()).rdbuf();
    }
  }
  return all.str();
}

/// Whether "Suite.Name" is a test, or "KIND:LINK" a case of the hostile hours, in `text`.
bool is_test(const std::string& text, const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return text.find("\"" + name + "\"") != std::string::npos;
  const std::string arguments = "(" + name.substr(0, dot) + ", " + name.substr(dot + 1) + ")";
  return text.find("TEST" + arguments) != std::string::npos || text.find("TEST_F" + arguments) != std::string::npos;
}

TEST(Catalogue, WhatItWasTriedWithIsThere) {
  const std::string guest = sources(kSource / "tests/guest");
  const std::string drivers = sources(kSource / "tests/drivers");
  EXPECT_FALSE(is_test(guest, "RunOnCamera.NoSuchTest"));
  EXPECT_FALSE(is_test(drivers, "pixy2:nowhere"));
  int named = 0;
  for (const Row& row : catalogue()) {
    for (const Tried& tried : row.tried) {
      ASSERT_TRUE(row.live->has_value()) << *row.name;
      EXPECT_TRUE(std::ranges::count((*row.live)->places, tried.link) == 1) << *row.name << ": no such link";
      EXPECT_EQ(std::ranges::count(row.tried, tried.link, &Tried::link), 1) << *row.name << ": a link twice";
      EXPECT_TRUE(tried.bench.empty() || is_test(drivers, tried.bench)) << *row.name << ": " << tried.bench;
      EXPECT_TRUE(tried.guest.empty() || is_test(guest, tried.guest)) << *row.name << ": " << tried.guest;
      named += (tried.bench.empty() ? 0 : 1) + (tried.guest.empty() ? 0 : 1);
    }
  }
  EXPECT_GT(named, 10);
}

TEST(Catalogue, CoverageHasALineForEachDeviceAndLink) {
  const std::string table = coverage_table();
  std::set<std::string> lines;
  std::istringstream text(table);
  for (std::string line; std::getline(text, line);) EXPECT_TRUE(lines.insert(line).second) << line;
  std::size_t links = 0;
  for (const Use use : {Use::kCamera, Use::kOdometry}) {
    for (const Row* row : rows_for(use)) {
      for (const PlaceKind place : places_of(*row, use)) links += place != PlaceKind::kTcp && place != PlaceKind::kNone;
    }
  }
  EXPECT_EQ(lines.size(), 1 + links + 1) << "heading, links, and a board's encoders";
  EXPECT_TRUE(lines.contains("nxtcam,NXT brick,emulate,yes,\"emulator only\""));
  EXPECT_TRUE(lines.contains("xbc,serial,emulate,,\"emulator only\""));
  EXPECT_NE(table.find("pixy2,serial,emulate,,\"Arduino library"), std::string::npos);
}

TEST(Catalogue, TheDocumentHasEveryDeviceOfABoard) {
  const std::string document = devices_document();
  for (const config::DeviceInfo& camera : config::kCameras) {
    EXPECT_NE(document.find("`" + std::string(camera.name) + "`"), std::string::npos) << camera.name;
  }
}

// A camera's field of view is from its maker, from others, or assumed, and says which.
TEST(Catalogue, EveryLensHasItsSource) {
  std::size_t lenses = 0;
  for (const Row* row : rows_for(Use::kCamera)) {
    const auto nominal = nominal_camera(*row);
    const std::string& source = *std::get<CameraDriver>((*row->live)->driver).lens;
    const std::string kind = source.substr(0, source.find(": "));
    if (!nominal) {
      EXPECT_EQ(kind, "given") << *row->name;
      continue;
    }
    ++lenses;
    EXPECT_GT(nominal->fx.raw, 0) << *row->name;
    EXPECT_TRUE(kind == "maker" || kind == "published" || kind == "assumed") << *row->name << ": " << source;
    EXPECT_GT(source.size(), kind.size() + 10) << *row->name;
  }
  EXPECT_GE(lenses, 19U);
}

void expect_written(const std::string& page, const std::string& now) {
  std::ostringstream shown;
  shown << std::ifstream(kSource / page).rdbuf();
  if (shown.str() == now) return;
  const fs::path copy = fs::absolute(page);
  fs::create_directories(copy.parent_path());
  std::ofstream(copy) << now;
  FAIL() << "the catalogue says otherwise: cp " << copy.string() << " " << page;
}

TEST(Catalogue, TheDocumentShowsIt) { expect_written("host/share/doc/devices.md", devices_document()); }

TEST(Catalogue, TheResultsShowIt) { expect_written("tests/results/devices.csv", coverage_table()); }

TEST(Catalogue, TheFactsOfThePagesShowIt) { expect_written("tests/host/devices/facts.txt", device_facts()); }

}  // namespace
}  // namespace fencepost::devices
