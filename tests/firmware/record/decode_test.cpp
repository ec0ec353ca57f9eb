// One line at a time: every reason to reject it, and lines that are accepted though the encoder never writes them.
#include "firmware/record/decode.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/record/lines.hpp"

namespace fencepost::record {
namespace {

/// The reason, or "accepted"; nothing may reach the sink of a rejected line.
std::string verdict(std::string_view line, const DecodeOptions& options = {}) {
  Recorder sink;
  const base::Result<Kind, Reject> result = decode(line, options, sink);
  EXPECT_EQ(sink.records.size(), result.ok() ? 1U : 0U) << line;
  return std::string(result.ok() ? "accepted" : name(result.error()));
}

std::string verdict_on_body(std::string_view body) { return verdict(sealed(body)); }

struct Case {
  std::string_view body;
  std::string_view verdict;
};

void expect_verdicts(std::initializer_list<Case> cases) {
  for (const Case& c : cases) EXPECT_EQ(verdict_on_body(c.body), c.verdict) << c.body;
}

TEST(Decode, RejectsABadCrc) {
  const std::string good = "$FPODO,12.3450,0.1234,-0.0010,1.5708*0DF3";
  ASSERT_EQ(verdict(good), "accepted");
  for (const std::string_view line :
       {"$FPODO,12.3450,0.1234,-0.0010,1.5708*0DF4", "$FPODO,12.3450,0.1234,-0.0010,1.5708*0df3",
        "$FPODO,12.3450,0.1234,-0.0010,1.5708*0Df3", "$FPODO,12.3450,0.1234,-0.0010,1.5708*DF3",
        "$FPODO,12.3450,0.1234,-0.0010,1.5708*00DF3", "$FPODO,12.3450,0.1234,-0.0010,1.5708*",
        "$FPODO,12.3450,0.1234,-0.0010,1.5708", "$FPODO,12.3450,0.1234,-0.0010,1.5708*0DF3 ",
        "$FPODO,12.3450,0.1234,-0.0010,1.5708*0DF3\r", "$FPODO,12.3451,0.1234,-0.0010,1.5708*0DF3", "$FP", "$FP*",
        "$FP*0000", "$FPODO,12.3450,0.1234,-0.0010,1.5708**0DF3", "", "*FFFF", "$"}) {
    EXPECT_EQ(verdict(line), "crc") << line;
  }
  EXPECT_EQ(verdict_on_body("FPCFG,a*b,c"), "crc") << "the CRC ends at the first '*'";
}

TEST(Decode, RejectsAnUnknownKind) {
  expect_verdicts({{"FPXYZ,1,2", "kind"},
                   {"FP", "kind"},
                   {"FPODOX,1,2,3,4", "kind"},
                   {"FPOD,1,2,3,4", "kind"},
                   {"FPodo,1,2,3,4", "kind"},
                   {"FPODO;1,2,3,4", "kind"},
                   {"FP,ODO", "kind"}});
  EXPECT_EQ(verdict("X" + sealed("FPCFG,a,b").substr(1)), "kind");
}

TEST(Decode, RejectsAWrongNumberOfFields) {
  expect_verdicts({{"FPODO", "fields"},
                   {"FPODO,", "fields"},
                   {"FPODO,1,2,3", "fields"},
                   {"FPODO,1,2,3,4,5", "fields"},
                   {"FPODO,1,2,3,4,", "fields"},
                   {"FPODO,x,2,3", "fields"},
                   {"FPHDR,1,a,b,c", "fields"},
                   {"FPSIG,1,d02020", "fields"},
                   {"FPSIG,1,d02020,red,0.064,1,1", "fields"},
                   {"FPFRM,1,2", "fields"},
                   {"FPFRM,1,2,1", "fields"},
                   {"FPFRM,1,2,0,", "fields"},
                   {"FPFRM,1,2,1,1,10,20,40,60,25.0,40.0,950", "fields"},
                   {"FPFRM,1,2,0,1,10,20,40,60,25.0,40.0,950,d02020", "fields"},
                   {"FPFRM,1,2,2,1,10,20,40,60,25.0,40.0,950,d02020", "fields"},
                   {"FPFRM,1,2,0,1,10,20,40,60,25.0,40.0,950,d02020,7", "fields"},
                   {"FPFRM,1,2,1,1,10,20,40,60,25.0,40.0,950,d02020,7,7", "fields"},
                   {"FPFRM,1,2,2,1,0,0,1,1,0,0,0,,7,1,0,0,1,1,0,0,0,", "fields"},
                   {"FPFRM,1,2,2,1,0,0,1,1,0,0,0,,1,0,0,1,1,0,0,0,,7", "fields"},
                   {"FPCAM,pixy2,316,208,273.6,273.6,157.5,103.5,0,0,0,0,0,0", "fields"},
                   {"FPCAM,a,316,208,273.6,273.6,157.5,103.5,0,0,0,0,0,0,0,pinhole,", "fields"},
                   {"FPPOS,1,2,3,4,5", "fields"},
                   {"FPOBJ,1,2,3", "fields"},
                   {"FPALR,1,stop,1,1,0,0,0", "fields"},
                   {"FPDIG,1", "fields"},
                   {"FPLNK,1,a,ok", "fields"},
                   {"FPSTA,1,2,3,4,5,6,7,8,9", "fields"},
                   {"FPCFG,a", "fields"},
                   {"FPCFG,a,b,c", "fields"}});
}

TEST(Decode, RejectsWhatCannotBeRead) {
  expect_verdicts({{"FPODO,,2,3,4", "number"},
                   {"FPODO,1,,3,4", "number"},
                   {"FPODO,1,2,3,", "number"},
                   {"FPODO,+1,2,3,4", "number"},
                   {"FPODO,1e0,2,3,4", "number"},
                   {"FPODO,1,nan,3,4", "number"},
                   {"FPODO,1,inf,3,4", "number"},
                   {"FPODO, 1,2,3,4", "number"},
                   {"FPODO,1,2,3,4 ", "number"},
                   {"FPFRM,,1,0", "number"},
                   {"FPFRM,1,1,", "number"},
                   {"FPFRM,1,a,0", "number"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,,", "number"},
                   {"FPFRM,1,1,1,1,5,0,,1,5,0,0,", "number"},
                   {"FPFRM,1,1,1,1,,0,,1,,0,0,", "number"},
                   {"FPFRM,1,1,1,1,,0,,1,nan,0,0,", "number"},
                   {"FPFRM,1,1,1,1,,,,,5,0,0,", "number"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,d0202", "number"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,d0202g", "number"},
                   {"FPSIG,1,,red", "number"},
                   {"FPSIG,1,d020201,red", "number"},
                   {"FPSIG,,d02020,red", "number"},
                   {"FPSIG,1,d02020,red,", "number"},
                   {"FPSIG,1,d02020,red,,", "number"},
                   {"FPSIG,1,d02020,red,0.064,", "number"},
                   {"FPSIG,1,d02020,red,,4px", "number"},
                   {"FPDIG,1,0123456789ABCDEF", "number"},
                   {"FPDIG,1,0123456789abcde", "number"},
                   {"FPDIG,1,0123456789abcdef0", "number"},
                   {"FPDIG,1,", "number"},
                   {"FPDIG,1,0x23456789abcdef", "number"},
                   {"FPALR,1,,1,1,0,0,,0", "number"},
                   {"FPALR,1,stop,1,1,0,,,0", "number"},
                   {"FPCAM,a,316,208,273.6,273.6,157.5,103.5,0,0,0,0,0,0,0,", "number"},
                   {"FPCAM,a,316,208,273.6,,157.5,103.5,0,0,0,0,0,0,0", "number"},
                   {"FPCAM,a,316,208,273.6,273.6,157.5,103.5,0,0,0,0,0,0,", "number"},
                   {"FPCFG,a%2,b", "number"},
                   {"FPCFG,a%,b", "number"},
                   {"FPCFG,a%2G,b", "number"},
                   {"FPCFG,a%%,b", "number"},
                   {"FPCFG,a$b,c", "number"},
                   {"FPCFG,a\tb,c", "number"},
                   {"FPCFG,\xC3\xB8,c", "number"},
                   {"FPCFG,a\rb,c", "number"},
                   {"FPHDR,x,a,b,c,d", "number"},
                   {"FPHDR,,a,b,c,d", "number"}});
}

TEST(Decode, RejectsWhatIsOutOfRange) {
  expect_verdicts({{"FPODO,-0.0001,2,3,4", "range"},
                   {"FPFRM,1,1,1,1,,0,5,1,5,0,0,", "range"},
                   {"FPFRM,1,1,1,1,,2,,1,5,0,0,", "range"},
                   {"FPFRM,1,1,1,1,,0,,1,32768,0,0,", "range"},
                   {"FPODO,999999.0001,2,3,4", "range"},
                   {"FPODO,1,1000.0001,3,4", "range"},
                   {"FPODO,1,2,-1000.0001,4", "range"},
                   {"FPODO,1,2,3,1000.0001", "range"},
                   {"FPODO,1,2,3,99999999999999999999999999", "range"},
                   {"FPSIG,1,d02020,red,2.001", "range"},
                   {"FPSIG,1,d02020,red,,101", "range"},
                   {"FPSIG,1,d02020,red,,-101", "range"},
                   {"FPSIG,1,d02020,red,0,4.0", "range"},
                   {"FPSIG,256,d02020,red", "range"},
                   {"FPSIG,-1,d02020,red", "range"},
                   {"FPCFG,123456789012345678901234567890123,b", "range"},
                   {"FPLNK,1,a,OK,b", "range"},
                   {"FPLNK,1,a,okay,b", "range"},
                   {"FPOBJ,1,1,1,1,0,0,0,0,0,0,0,0,gone", "range"},
                   {"FPALR,1,panic,1,1,0,0,,0", "range"},
                   {"FPALR,1,stop,1,1,0,0,,1.01", "range"},
                   {"FPALR,1,stop,1,1,0,-0.0001,,1", "range"},
                   {"FPALR,1,stop,1,1,0,0,-0.1,1", "range"},
                   {"FPPOS,1,0,0,0,-0.0001,0", "range"},
                   {"FPDIG,4294967296,0123456789abcdef", "range"}});
}

TEST(Decode, RejectsFramesWithBadBoxes) {
  expect_verdicts({{"FPFRM,1,1,1,1,5,0,5,0,0,0,0,", "accepted"},
                   {"FPFRM,1,1,1,1,6,0,5,0,0,0,0,", "range"},
                   {"FPFRM,1,1,1,1,5,1,5,0,0,0,0,", "range"},
                   {"FPFRM,1,1,1,256,5,0,5,0,0,0,0,", "range"},
                   {"FPFRM,1,1,1,1,-32769,0,5,0,0,0,0,", "range"},
                   {"FPFRM,1,1,1,1,0,0,32768,0,0,0,0,", "range"},
                   {"FPFRM,1,1,1,1,0,0,0,0,32767.1,0,0,", "range"},
                   {"FPFRM,1,1,17", "range"},
                   {"FPFRM,1,1,-1", "range"},
                   {"FPFRM,1,1,99999999999999999999", "range"}});
  std::string body = "FPFRM,1,1,17";
  for (int i = 0; i < 17; ++i) body += ",1,0,0,1,1,0,0,0,";
  EXPECT_EQ(verdict_on_body(body), "range");
}

TEST(Decode, ReadsTheIdsOfACameraThatTracks) {
  expect_verdicts({{"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,1", "accepted"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,65535", "accepted"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,", "accepted"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,0", "range"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,65536", "range"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,-1", "range"},
                   {"FPFRM,1,1,1,1,0,0,1,1,0,0,0,,x", "number"}});
  Recorder sink;
  ASSERT_TRUE(decode(sealed("FPFRM,1,1,2,1,0,0,1,1,0,0,0,,,1,,0,,1,5,0,0,,300"), {}, sink).ok());
  const auto& frame = std::get<sensor::BlobFrame>(sink.records.at(0));
  EXPECT_EQ(frame.blobs[0].track, 0);
  EXPECT_EQ(frame.blobs[1].track, 300);
}

TEST(Decode, RejectsImpossibleCameras) {
  const auto camera = [](std::string_view from_width) { return "FPCAM,a," + std::string(from_width); };
  const auto expect = [&](std::string_view fields, std::string_view wanted) {
    EXPECT_EQ(verdict_on_body(camera(fields)), wanted) << fields;
  };
  expect("2,2,0.01,0.01,-32768,32767,10,-1000,1000,0,0,1.5708,10", "accepted");
  expect("1,2,1,1,0,0,0,0,0,0,0,0,0", "range");
  expect("2,1,1,1,0,0,0,0,0,0,0,0,0", "range");
  expect("32768,2,1,1,0,0,0,0,0,0,0,0,0", "range");
  expect("2,2,0,1,0,0,0,0,0,0,0,0,0", "range");
  expect("2,2,1,-1,0,0,0,0,0,0,0,0,0", "range");
  expect("2,2,1,1,32767.01,0,0,0,0,0,0,0,0", "range");
  expect("2,2,1,1,0,0,10.0001,0,0,0,0,0,0", "range");
  expect("2,2,1,1,0,0,0,1000.0001,0,0,0,0,0", "range");
  expect("2,2,1,1,0,0,0,0,0,0,1000.0001,0,0", "range");
  expect("2,2,1,1,0,0,0,0,0,0,0,1.5709,0", "range");
  expect("2,2,1,1,0,0,0,0,0,0,0,,-0.0001", "range");
  expect("2,2,1,1,0,0,0,0,0,0,0,,50", "range");
}

TEST(Decode, RejectsAnotherFormatWhateverItsFields) {
  expect_verdicts({{"FPHDR,2,fencepost,9.0,host,full", "format"},
                   {"FPHDR,0,a,b,c,d", "format"},
                   {"FPHDR,2,something,else", "format"},
                   {"FPHDR,2", "format"},
                   {"FPHDR,1,a,b,c,d", "accepted"}});
  const std::string line = sealed("FPHDR,7,x");
  const base::Result<Line, Reject> opened = open_line(line);
  ASSERT_TRUE(opened.ok());
  const base::Result<std::uint32_t, Reject> format = header_format(*opened);
  ASSERT_TRUE(format.ok());
  EXPECT_EQ(*format, 7U);
}

TEST(Decode, RejectsLinesThatAreTooLong) {
  const auto padded = [](std::size_t size) {
    const std::string start = "FPODO,1,2,3,4.";
    return sealed(start + std::string(size - start.size() - 6, '0'));
  };
  ASSERT_EQ(padded(1023).size(), 1023U);
  EXPECT_EQ(verdict(padded(1023)), "accepted") << "with '\\n' 1024 characters";
  EXPECT_EQ(verdict(padded(1024)), "length");
}

TEST(Decode, AcceptsMoreThanTheEncoderWrites) {
  const auto record = [](std::string_view body) {
    Recorder sink;
    EXPECT_TRUE(decode(sealed(body), {}, sink).ok()) << body;
    return sink.records.empty() ? AnyRecord{} : sink.records[0];
  };
  const sensor::OdometrySample sample{{10'000}, {0}, {5'001}, {-10'000'000}};
  EXPECT_EQ(record("FPODO,1,-0.0000,0.50005,-1000.00"), AnyRecord(sample));
  EXPECT_EQ(record("FPSIG,001,D0a0Ff,"), AnyRecord(Signature{1, {0xd0, 0xa0, 0xff}, ""}));
  EXPECT_EQ(record("FPSIG,001,D0a0Ff,,0.05"), AnyRecord(Signature{1, {0xd0, 0xa0, 0xff}, "", 0, 50}));
  EXPECT_EQ(record("FPSIG,001,D0a0Ff,,,4"), AnyRecord(Signature{1, {0xd0, 0xa0, 0xff}, "", 4}));
  EXPECT_EQ(record("FPSIG,001,D0a0Ff,,0.05,-100"), AnyRecord(Signature{1, {0xd0, 0xa0, 0xff}, "", -100, 50}));
  EXPECT_EQ(record("FPSIG,001,D0a0Ff,,,0"), AnyRecord(Signature{1, {0xd0, 0xa0, 0xff}, ""}));
  EXPECT_EQ(record("FPCFG,%2c%2C%41, a "), AnyRecord(Setting{",,A", " a "}));
  std::string escapes;
  for (std::size_t i = 0; i < sensor::kMaxText; ++i) escapes += "%C3";
  EXPECT_EQ(record("FPCFG,k," + escapes), AnyRecord(Setting{"k", sensor::Text(std::string(sensor::kMaxText, '\xC3'))}));
}

TEST(Decode, StampsOdometryWithoutTimeOnArrivalOnly) {
  Recorder sink;
  const std::string line = sealed("FPODO,,2,3,4");
  ASSERT_TRUE(decode(line, {.arrival = base::Time{77}}, sink).ok());
  EXPECT_EQ(sink.records[0], AnyRecord(sensor::OdometrySample{{77}, {20'000}, {30'000}, {40'000}}));
  ASSERT_TRUE(decode(sealed("FPODO,1,2,3,4"), {.arrival = base::Time{77}}, sink).ok());
  EXPECT_EQ(sink.records[1], AnyRecord(sensor::OdometrySample{{10'000}, {20'000}, {30'000}, {40'000}}));
  EXPECT_EQ(verdict(line), "number");
  EXPECT_EQ(verdict(line, {.arrival = base::Time{9'999'990'001}}), "range");
  EXPECT_EQ(verdict(sealed("FPFRM,,1,0"), {.arrival = base::Time{77}}), "number");
}

}  // namespace
}  // namespace fencepost::record
