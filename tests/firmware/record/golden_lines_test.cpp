// The six lines that the stream's contract gives as examples, and one of each later kind: these bytes, these values,
// both ways.
#include <gtest/gtest.h>

#include "firmware/record/decode.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::record {
namespace {

struct Golden {
  std::string_view line;
  AnyRecord record;
};

sensor::CameraIntrinsics pixy() {
  sensor::CameraIntrinsics camera;
  camera.model = "pixy2";
  camera.width = 316;
  camera.height = 208;
  camera.fx = camera.fy = {27'360};
  camera.cx = {15'750};
  camera.cy = {10'350};
  camera.mount = {{500}, {0}, {1'200}, {0}, base::Radians{0}};
  camera.latency = {500};
  return camera;
}

sensor::CameraIntrinsics fisheye() {
  sensor::CameraIntrinsics camera = pixy();
  camera.lens = sensor::Lens::kEquidistant;
  return camera;
}

sensor::BlobFrame two_blobs() {
  sensor::BlobFrame frame{{123'600}, 617, {}};
  EXPECT_TRUE(frame.blobs.push_back({1, 10, 20, 40, 60, {250}, {400}, 950, sensor::Rgb{0xd0, 0x20, 0x20}}));
  EXPECT_TRUE(frame.blobs.push_back({2, 100, 22, 131, 80, {1'155}, {510}, 0, std::nullopt}));
  return frame;
}

sensor::BlobFrame two_bearings() {
  sensor::BlobFrame frame{{123'900}, 619, {}};
  EXPECT_TRUE(frame.blobs.push_back({1, 25, 20, 25, 60, {251}, {400}, 950, sensor::Rgb{0xd0, 0x20, 0x20}, true}));
  EXPECT_TRUE(frame.blobs.push_back({2, 115, 51, 116, 51, {1'154}, {510}, 0, std::nullopt, true}));
  return frame;
}

sensor::BlobFrame two_tracked() {
  sensor::BlobFrame frame = two_blobs();
  frame.t = {124'000};
  frame.frame = 620;
  frame.blobs[0].track = 7;
  return frame;
}

SectorReport sectors() {
  SectorReport report{{131'000}, {}};
  for (const int raw : {5'000, -1, -1, 12'500}) {
    SectorReport::Sector sector;
    if (raw >= 0) sector.distance = base::Metres{raw};
    EXPECT_TRUE(report.sectors.push_back(sector));
  }
  return report;
}

WayReport ways() {
  WayReport report{{131'000}, {}};
  EXPECT_TRUE(report.ways.push_back({WayMotion::kSpin, {0}, {31'416}, {39'270}, WayEnd::kNothing}));
  EXPECT_TRUE(report.ways.push_back({WayMotion::kForward, {-160}, {4'200}, {5'250}, WayEnd::kThing}));
  EXPECT_TRUE(report.ways.push_back({WayMotion::kBack, {0}, {0}, {0}, WayEnd::kUnknown}));
  return report;
}

std::vector<Golden> golden_lines() {
  return {
      {"$FPHDR,1,fencepost,0.1.0,host,full*34A0", Header{1, "fencepost", "0.1.0", "host", "full"}},
      {"$FPCAM,pixy2,316,208,273.60,273.60,157.50,103.50,0.0000,0.0500,0.0000,0.1200,0.0000,0.0000,0.0500*6E36",
       pixy()},
      {"$FPCAM,pixy2,316,208,273.60,273.60,157.50,103.50,0.0000,0.0500,0.0000,0.1200,0.0000,0.0000,0.0500,equidistant*"
       "AE41",
       fisheye()},
      {"$FPODO,12.3450,0.1234,-0.0010,1.5708*0DF3", sensor::OdometrySample{{123'450}, {1'234}, {-10}, {15'708}}},
      {"$FPFRM,12.3600,617,2,1,10,20,40,60,25.0,40.0,950,d02020,2,100,22,131,80,115.5,51.0,0,*1594", two_blobs()},
      {"$FPFRM,12.3900,619,2,1,,20,,60,25.1,40.0,950,d02020,2,,51,,51,115.4,51.0,0,*C3CD", two_bearings()},
      {"$FPFRM,12.4000,620,2,1,10,20,40,60,25.0,40.0,950,d02020,7,2,100,22,131,80,115.5,51.0,0,,*D048", two_tracked()},
      {"$FPFRM,12.3800,618,0*6329", sensor::BlobFrame{{123'800}, 618, {}}},
      {"$FPALR,12.3800,warn,3,1,0.2094,0.2400,1.1000,0.93*417C",
       AlertReport{{123'800}, AlertLevel::kWarn, 3, 1, {2'094}, {2'400}, base::Duration{11'000}, {93}}},
      {"$FPSEC,13.1000,4,0.5000,,,1.2500*6F4B", sectors()},
      {"$FPWAY,13.1000,3,spin,0.00,3.1416,3.9270,nothing,forward,-1.60,0.4200,0.5250,thing,back,0.00,0.0000,0.0000,"
       "unknown*B233",
       ways()},
      {"$FPSPD,12.4000,0.3500*65C3", SpeedLimit{{124'000}, base::Metres{3'500}}},
      {"$FPSPD,12.5000,*5D36", SpeedLimit{{125'000}, {}}},
      {"$FPCAL,12.3800,rows,1.31*C903", CalibrationDoubt{{123'800}, Doubt::kRows, {131}}},
  };
}

TEST(GoldenLines, CrcCheckValue) { EXPECT_EQ(base::crc16("123456789"), 0x29B1); }

TEST(GoldenLines, EncodeToExactlyTheseBytes) {
  for (const Golden& golden : golden_lines()) EXPECT_EQ(encoded(golden.record), std::string(golden.line) + "\r\n");
}

TEST(GoldenLines, DecodeToExactlyTheseValues) {
  for (const Golden& golden : golden_lines()) {
    Recorder sink;
    const base::Result<Kind, Reject> kind = decode(golden.line, {}, sink);
    ASSERT_TRUE(kind.ok()) << golden.line << ": " << name(kind.error());
    ASSERT_EQ(sink.records.size(), 1U);
    EXPECT_EQ(sink.records[0], golden.record) << golden.line;
    EXPECT_EQ(static_cast<std::size_t>(*kind), golden.record.index());
  }
}

}  // namespace
}  // namespace fencepost::record
