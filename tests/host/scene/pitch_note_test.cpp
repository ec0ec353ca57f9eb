#include "host/scene/pitch_note.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

std::string note_of(std::optional<double> pitch) {
  sensor::CameraMount mount;
  if (pitch) mount.pitch = base::Radians::nearest(*pitch);
  return pitch_note(mount).value_or("");
}

TEST(PitchNote, IsSilentUpToThreeDegrees) {
  for (const double pitch : {0.0, 0.0523, -0.0523}) EXPECT_EQ(note_of(pitch), "") << pitch;
}

TEST(PitchNote, SaysWhichWayALargerOneLooks) {
  EXPECT_NE(note_of(0.1396).find("8.0 degrees down"), std::string::npos);
  EXPECT_NE(note_of(-0.0698).find("4.0 degrees up"), std::string::npos);
}

TEST(PitchNote, SaysThatAnUnknownOneCountsAsLevel) {
  EXPECT_NE(note_of(std::nullopt).find("pitch unknown: the camera is taken to be level"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
