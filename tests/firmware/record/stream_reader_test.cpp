// Bytes to records in order: cutting lines, the rules of a run, counting.
#include "firmware/record/stream_reader.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/record/random_records.hpp"

namespace fencepost::record {
namespace {

/// A reader with a buffer between two canaries.
class Reading {
 public:
  explicit Reading(std::size_t buffer = StreamReader::kBuffer)
      : memory_(buffer + 2 * kGuard, kCanary), reader_(std::span(memory_).subspan(kGuard, buffer)) {}

  Reading& bytes(std::string_view bytes) {
    reader_.push(bytes, sink);
    return *this;
  }
  Reading& line(std::string_view body) { return bytes(sealed(body) + "\r\n"); }
  Reading& finish() {
    reader_.finish();
    return *this;
  }
  [[nodiscard]] const Counts& counts() const { return reader_.counts(); }
  [[nodiscard]] const StreamReader& reader() const { return reader_; }
  [[nodiscard]] bool canaries_alive() const {
    const std::string guard(kGuard, kCanary);
    return memory_.starts_with(guard) && memory_.ends_with(guard);
  }
  /// The reason of the only rejected line, or how many there are.
  [[nodiscard]] std::string rejected() const {
    if (counts().rejected() != 1) return std::to_string(counts().rejected()) + " rejected";
    for (std::uint8_t i = 0; i < kRejectReasons; ++i) {
      if (counts().rejects[i].lines == 1) return std::string(name(static_cast<Reject>(i)));
    }
    return "";
  }

  Recorder sink;

