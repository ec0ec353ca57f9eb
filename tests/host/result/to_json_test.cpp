#include "host/result/to_json.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "host/result/geojson.hpp"
#include "tests/host/result/documents.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;
using testing::small_document;

// The whole document, byte for byte: key order, number form and every null are part of the promise.
TEST(ToJson, WritesTheDocumentOfTheContract) {
  const std::string expected =
      R"({"format":1,"log":{"records":12,"frames":5,"odometry":4,"foreign":1,)"
      R"("refused":{"no_pose":2,"odometry_gap":0,"no_camera":0,"queue":0},)"
      R"("rejected":{"crc":3,"kind":0,"fields":0,"number":0,"range":0,"length":0,"truncated":0,"time":0,"format":0}},)"
      R"("digest":"0123456789abcdef","profile":"full",)"
      R"("camera":{"model":"pixy2","width":316,"height":208,"fx":273.6,"fy":273.6,"cx":157.5,"cy":103.5,"k1":0.0,)"
      R"("mount":{"x":0.05,"y":0.0,"z":0.12,"yaw":0.0,"pitch":null},"latency":0.05},)"
      R"("signatures":[{"id":1,"name":"red","rgb":"d02020"}],)"
      R"("pose":{"t":1.2,"x":0.5,"y":-0.25,"heading":0.125},)"
      R"("path":[[0.0,0.0,0.0,0.0],[0.6,0.25,-0.1,-0.2],[1.2,0.5,-0.25,0.125]],"objects":[)"
      R"({"id":1,"signature":1,"name":"red","rgb":"d02020","state":"confirmed","views":75,"z_min":0.0,"z_max":0.2,"base":0.03,"confidence":0.97,"next":null,"models":{)"
      R"("cylinder":{"x":1.05,"y":0.05,"radius":0.06,"area":0.01,"geometry":{"type":"Polygon","coordinates":)"
      R"([[[1.0,0.0],[1.1,0.0],[1.1,0.1],[1.0,0.1],[1.0,0.0]]]}},)"
      R"("carve":{"area":0.04,"geometry":{"type":"Polygon","coordinates":[[[1.0,0.0],[1.2,0.0],[1.2,0.2],[1.0,0.2],[1.0,0.0]]]}},)"
      R"("clip":{"area":0.01,"geometry":{"type":"Polygon","coordinates":[[[1.0,0.0],[1.1,0.0],[1.1,0.1],[1.0,0.1],[1.0,0.0]]]}}}},)"
      R"({"id":2,"signature":9,"name":null,"rgb":null,"state":"tentative","views":1,"z_min":0.0,"z_max":0.0,"base":0.0,"confidence":0.5,"next":null,"models":{)"
      R"("cylinder":{"x":null,"y":null,"radius":null,"area":null,"geometry":null},)"
      R"("carve":{"area":null,"geometry":null},"clip":{"area":null,"geometry":null}}}],"alerts":[)"
      R"({"t":1.0,"level":"warn","id":1,"bearing":0.1,"distance":0.4,"ttc":1.1,"confidence":0.9},)"
      R"({"t":1.1,"level":"stop","id":1,"bearing":-0.2094,"distance":0.24,"ttc":null,"confidence":0.93}],)"
      R"("guard":[{"x":1.0,"y":0.05,"signature":1},{"x":-0.25,"y":2.0,"signature":9}],"sectors":{"t":1.2,"distances":[0.5,null,1.5]},)"
      R"("ways":{"t":1.2,"ways":[{"motion":"forward","curvature":-1.6,"free":0.42,"speed":0.5,"end":"thing"}]},"speed_limit":0.35,)"
      R"("calibration":[{"t":0.9,"doubt":"rows","factor":1.31,)"
      R"("says":"check the camera's pitch and height: things are 1.31 times nearer than it tells"}],"passes":[]})"
      "\n";
  EXPECT_EQ(to_json(small_document()), expected);
}

TEST(ToJson, ASignatureHasItsSizeAndItsPadWhereTheyAreKnown) {
  ResultDocument document = small_document();
  document.signatures = {{1, {0xd0, 0x20, 0x20}, "red", -3, 64}};
  const std::string text = to_json(document);
  EXPECT_NE(text.find(R"({"id":1,"name":"red","rgb":"d02020","size":0.064,"pad":-3})"), std::string::npos) << text;
}

TEST(ToJson, GivesTheSameBytesTwice) { EXPECT_EQ(to_json(small_document()), to_json(small_document())); }

