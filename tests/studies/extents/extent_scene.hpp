// Long things seen from near: one wall or box, and a drive along which the image seldom holds both of its ends.
#pragma once

#include <array>
#include <string_view>

#include "host/scene/scene.hpp"

namespace fencepost::test {

enum class Drive {
  kAround,  ///< all the way around it, the camera at a right angle to the way
  kCircle,  ///< on a circle about its middle, the camera towards that
  kPast,    ///< once along one side, the camera at a right angle to the way
  kArc,     ///< a third of a circle before one side, the camera towards its middle
};

struct DriveText {
  Drive drive;
  std::string_view name;
  bool all_sides;  ///< else the back is never seen
};
inline constexpr std::array<DriveText, 4> kDrives = {{{Drive::kAround, "around", true},
                                                      {Drive::kCircle, "circle", true},
                                                      {Drive::kPast, "past", false},
                                                      {Drive::kArc, "arc", false}}};

struct ExtentCase {
  Drive drive = Drive::kAround;
  double length = 1;    ///< m, along y
  double depth = 0.1;   ///< m, along x; the side that kPast and kArc see is the one with the smaller x
  double degrees = 43;  ///< of view
  std::string_view level = "1";
  unsigned seed = 1;
};

/// The object alone, about the origin, turned by the seed. Distance, height and where the drive begins are the seed's.
host::Scene extent_scene(const ExtentCase& wanted);

/// The area that a drive cannot tell from the object: the floor behind the seen side, where the back is never seen. For
/// other drives it is the footprint itself.
host::Polygon unseen_with(const ExtentCase& wanted, const host::Scene& scene);
/// The part of the footprint that was seen: all of it, or 2 cm behind the seen side.
host::Polygon seen_of(const ExtentCase& wanted, const host::Scene& scene);

}  // namespace fencepost::test
