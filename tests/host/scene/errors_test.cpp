// Every rule of a scene file, broken once: the complaint must name the place, the fault and a way out.
#include <gtest/gtest.h>

#include <ostream>

#include "host/scene/load.hpp"
#include "tests/host/scene/scenes.hpp"

namespace fencepost::host {
namespace {

struct Fault {
  const char* from;
  const char* to;
  const char* where;
  const char* what;    ///< part of it
  const char* remedy;  ///< part of it
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.from << " -> " << fault.to; }

class BrokenScene : public testing::TestWithParam<Fault> {};

TEST_P(BrokenScene, IsRefusedWithPlaceFaultAndRemedy) {
  const Fault& fault = GetParam();
  const LoadedScene loaded = parse_scene(replaced(valid_scene(), fault.from, fault.to), "s.json");
  ASSERT_FALSE(loaded.ok());
  const SceneError& error = loaded.error();
  EXPECT_EQ(error.file, "s.json");
  EXPECT_EQ(error.where, fault.where);
  EXPECT_NE(error.what.find(fault.what), std::string::npos) << error.message();
  EXPECT_NE(error.remedy.find(fault.remedy), std::string::npos) << error.message();
}

constexpr const char* kSquare = "[[[1,0],[1.1,0],[1.1,0.1],[1,0.1],[1,0]]]";
constexpr const char* kArc =
    "\"type\": \"arc\", \"center\": [1.05, 0.05], \"radius\": 1.2, \"start\": 0, \"sweep\": 4.71, \"views\": 75,\n     "
    "     \"look_at\": \"center\"";

INSTANTIATE_TEST_SUITE_P(
    Json, BrokenScene,
    testing::Values(Fault{"\"seed\": 5,", "\"seed\": 5", "line 2, column 9", "not JSON", "comma"},
                    Fault{"\"seed\": 5", "\"seed\": 1e999", "line 1, column 23", "too large", "range"},
                    Fault{"\"width\": 316", "\"width\": -2E400", "line 2, column 40", "too large", "range"},
                    Fault{"\"seed\": 5", "\"1e999\": \"\\\"1e999\", \"seed\": 1e999", "line 1, column 43", "too large",
                          "range"},
                    Fault{"\"width\": 316", "\"width\": 316,, ", "line 2, column 44", "not JSON", "comma"},
                    Fault{"\"seed\": 5", "\"seed\": 5, \"seed\": 6", "key \"seed\"", "twice", "remove one"}));

INSTANTIATE_TEST_SUITE_P(
    Top, BrokenScene,
    testing::Values(
        Fault{"\"format\": 1", "\"format\": 2", "/format", "scene format 1", "write 1"},
        Fault{"\"format\": 1, ", "", "/", "\"format\" is missing", "add it"},
        Fault{"\"seed\": 5", "\"seed\": -5", "/seed", "not negative", "example"},
        Fault{"\"seed\": 5", "\"seeds\": 5", "/seeds", "unknown key", "did you mean \"seed\"?"},
        Fault{"\"seed\": 5", "\"colour of the sky\": 5", "/colour of the sky", "unknown key", "allowed: format"},
        Fault{"\"camera\": {", "\"camra\": {", "/camra", "unknown key", "did you mean \"camera\"?"},
        Fault{"\"robot\": {\"width\": 0.25}", "\"robot\": {\"width\": 0}", "/robot/width", "out of range", "m"},
        Fault{"\"robot\": {\"width\": 0.25}", "\"robot\": {\"front\": -1}", "/robot/front", "out of range", "m"},
        Fault{"\"robot\": {\"width\": 0.25}", "\"robot\": {\"footprint\": [[0, 0]]}", "/robot/footprint",
              "has 1 corners", "at least 3"},
        Fault{"\"robot\": {\"width\": 0.25}", "\"robot\": [1]", "/robot", "must be an object", "{"}));

INSTANTIATE_TEST_SUITE_P(
    Camera, BrokenScene,
    testing::Values(Fault{"\"width\": 316, ", "", "/camera", "\"width\" is missing", "add it"},
                    Fault{"\"width\": 316", "\"width\": 316.5", "/camera/width", "whole number", "2 to 32767"},
                    Fault{"\"width\": 316", "\"width\": 40000", "/camera/width", "out of range", "2 to 32767"},
                    Fault{"\"fx\": 273.6", "\"fx\": 0", "/camera/fx", "out of range", "1 to 32767 px"},
                    Fault{"\"fx\": 273.6", "\"fx\": \"273\"", "/camera/fx", "must be a number, not the text \"273\"",
                          "px"},
                    Fault{"\"k1\": 0", "\"k1\": 3", "/camera/k1", "out of range", "-1 to 1"},
                    Fault{"\"k1\": 0", "\"lens\": \"fisheye\"", "/camera/lens", "no lens", "equidistant"},
                    Fault{"\"k1\": 0", "\"k2\": 3", "/camera/k2", "unknown key", "did you mean"},
                    Fault{"\"pitch\": 0", "\"pitch\": 1.2", "/camera/mount/pitch", "out of range", "rad"},
                    Fault{"\"z\": 0.12", "\"z\": -1", "/camera/mount/z", "out of range", "m"},
                    Fault{"\"latency\": 0.05", "\"latency\": -0.05", "/camera/latency", "out of range", "s"},
                    Fault{"\"rate\": 50", "\"rate\": 0", "/camera/rate", "out of range", "frames/s"},
                    Fault{"\"max_blobs\": 16", "\"max_blobs\": 17", "/camera/max_blobs", "out of range", "1 to 16"},
                    Fault{"\"model\": \"pixy2\"", "\"model\": \"a name of more than thirty-two characters\"",
                          "/camera/model", "characters", "32"}));

INSTANTIATE_TEST_SUITE_P(Signatures, BrokenScene,
                         testing::Values(Fault{"\"id\": 2", "\"id\": 1", "/signatures/1/id", "twice", "id of its own"},
                                         Fault{"\"id\": 2", "\"id\": 256", "/signatures/1/id", "out of range", "255"},
                                         Fault{"\"2020d0\"", "\"blue\"", "/signatures/1/rgb", "not a colour", "RRGGBB"},
                                         Fault{"\"2020d0\"", "\"2020d0\", \"pad\": 101", "/signatures/1/pad",
                                               "out of range", "100"},
                                         Fault{"\"edge_bias_px\": 2", "\"edge_bias_px\": {\"7\": 2}",
                                               "/noise/edge_bias_px/7", "signature 7 is not defined", "id"},
                                         Fault{"\"edge_bias_px\": 2", "\"edge_bias_px\": {\"1\": -101}",
                                               "/noise/edge_bias_px/1", "out of range", "px"},
                                         Fault{"\"signature\": 2", "\"signature\": 7", "/objects/1/signature",
                                               "signature 7 is not defined", "add it"}));

INSTANTIATE_TEST_SUITE_P(
    Objects, BrokenScene,
    testing::Values(
        Fault{"\"height\": 0.2", "\"height\": 0", "/objects/0/height", "greater than 0", "m"},
        Fault{"\"base\": 0", "\"base\": -0.1", "/objects/0/base", "out of range", "m"},
        Fault{"\"base\": 0", "\"bsae\": 0", "/objects/0/bsae", "unknown key", "did you mean \"base\"?"},
        Fault{kSquare, "[[[1,0],[1.1,0.1],[1.1,0],[1,0.1]]]", "/objects/0/footprint",
              "crosses or touches itself at (1.05, 0.05)", "in order"},
        Fault{kSquare, "[[[1,0],[1.1,0]]]", "/objects/0/footprint/coordinates/0", "2 corners", "at least 3"},
        Fault{kSquare, "[[[1,0],[1.1,0],[1,0]]]", "/objects/0/footprint/coordinates/0", "fewer than three", "three"},
        Fault{kSquare, "[[[1,0],[1,0],[1.1,0],[1,0]]]", "/objects/0/footprint", "fewer than three different corners",
              "at least three"},
        Fault{kSquare, "[[[1,0],[1.1,0],[1.2,0]]]", "/objects/0/footprint", "", "corners"},
        Fault{kSquare, "[[[1,0],[1.1,0],[1.1,0.1,0.2]]]", "/objects/0/footprint/coordinates/0/2", "more than two",
              "[x, y]"},
        Fault{kSquare, "[[[1,0],[1.1,0],[1.1,\"a\"]]]", "/objects/0/footprint/coordinates/0/2/1", "must be a number",
              "m"},
        Fault{kSquare, "[[[1,0],[1.1,0],[1.1,1e4]]]", "/objects/0/footprint/coordinates/0/2/1", "out of range", "1000"},
        Fault{kSquare, "[[[1,0],[1.1,0],[1.1,0.1]],[[5,5],[6,5],[6,6]]]", "/objects/0/footprint",
              "Hole lies outside shell", "corners"},
        Fault{"\"Polygon\"", "\"MultiPolygon\"", "/objects/0/footprint/type", "not supported",
              "one object for each part"},
        Fault{"[2, 0.5, 0.05]", "[2, 0.5]", "/objects/1/footprint/circle", "2 numbers", "at least 3"},
        Fault{"[2, 0.5, 0.05]", "[2, 0.5, 0]", "/objects/1/footprint/circle/2", "greater than 0", "m"},
        Fault{"[2, 0.5, 0.05]", "[1.05, 0.05, 0.02]", "/objects/1/footprint", "\"can\" overlaps \"box\"", "move"},
        Fault{"{\"circle\": [2, 0.5, 0.05]}", "7", "/objects/1/footprint", "must be an object", "{"}));

constexpr const char* kCan = "\"circle\": [2, 0.5, 0.05]}";

INSTANTIATE_TEST_SUITE_P(
    ObjectsInTime, BrokenScene,
    testing::Values(
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"from\": 3, \"until\": 3", "/objects/1/until",
              "gone before it is there", "after \"from\""},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"until\": 0", "/objects/1/until", "greater than 0", "s"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"from\": -1", "/objects/1/from", "out of range", "s"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"form\": 1", "/objects/1/form", "unknown key",
              "did you mean \"from\"?"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"trained\": false", "/objects/1/signature", "no signature",
              "remove it"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"trained\": 0", "/objects/1/trained", "true or false", "quotes"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"path\": {\"type\": \"arc\"}", "/objects/1/path/type",
              "cannot move by \"arc\"", "poses"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"path\": [[0, 0]]", "/objects/1/path", "must be an object", "{"},
        Fault{kCan, "\"circle\": [2, 0.5, 0.05]}, \"path\": {\"type\": \"poses\", \"poses\": []}",
              "/objects/1/path/poses", "0 poses", "at least 1"},
        Fault{kCan, "\"circle\": [1.05, 0.05, 0.02]}, \"from\": 3", "/objects/1/footprint", "\"can\" overlaps \"box\"",
              "move"}));