TEST(ToJson, AnEmptyDocumentHasEveryKey) {
  const Json json = Json::parse(to_json({}));
  for (const char* key : {"format", "log", "digest", "profile", "camera", "signatures", "pose", "path", "objects",
                          "alerts", "guard", "sectors", "ways", "speed_limit", "calibration", "passes"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_TRUE(json["pose"].is_null());
  EXPECT_TRUE(json["camera"].is_null());
  EXPECT_EQ(json["digest"], "0000000000000000");
  EXPECT_EQ(json["log"]["rejected"].size(), record::kRejectReasons);
}

TEST(ToJson, AnotherLensIsNamed) {
  ResultDocument d = small_document();
  d.camera->lens = sensor::Lens::kEquidistant;
  d.camera->mount.pitch = base::Radians::nearest(0.1);
  const Json camera = Json::parse(to_json(d))["camera"];
  EXPECT_EQ(camera["lens"], "equidistant");
  EXPECT_EQ(camera["mount"]["pitch"], 0.1);
}

TEST(ToJson, ALongPathIsThinnedAndKeepsItsEnds) {
  for (const std::size_t length : {std::size_t{2'000}, std::size_t{2'001}, std::size_t{3'999}, std::size_t{100'000}}) {
    ResultDocument d;
    for (std::size_t i = 0; i < length; ++i) d.path.push_back({0.02 * static_cast<double>(i), 0, 0, 0});
    const Json path = Json::parse(to_json(d))["path"];
    EXPECT_LE(path.size(), 2'000U) << length;
    EXPECT_GE(path.size(), 1'000U) << length;
    EXPECT_EQ(path.front()[0], 0.0);
    EXPECT_NEAR(path.back()[0].get<double>(), d.path.back().t, 1e-9) << length;
  }
}

TEST(ToJson, AbsentModelsAreAbsent) {
  ResultDocument d = small_document();
  d.objects[0].models.resize(1);
  const Json models = Json::parse(to_json(d))["objects"][0]["models"];
  EXPECT_TRUE(models.contains("cylinder"));
  EXPECT_FALSE(models.contains("clip"));
}

TEST(ToJson, ACylinderWithoutGeometryHasNoNumbers) {
  ResultDocument d = small_document();
  d.objects[0].models[0].geometry.clear();
  const Json cylinder = Json::parse(to_json(d))["objects"][0]["models"]["cylinder"];
  for (const char* key : {"x", "y", "radius", "geometry"}) EXPECT_TRUE(cylinder.at(key).is_null()) << key;
}

TEST(ToJson, OpenSidesAreLines) {
  ResultDocument d = small_document();
  EXPECT_FALSE(Json::parse(to_json(d))["objects"][0]["models"]["clip"].contains("open"));
  d.objects[0].models[2].open = {{{1, 0}, {1.1, 0}, {1.1, 0.1}}};
  const Json open = Json::parse(to_json(d))["objects"][0]["models"]["clip"]["open"];
  EXPECT_EQ(open.dump(), R"({"type":"MultiLineString","coordinates":[[[1.0,0.0],[1.1,0.0],[1.1,0.1]]]})");
}

TEST(ToJson, ProfileBytesThatAreNotUtf8DoNotThrow) {
  ResultDocument d;
  d.profile = "\xff\"<";
  EXPECT_NE(Json::parse(to_json(d))["profile"].get<std::string>().find("\"<"), std::string::npos);
}

TEST(Rounded, HasNoMinusZeroAndNoNan) {
  EXPECT_EQ(rounded(-0.0000001, 6).dump(), "0.0");
  EXPECT_EQ(rounded(0.1 + 0.2, 6).dump(), "0.3");
  EXPECT_EQ(rounded(-1.23456789, 4).dump(), "-1.2346");
  EXPECT_TRUE(rounded(std::numeric_limits<double>::quiet_NaN(), 4).is_null());
  EXPECT_TRUE(rounded(std::numeric_limits<double>::infinity(), 4).is_null());
}

TEST(ToGeojson, TurnsRingsTheGeoJsonWay) {
  // Both rings are given the wrong way round: the outer clockwise, the hole counter-clockwise.
  const Polygon polygon{{{0, 0}, {0, 3}, {3, 3}, {3, 0}}, {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}};
  EXPECT_EQ(to_geojson({polygon}).dump(),
            R"({"type":"Polygon","coordinates":[[[3.0,0.0],[3.0,3.0],[0.0,3.0],[0.0,0.0],[3.0,0.0]],)"
            R"([[1.0,2.0],[2.0,2.0],[2.0,1.0],[1.0,1.0],[1.0,2.0]]]})");
}

TEST(ToGeojson, SeveralPolygonsAreAMultiPolygon) {
  const Polygon triangle{{{0, 0}, {1, 0}, {0, 1}}, {}};
  const Json json = to_geojson({triangle, triangle});
  EXPECT_EQ(json["type"], "MultiPolygon");
  EXPECT_EQ(json["coordinates"].size(), 2U);
}

TEST(ToGeojson, NothingIsNull) {
  EXPECT_TRUE(to_geojson({}).is_null());
  EXPECT_TRUE(to_geojson({Polygon{{{0, 0}, {1, 0}}, {}}}).is_null());
}

}  // namespace
}  // namespace fencepost::host
