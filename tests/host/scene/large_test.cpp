// Scenes with as many objects and corners as are allowed, and with more.
#include <gtest/gtest.h>

#include <string>

#include "host/scene/load.hpp"

namespace fencepost::host {
namespace {

std::string large_scene(const std::string& objects) {
  return R"({"format": 1, "seed": 1, "camera": {"width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 103.5},
"signatures": [{"id": 1, "name": "red", "rgb": "d02020"}], "objects": [)" +
         objects + "]}";
}

std::string object_of(const std::string& footprint) {
  return R"({"signature": 1, "height": 0.1, "footprint": )" + footprint + "}";
}

std::string polygon(const std::string& ring) {
  return object_of(R"({"type": "Polygon", "coordinates": [[)" + ring + "]]}");
}

/// So many circles, 10 cm apart, in rows of a hundred.
std::string circles(int count, double radius) {
  std::string objects;
  for (int i = 0; i < count; ++i) {
    objects += (i > 0 ? "," : "") + object_of("{\"circle\": [" + std::to_string(0.1 * (i % 100)) + ", " +
                                              std::to_string(0.1 * (i / 100)) + ", " + std::to_string(radius) + "]}");
  }
  return objects;
}

/// A row of `teeth` teeth on a bar, 2 mm apart, 1 mm thin, 20 cm long. It lies along x, or turned and moved so that
/// each tooth crosses each one of the other comb.
std::string comb(int teeth, bool turned) {
  std::string ring;
  const auto corner = [&](double along, double across) {
    const double x = turned ? across - 0.01 : along;
    const double y = turned ? along - 0.01 : across;
    ring += (ring.empty() ? "[" : ",[") + std::to_string(x) + "," + std::to_string(y) + "]";
  };
  const double length = 0.002 * teeth;
  corner(0, -0.02);
  corner(length, -0.02);
  for (int i = teeth; i-- > 0;) {
    corner(0.002 * i + 0.001, 0);
    corner(0.002 * i + 0.001, length);
    corner(0.002 * i, length);
    if (i > 0) corner(0.002 * i, 0);
  }
  return polygon(ring);
}

// One by one with every other they would take a quarter of an hour.
TEST(LargeScenes, TenThousandObjectsAreReadAtOnce) {
  const LoadedScene apart = parse_scene(large_scene(circles(10'000, 0.045)), "grid.json");
  ASSERT_TRUE(apart.ok()) << apart.error().message();
  EXPECT_EQ(apart->objects.size(), 10'000U);
  const LoadedScene together = parse_scene(large_scene(circles(1'000, 0.055)), "grid.json");
  ASSERT_FALSE(together.ok());
  EXPECT_EQ(together.error().where, "/objects/1/footprint");
  EXPECT_FALSE(parse_scene(large_scene(circles(10'001, 0.045)), "grid.json").ok());
}

TEST(LargeScenes, AnOutlineHasFiveHundredCornersAtMost) {
  const LoadedScene most = parse_scene(large_scene(comb(124, false)), "comb.json");
  ASSERT_TRUE(most.ok()) << most.error().message();
  EXPECT_EQ(most->objects[0].footprint.outer.size(), 497U);
  const LoadedScene crossed = parse_scene(large_scene(comb(124, false) + "," + comb(124, true)), "combs.json");
  ASSERT_FALSE(crossed.ok());
  EXPECT_NE(crossed.error().what.find("overlaps"), std::string::npos) << crossed.error().message();

  const LoadedScene more = parse_scene(large_scene(comb(126, false)), "comb.json");
  ASSERT_FALSE(more.ok());
  EXPECT_EQ(more.error().where, "/objects/0/footprint/coordinates/0");
  EXPECT_EQ(more.error().what, "has 505 corners, at most 500 are taken");
  EXPECT_NE(more.error().remedy.find("divide the object"), std::string::npos);

  const std::string hole = "[0.1,-0.01],[0.11,-0.01],[0.11,-0.015]";
  std::string holed = comb(124, false);
  holed.insert(holed.rfind("]]}"), "],[" + hole + "],[" + hole);
  const LoadedScene holes = parse_scene(large_scene(holed), "comb.json");
  ASSERT_FALSE(holes.ok());
  EXPECT_EQ(holes.error().where, "/objects/0/footprint/coordinates");
}

}  // namespace
}  // namespace fencepost::host