INSTANTIATE_TEST_SUITE_P(
    Path, BrokenScene,
    testing::Values(
        Fault{"\"arc\"", "\"arcs\"", "/path/type", "unknown path type", "did you mean \"arc\"?"},
        Fault{"\"arc\"", "\"helicopter\"", "/path/type", "unknown path type", "waypoints"},
        Fault{"\"type\": \"arc\", ", "", "/path", "\"type\" is missing", "add it"},
        Fault{"\"views\": 75", "\"views\": 0", "/path/views", "out of range", "1 to"},
        Fault{"\"look_at\": \"center\"", "\"look_at\": \"up\"", "/path/look_at", "unknown direction", "outwards"},
        Fault{"\"sweep\": 4.71, ", "", "/path", "\"sweep\" is missing", "add it"},
        Fault{kArc, "\"type\": \"waypoints\", \"points\": [[0,0]]", "/path/points", "1 points", "at least 2"},
        Fault{kArc, "\"type\": \"waypoints\", \"points\": [[0,0],[0,0]]", "/path/points/1", "the point before it",
              "remove"},
        Fault{kArc, "\"type\": \"waypoints\", \"points\": [[0,0],[1,0]], \"speed\": 0", "/path/speed", "greater than 0",
              "m/s"},
        Fault{kArc, "\"type\": \"waypoints\", \"points\": [[0,0],[900,0]], \"speed\": 0.0001", "/path", "too long",
              "speed"},
        Fault{kArc, "\"type\": \"poses\", \"poses\": []", "/path/poses", "0 poses", "at least 1"},
        Fault{kArc,
              "\"type\": \"poses\", \"poses\": "
              "[{\"t\":1,\"x\":0,\"y\":0,\"heading\":0},{\"t\":1,\"x\":0,\"y\":0,\"heading\":0}]",
              "/path/poses/1/t", "not later", "order of time"},
        Fault{kArc, "\"type\": \"poses\", \"poses\": [{\"t\":1,\"x\":0,\"y\":0}]", "/path/poses/0",
              "\"heading\" is missing", "add it"}));

