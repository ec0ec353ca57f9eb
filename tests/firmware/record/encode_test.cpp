// The encoder's line for every kind of record, and the records that it refuses to write.
#include "firmware/record/encode.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/record/lines.hpp"

namespace fencepost::record {
namespace {

std::string line(std::string_view body) { return sealed(body) + "\r\n"; }

TEST(Encode, WritesTheKindsWithoutAGoldenLine) {
  EXPECT_EQ(encoded(Signature{1, {0xd0, 0x20, 0x0a}, "red"}), line("FPSIG,1,d0200a,red"));
  EXPECT_EQ(encoded(Signature{1, {0xd0, 0x20, 0x0a}, "red", 0, 64}), line("FPSIG,1,d0200a,red,0.064"));
  EXPECT_EQ(encoded(Signature{1, {0xd0, 0x20, 0x0a}, "red", 4, 64}), line("FPSIG,1,d0200a,red,0.064,4"));
  EXPECT_EQ(encoded(Signature{1, {0xd0, 0x20, 0x0a}, "red", -5}), line("FPSIG,1,d0200a,red,,-5"));
  EXPECT_EQ(encoded(Signature{1, {0xd0, 0x20, 0x0a}, "red", 101}), "");
  EXPECT_EQ(encoded(Position{{1}, {-5}, {10'000}, {-15'708}, {20}, {30}}),
            line("FPPOS,0.0001,-0.0005,1.0000,-1.5708,0.0020,0.0030"));
  EXPECT_EQ(
      encoded(ObjectReport{
          {20'000}, 3, 1, 75, {10'500}, {500}, {600}, {-10}, {2'000}, {100}, {9'000}, {97}, ObjectState::kConfirmed}),
      line("FPOBJ,2.0000,3,1,75,1.0500,0.0500,0.0600,-0.0010,0.2000,0.0100,0.9000,0.97,confirmed"));
  EXPECT_EQ(encoded(DigestReport{50, 0x0123456789abcdefULL}), line("FPDIG,50,0123456789abcdef"));
  EXPECT_EQ(encoded(LinkReport{{0}, "pixy2", sensor::LinkState::kSilent, "no answer"}),
            line("FPLNK,0.0000,pixy2,silent,no answer"));
  EXPECT_EQ(encoded(StatusReport{{10'000}, 1, 2, 3, 4, 5, 6, 7, 8, 9}), line("FPSTA,1.0000,1,2,3,4,5,6,7,8,9"));
  EXPECT_EQ(encoded(Setting{"alert.stop", "0.25"}), line("FPCFG,alert.stop,0.25"));
}

TEST(Encode, LeavesOptionalFieldsEmpty) {
  AlertReport alert;
  alert.distance = {5};
  EXPECT_EQ(encoded(alert), line("FPALR,0.0000,clear,0,0,0.0000,0.0005,,0.00"));
  sensor::CameraIntrinsics camera;
  camera.width = camera.height = 2;
  camera.fx = camera.fy = {1};
  EXPECT_EQ(encoded(camera), line("FPCAM,,2,2,0.01,0.01,0.00,0.00,0.0000,0.0000,0.0000,0.0000,0.0000,,0.0000"));
  camera.lens = sensor::Lens::kEquidistant;
  EXPECT_EQ(encoded(camera),
            line("FPCAM,,2,2,0.01,0.01,0.00,0.00,0.0000,0.0000,0.0000,0.0000,0.0000,,0.0000,equidistant"));
}

TEST(Encode, EscapesWhatWouldBreakTheLine) {
  EXPECT_EQ(encoded(Setting{"a,b*c$d%e", "\r\n\t \xC3\xB8~\x7F"}),
            line("FPCFG,a%2Cb%2Ac%24d%25e,%0D%0A%09 %C3%B8~%7F"));
  EXPECT_EQ(encoded(Setting{sensor::Text(std::string_view("\0", 1)), ""}), line("FPCFG,%00,"));
  const std::string commas(sensor::kMaxText, ',');
  std::string escaped;
  for (std::size_t i = 0; i < sensor::kMaxText; ++i) escaped += "%2C";
  EXPECT_EQ(encoded(Setting{sensor::Text(commas), ""}), line("FPCFG," + escaped + ","));
}

TEST(Encode, NeedsExactlyTheLengthOfTheLine) {
  const sensor::OdometrySample sample{{123'450}, {1'234}, {-10}, {15'708}};
  const std::string whole = encoded(sample);
  for (std::size_t size = 0; size <= whole.size() + 1; ++size) {
    std::string memory(size + 8, '\x5A');
    const std::size_t written = encode(sample, std::span(memory).first(size));
    EXPECT_EQ(written, size < whole.size() ? 0U : whole.size());
    if (written != 0) {
      EXPECT_EQ(memory.substr(0, written), whole);
    }
    EXPECT_EQ(memory.substr(size), std::string(8, '\x5A')) << "wrote past the end at " << size;
  }
}

TEST(Encode, NeverWritesALineThatAReaderWouldRejectAsTooLong) {
  sensor::BlobFrame frame{{9'999'990'000}, 4'294'967'295U, {}};
  const sensor::Blob widest{255, 32'767, 32'767, 32'767, 32'767, {-327'680}, {-327'680}, 4'294'967'295U, sensor::Rgb{}};
  while (frame.blobs.push_back(widest)) {
  }
  std::array<char, 2 * kMaxLine> line{};
  EXPECT_EQ(encode(frame, line), 0U);
  frame.blobs.pop_back();
  const std::size_t size = encode(frame, line);
  EXPECT_GT(size, 900U);
  EXPECT_LE(size, kMaxLine);
}

TEST(Encode, RefusesValuesThatAReaderWouldReject) {
  using sensor::OdometrySample;
  EXPECT_EQ(encoded(OdometrySample{{-1}, {}, {}, {}}), "");
  EXPECT_EQ(encoded(OdometrySample{{9'999'990'001}, {}, {}, {}}), "");
  EXPECT_EQ(encoded(OdometrySample{{}, {10'000'001}, {}, {}}), "");
  EXPECT_EQ(encoded(OdometrySample{{}, {}, {-10'000'001}, {}}), "");
  EXPECT_EQ(encoded(OdometrySample{{}, {}, {}, {10'000'001}}), "");
  EXPECT_NE(encoded(OdometrySample{{9'999'990'000}, {10'000'000}, {-10'000'000}, {10'000'000}}), "");
  EXPECT_EQ(encoded(Header{2, "", "", "", ""}), "");
  EXPECT_EQ(encoded(sensor::CameraIntrinsics{}), "") << "no size, no focal length";
  EXPECT_EQ(encoded(AlertReport{{}, static_cast<AlertLevel>(5), 0, 0, {}, {}, {}, {}}), "");
  EXPECT_EQ(encoded(AlertReport{{}, AlertLevel::kStop, 0, 0, {}, {}, base::Duration{-1}, {}}), "");
  sensor::BlobFrame frame;
  ASSERT_TRUE(frame.blobs.push_back({1, 5, 0, 4, 0, {}, {}, 0, {}}));
  EXPECT_EQ(encoded(frame), "") << "x1 > x2";
}

}  // namespace
}  // namespace fencepost::record