 private:
  static constexpr std::size_t kGuard = 16;
  static constexpr char kCanary = '\x5A';
  std::string memory_;
  StreamReader reader_;
};

const std::string kOdometry1 = sealed("FPODO,1,0,0,0") + "\n";
const std::string kOdometry2 = sealed("FPODO,2,0,0,0") + "\n";

TEST(StreamReader, CutsAtEitherLineEnd) {
  Reading reading;
  reading.bytes(sealed("FPODO,1,0,0,0") + "\n" + sealed("FPODO,2,0,0,0") + "\r\n");
  EXPECT_EQ(reading.counts().records, 2U);
  EXPECT_EQ(reading.counts().rejected(), 0U);
}

TEST(StreamReader, ALoneCarriageReturnIsJustABadCharacter) {
  Reading reading;
  reading.bytes(sealed("FPODO,1,0,0,0") + "\r" + sealed("FPODO,2,0,0,0") + "\r\n" + sealed("FPODO,3,0,0,0") + "\r\r\n");
  EXPECT_EQ(reading.counts().records, 0U);
  EXPECT_EQ(reading.counts().rejected(Reject::kCrc).lines, 2U);
}

TEST(StreamReader, GivesTheSameForEveryPortionOfBytes) {
  std::string log;
  RandomRecords random(5);
  Reading whole;
  for (int i = 0; i < 12; ++i) log += encoded(random.any(static_cast<Kind>(i)));
  whole.bytes(log);
  ASSERT_GE(whole.counts().records, 11U) << "the random frame may leave the random image";
  for (std::size_t split = 0; split <= log.size(); ++split) {
    Reading parts;
    parts.bytes(log.substr(0, split)).bytes(log.substr(split));
    ASSERT_EQ(parts.counts(), whole.counts()) << split;
    ASSERT_EQ(parts.sink.records, whole.sink.records) << split;
  }
}

TEST(StreamReader, CountsForeignLines) {
  Reading reading;
  reading.bytes("\n\r\nhello\n $FPODO,1,0,0,0*0000\n$GPGGA,1*00\n$F\n$\nfpodo\n");
  EXPECT_EQ(reading.counts().foreign, 8U);
  EXPECT_EQ(reading.reader().line_number(), 8U);
  EXPECT_EQ(reading.counts().rejected(), 0U);
}

TEST(StreamReader, ARecordAfterGarbageOnTheSameLineIsForeign) {
  Reading reading;
  reading.bytes("garbage" + kOdometry1 + kOdometry2);
  EXPECT_EQ(reading.counts().foreign, 1U);
  EXPECT_EQ(reading.counts().records, 1U);
}

TEST(StreamReader, CountsEachReasonWithItsFirstLine) {
  Reading reading;
  reading.bytes("foreign\n" + kOdometry1 + "$FPBAD*0000\n").line("FPXYZ,1").bytes("$FPBAD*0000\n" + kOdometry1);
  EXPECT_EQ(reading.counts().rejected(Reject::kCrc), (RejectCount{2, 3}));
  EXPECT_EQ(reading.counts().rejected(Reject::kKind), (RejectCount{1, 4}));
  EXPECT_EQ(reading.counts().rejected(Reject::kTime), (RejectCount{1, 6}));
  EXPECT_EQ(reading.counts().rejected(Reject::kRange), (RejectCount{0, 0}));
  EXPECT_EQ(reading.counts().rejected(), 4U);
  EXPECT_EQ(reading.counts().records_of(Kind::kOdometry), 1U);
  EXPECT_EQ(reading.reader().line_number(), 6U);
}

TEST(StreamReader, TellsTheOutcomeAtALinesEndOnly) {
  std::array<char, StreamReader::kBuffer> buffer{};
  StreamReader reader(buffer);
  Recorder sink;
  const std::string_view line = kOdometry1;
  for (const char c : line.substr(0, line.size() - 1)) ASSERT_FALSE(reader.push(c, sink).has_value());
  EXPECT_EQ(reader.push('\n', sink), (LineOutcome{LineUse::kRecord, Kind::kOdometry, Reject::kCrc, 1}));
  EXPECT_EQ(reader.push('\n', sink)->use, LineUse::kForeign);
  const std::optional<LineOutcome> again =
      (reader.push(line.substr(0, line.size() - 1), sink), reader.push('\n', sink));
  EXPECT_EQ(again->use, LineUse::kRejected);
  EXPECT_EQ(again->reject, Reject::kTime);
  EXPECT_EQ(again->line_number, 3U);
}

TEST(StreamReader, RejectsAnUnfinishedLastLine) {
  EXPECT_EQ(Reading().bytes(sealed("FPODO,1,0,0,0")).finish().rejected(), "truncated");
  EXPECT_EQ(Reading().bytes(sealed("FPODO,1,0,0,0") + "\r").finish().rejected(), "truncated");
  EXPECT_EQ(Reading().bytes("$FP").finish().rejected(), "truncated");
  EXPECT_EQ(Reading().bytes("$FP" + std::string(5000, 'x')).finish().rejected(), "truncated");
  EXPECT_EQ(Reading().bytes("$F").finish().counts().foreign, 1U);
  EXPECT_EQ(Reading().bytes(std::string(5000, 'x')).finish().counts().foreign, 1U);
  EXPECT_EQ(Reading().finish().reader().line_number(), 0U);
  EXPECT_EQ(Reading().bytes(kOdometry1).finish().finish().reader().line_number(), 1U);
  Reading again;
  again.bytes("$FPODO,1").finish().bytes(kOdometry1);
  EXPECT_EQ(again.counts().records, 1U) << "what comes after the end starts a new line";
}

TEST(StreamReader, SkipsLongLinesToTheirEnd) {
  for (const std::size_t size : {1024U, 1025U, 2000U, 100'000U}) {
    Reading reading;
    reading.bytes("$FP" + std::string(size - 3, 'x') + "\n" + kOdometry1);
    EXPECT_EQ(reading.rejected(), "length");
    EXPECT_EQ(reading.counts().records, 1U);
    Reading foreign;
    foreign.bytes(std::string(size, 'x') + "\n" + kOdometry1);
    EXPECT_EQ(foreign.counts().foreign, 1U);
    EXPECT_EQ(foreign.counts().records, 1U);
    EXPECT_TRUE(reading.canaries_alive() && foreign.canaries_alive());
  }
}

TEST(StreamReader, A1024thCharacterMayOnlyBeTheLineEnd) {
  const auto padded = [](std::size_t size) {
    const std::string start = "FPODO,1,2,3,4.";
    return sealed(start + std::string(size - start.size() - 6, '0'));
  };
  for (const std::size_t buffer : {StreamReader::kBuffer, 4 * StreamReader::kBuffer}) {
    EXPECT_EQ(Reading(buffer).bytes(padded(1023) + "\n").counts().records, 1U);
    EXPECT_EQ(Reading(buffer).bytes(padded(1022) + "\r\n").counts().records, 1U);
    EXPECT_EQ(Reading(buffer).bytes(padded(1023) + "\r\n").rejected(), "length");
    EXPECT_EQ(Reading(buffer).bytes(padded(1024) + "\n").rejected(), "length");
  }
}

TEST(StreamReader, ASmallBufferRejectsWhatItCannotHold) {
  Reading reading(kOdometry1.size() - 1);
  reading.bytes(kOdometry1).bytes(sealed("FPODO,10,0,0,0") + "\n" + kOdometry2);
  EXPECT_EQ(reading.counts().records, 2U);
  EXPECT_EQ(reading.rejected(), "length");
  EXPECT_TRUE(reading.canaries_alive());
}

TEST(RunRules, TimeMustIncreasePerKind) {
  Reading reading;
  reading.line("FPODO,5,0,0,0")
      .line("FPFRM,4,1,0")
      .line("FPODO,5,0,0,0")
      .line("FPFRM,4,2,0")
      .line("FPODO,4.9999,0,0,0");
  EXPECT_EQ(reading.counts().records, 2U);
  EXPECT_EQ(reading.counts().rejected(Reject::kTime), (RejectCount{3, 3}));
  reading.line("FPODO,5.0001,0,0,0").line("FPFRM,4.0001,3,0");
  EXPECT_EQ(reading.counts().records, 4U);
}

TEST(RunRules, ReportsMayShareATime) {
  Reading reading;
  for (int i = 0; i < 2; ++i) reading.line("FPALR,1,stop,1,1,0,0,,0").line("FPLNK,1,a,ok,b").line("FPPOS,1,0,0,0,0,0");
  EXPECT_EQ(reading.counts().records, 6U);
}

TEST(RunRules, ARejectedRecordDoesNotMoveTime) {
  Reading reading;
  reading.line("FPCAM,a,10,10,1,1,0,0,0,0,0,0,0,,0").line("FPFRM,9,1,1,1,0,0,10,0,0,0,0,").line("FPFRM,5,1,0");
  EXPECT_EQ(reading.rejected(), "range");
  EXPECT_EQ(reading.counts().records, 2U);
}

TEST(RunRules, BoxesStayInsideTheCameraInForce) {
  const std::string wide = "FPFRM,1,1,1,1,0,0,9,7,0,0,0,";
  const std::string_view small = "FPCAM,a,10,8,1,1,0,0,0,0,0,0,0,,0";
  EXPECT_EQ(Reading().line(small).line(wide).counts().records, 2U);
  EXPECT_EQ(Reading().line(small).line("FPFRM,1,1,1,1,0,0,10,7,0,0,0,").rejected(), "range");
  EXPECT_EQ(Reading().line(small).line("FPFRM,1,1,1,1,0,0,9,8,0,0,0,").rejected(), "range");
  EXPECT_EQ(Reading().line(small).line("FPFRM,1,1,1,1,-1,0,9,7,0,0,0,").rejected(), "range");
  EXPECT_EQ(Reading().line(small).line("FPFRM,1,1,1,1,0,-1,9,7,0,0,0,").rejected(), "range");
  EXPECT_EQ(Reading().line("FPFRM,1,1,1,1,-1,-1,900,700,0,0,0,").line(small).counts().records, 2U) << "none yet";
  EXPECT_EQ(Reading().line(small).line("FPCAM,a,9,8,1,1,0,0,0,0,0,0,0,,0").line(wide).rejected(), "range");
  EXPECT_EQ(Reading().line(small).line("FPCAM,a,9,8,0,1,0,0,0,0,0,0,0,,0").line(wide).counts().records, 2U)
      << "a rejected FPCAM changes nothing";
  EXPECT_EQ(Reading().line(small).line("FPFRM,1,1,2,1,0,0,9,7,0,0,0,,1,0,0,99,7,0,0,0,").rejected(), "range")
      << "one bad box rejects the frame";
}

TEST(RunRules, AHeaderStartsARun) {
  const std::string_view header = "FPHDR,1,a,b,c,d";
  Reading reading;
  reading.line("FPCAM,a,10,10,1,1,0,0,0,0,0,0,0,,0").line("FPODO,5,0,0,0").line("FPFRM,5,1,0");
  reading.line(header).line("FPODO,1,0,0,0").line("FPFRM,1,1,1,1,0,0,99,99,0,0,0,");
  EXPECT_EQ(reading.counts().records, 6U);
  EXPECT_EQ(reading.counts().rejected(), 0U);
}

TEST(RunRules, AHeaderOfAnotherFormatIsReportedAndStartsNothing) {
  Reading reading;
  reading.line("FPODO,5,0,0,0");
  EXPECT_FALSE(reading.reader().other_format().has_value());
  reading.line("FPHDR,3,a").line("FPODO,1,0,0,0").line("FPODO,6,0,0,0");
  EXPECT_EQ(reading.reader().other_format(), 3U);
  EXPECT_EQ(reading.counts().rejected(Reject::kFormat), (RejectCount{1, 2}));
  EXPECT_EQ(reading.counts().rejected(Reject::kTime), (RejectCount{1, 3}));
}

// In portions of any size: what comes of each line, the records and the counts are those of its bytes one by one.
TEST(StreamReader, TakesPortionsAsItTakesBytes) {
  const std::string too_long = "$FP" + std::string(StreamReader::kBuffer, 'x');
  std::string stream;
  for (int i = 1; i <= 40; ++i) {
    stream += sealed("FPODO," + std::to_string(i % 9 == 0 ? 1 : i) + ",0,0,0") + (i % 3 == 0 ? "\r\n" : "\n");
    if (i % 4 == 0) stream += "foreign\n\n\r\n";
    if (i % 5 == 0) stream += too_long.substr(0, StreamReader::kBuffer - 2 + static_cast<unsigned>(i / 5)) + "\n";
    if (i % 7 == 0) stream += sealed("FPODO,1,0,0") + "\r\n";
  }
  stream += "$FPODO,1";
  for (const std::size_t buffer : {std::size_t{64}, std::size_t{StreamReader::kBuffer}}) {
    std::vector<char> memory(buffer);
    StreamReader by_bytes(memory);
    Recorder sink;
    std::vector<LineOutcome> outcomes;
    for (const char byte : stream) {
      if (const auto outcome = by_bytes.push(byte, sink)) outcomes.push_back(*outcome);
    }
    if (const auto outcome = by_bytes.finish()) outcomes.push_back(*outcome);
    ASSERT_GT(outcomes.size(), 80U);
    for (const std::size_t portion :
         {std::size_t{1}, std::size_t{7}, std::size_t{100}, std::size_t{1500}, stream.size()}) {
      SCOPED_TRACE("portions of " + std::to_string(portion) + " into " + std::to_string(buffer));
      std::vector<char> room(buffer + 1, '#');
      StreamReader by_portions{std::span<char>(room).first(buffer)};
      Recorder heard;
      std::vector<LineOutcome> came;
      for (std::size_t at = 0; at < stream.size(); at += portion) {
        std::string_view left = std::string_view(stream).substr(at, portion);
        while (!left.empty()) {
          if (const auto outcome = by_portions.take(left, heard)) came.push_back(*outcome);
        }
      }
      if (const auto outcome = by_portions.finish()) came.push_back(*outcome);
      EXPECT_EQ(came, outcomes);
      EXPECT_EQ(heard.records, sink.records);
      EXPECT_EQ(room.back(), '#');
    }
  }
}

TEST(LineReader, TakesLinesThatSomeoneElseHasCut) {
  LineReader lines;
  Recorder sink;
  EXPECT_EQ(lines.take_line(sealed("FPODO,,1,2,3"), sink, {.arrival = base::Time{50}}).use, LineUse::kRecord);
  EXPECT_EQ(sink.records.at(0), AnyRecord(sensor::OdometrySample{{50}, {10'000}, {20'000}, {30'000}}));
  EXPECT_EQ(lines.take_line(sealed("FPODO,,1,2,3"), sink, {.arrival = base::Time{50}}).reject, Reject::kTime);
  EXPECT_EQ(lines.take_line("help", sink).use, LineUse::kForeign);
  EXPECT_EQ(lines.take_line("$FP" + std::string(1021, 'x'), sink).reject, Reject::kLength);
  EXPECT_EQ(lines.line_number(), 4U);
}

}  // namespace
}  // namespace fencepost::record