INSTANTIATE_TEST_SUITE_P(
    Noise, BrokenScene,
    testing::Values(Fault{"\"loss_probability\": 0.1", "\"loss_probability\": 1.1", "/noise/loss_probability",
                          "out of range", "0 to 1"},
                    Fault{"\"loss_probability\": 0.1", "\"loss_min\": 0.6", "/noise", "greater than loss_max",
                          "defaults"},
                    Fault{"\"edge_px\"", "\"edge_pix\"", "/noise/edge_pix", "unknown key", "did you mean \"edge_px\"?"},
                    Fault{"\"edge_px\": 1.5", "\"edge_px\": -1", "/noise/edge_px", "out of range", "px"},
                    Fault{"\"edge_px\": 1.5", "\"drift_scale\": -1", "/noise/drift_scale", "out of range", "-0.9"}));

TEST(BrokenSceneText, EmptyAndCutFilesSaySo) {
  EXPECT_EQ(parse_scene("", "s").error().what, "the file is empty");
  EXPECT_EQ(parse_scene(" \n", "s").error().what, "the file is empty");
  const LoadedScene cut = parse_scene(valid_scene().substr(0, 60), "s");
  ASSERT_FALSE(cut.ok());
  EXPECT_EQ(cut.error().what, "the JSON ends too early");
  EXPECT_EQ(parse_scene("[1, 2]", "s").error().where, "/");
}

// A parsed bracket takes eighty times the memory of its text.
TEST(BrokenSceneText, DeepAndLongTextsAreRefusedBeforeTheyTakeMemory) {
  const LoadedScene deep = parse_scene(std::string(1'000'000, '['), "s");
  ASSERT_FALSE(deep.ok());
  EXPECT_EQ(deep.error().what, "brackets are nested more than 32 deep");
  const LoadedScene large = parse_scene(std::string(16'000'001, ' '), "s");
  ASSERT_FALSE(large.ok());
  EXPECT_EQ(large.error().what, "the text has more than 16 MB");
}

TEST(BrokenSceneText, MessageIsOneLine) {
  const LoadedScene loaded = parse_scene(replaced(valid_scene(), "\"rate\": 50", "\"rate\": 0"), "s.json");
  EXPECT_EQ(loaded.error().message(), "s.json: /camera/rate: 0 is out of range; allowed: 0.01 to 1000 frames/s");
}

}  // namespace
}  // namespace fencepost::host
