#include "host/recorder/status_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/host/recorder/stream.hpp"

namespace fencepost::host {
namespace {

using testing::frame_line;
using testing::line_of;

constexpr base::Time at(double seconds) { return base::Time::nearest(seconds); }
using Lines = std::vector<std::string>;

// Two frames were passed over, one line was damaged, the camera went, the robot dropped 7 records.
void take_trouble(Tally& tally) {
  tally.take(frame_line(0.5, 0) + "hello\n$FPFRM,damaged*0000\r\n" + frame_line(1, 3), at(1));
  tally.take(line_of("FPLNK,1.0000,camera,silent,no answer") + line_of("FPLNK,1.0000,odometry,ok,"), at(1));
  tally.take(line_of("FPSTA,1.0000,10,10,0,20,0,0,0,1,100") + line_of("FPSTA,2.0000,20,20,3,40,0,0,7,1,100"), at(1.5));
}

// A line is 17 characters, 5 of CRC and 2 of its end.
TEST(StatusText, ARecordingWithoutTroubleIsShort) {
  Tally tally(at(10));
  tally.take(frame_line(0.5, 0) + frame_line(0.6, 1), at(72));
  tally.measure(at(74));
  EXPECT_EQ(status_line(tally, at(73), true, 79), "1:03  0 lines/s  1 B/s  2 frames");
  EXPECT_EQ(summary(tally, at(73.06)),
            (Lines{"63.1 s: 2 lines, 48 B", "2 records: 2 frames, 0 of odometry; 0 foreign lines"}));
}

TEST(StatusText, TroubleIsTold) {
  Tally tally(at(0));
  take_trouble(tally);
  EXPECT_EQ(status_line(tally, at(2), true, 200),
            "0:02  0 lines/s  0 B/s  2 frames  camera silent  2 missing  bad: crc 1  lost: records 7, blobs 3  "
            "1 foreign");
  EXPECT_EQ(summary(tally, at(2)), (Lines{"2.0 s: 8 lines, " + in_bytes(static_cast<double>(tally.bytes())),
                                          "6 records: 2 frames, 0 of odometry; 1 foreign line", "rejected lines: crc 1",
                                          "missing by their numbers: 2 frames",
                                          "losses reported by the robot: records_dropped 7, blobs_dropped 3",
                                          "links at the end: camera silent (no answer), odometry ok"}));
}

// A damaged or hostile stream makes up devices without end.
TEST(StatusText, NamesWithoutEndAreNotAllKept) {
  Tally tally(at(0));
  for (int i = 0; i < 10'000; ++i) tally.take(line_of("FPLNK,1.0000,d" + std::to_string(i) + ",silent,"), at(1));
  const std::string links = summary(tally, at(2)).back();
  EXPECT_NE(links.find("d0 silent"), std::string::npos) << links;
  EXPECT_EQ(std::count(links.begin(), links.end(), ','), 63) << links;
}

TEST(StatusText, SilenceAndUnpluggingAreTold) {
  const Tally tally(at(0));
  EXPECT_EQ(status_line(tally, at(1.9), true, 79), "0:01  0 lines/s  0 B/s  0 frames");
  EXPECT_EQ(status_line(tally, at(3725), false, 79), "1:02:05  0 lines/s  0 B/s  0 frames  unplugged  silent 1:02:05");
}

TEST(StatusText, FitsWhateverTheWidth) {
  Tally tally(at(0));
  take_trouble(tally);
  const std::string whole = status_line(tally, at(2), true, 200);
  for (std::size_t width = 0; width < whole.size(); ++width) {
    const std::string cut = status_line(tally, at(2), true, width);
    EXPECT_LE(cut.size(), width);
    if (width >= 9) {
      EXPECT_TRUE(cut.ends_with(" ..")) << cut;
      EXPECT_TRUE(whole.starts_with(cut.substr(0, cut.size() - 3))) << cut;
    }
  }
  EXPECT_EQ(status_line(tally, at(2), true, whole.size()), whole);
}

TEST(StatusText, BytesHaveThreeDigitsOrSo) {
  EXPECT_EQ(in_bytes(0), "0 B");
  EXPECT_EQ(in_bytes(999), "999 B");
  EXPECT_EQ(in_bytes(999.6), "1.0 kB");
  EXPECT_EQ(in_bytes(11'520), "11.5 kB");
  EXPECT_EQ(in_bytes(2'500'000), "2.5 MB");
  EXPECT_EQ(in_bytes(3.21e9), "3.21 GB");
}

}  // namespace
}  // namespace fencepost::host
