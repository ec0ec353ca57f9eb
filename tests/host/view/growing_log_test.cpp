#include "host/view/growing_log.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

/// All that a reader gets from there on; its place is moved.
std::string read_all(const GrowingLog& log, std::uint64_t& place) {
  std::string text;
  while (true) {
    const GrowingLog::Part part = log.read(place);
    EXPECT_FALSE(part.lost);
    if (part.bytes.empty()) return text;
    text += part.bytes;
    place = part.place;
  }
}

std::string line(int number) { return "line " + std::to_string(1'000'000 + number) + "\n"; }

TEST(GrowingLog, GivesEveryReaderAllFromTheFirstByte) {
  GrowingLog log(1 << 20);
  std::uint64_t early = log.start().place;
  std::string all;
  std::string seen;
  for (int i = 0; i < 30'000; ++i) {
    log.add(line(i));
    all += line(i);
    if (i % 1000 == 0) seen += read_all(log, early);
  }
  seen += read_all(log, early);
  EXPECT_EQ(seen, all);
  const GrowingLog::Start start = log.start();
  EXPECT_EQ(start.preamble, "");
  std::uint64_t late = start.place;
  EXPECT_EQ(read_all(log, late), all);
  EXPECT_FALSE(log.read(late).ended);
  log.end();
  EXPECT_TRUE(log.read(late).ended);
  EXPECT_FALSE(log.read(0).ended) << "there is more to read there";
}

TEST(GrowingLog, ForgetsTheOldestButNotWhatIsInForce) {
  GrowingLog log(1000);
  log.add("$FPHDR,1,old\n$FPSIG,7,old\n");
  log.add("$FPHDR,1,a,b,c,small\n$FPCAM,first\n$FPSIG,1,red\n$FPCFG,alert.stop,0.20\n");
  for (int i = 0; i < 20; ++i) log.add(line(i));
  log.add("$FPCAM,second\n");
  for (int i = 20; i < 200; ++i) log.add(line(i));
  const GrowingLog::Start start = log.start();
  EXPECT_EQ(start.preamble, "$FPHDR,1,a,b,c,small\n$FPCAM,second\n$FPSIG,1,red\n$FPCFG,alert.stop,0.20\n");
  std::uint64_t place = start.place;
  const std::string kept = read_all(log, place);
  EXPECT_LE(kept.size(), 1000U);
  EXPECT_GT(kept.size(), 800U);
  EXPECT_TRUE(kept.starts_with("line ")) << kept.substr(0, 30);
  EXPECT_TRUE(kept.ends_with(line(199)));
}

TEST(GrowingLog, TellsAReaderThatItsPlaceIsGone) {
  GrowingLog log(1000);
  log.add(line(0));
  EXPECT_FALSE(log.read(0).lost);
  for (int i = 1; i < 200; ++i) log.add(line(i));
  EXPECT_TRUE(log.read(0).lost);
  EXPECT_FALSE(log.read(log.start().place).lost);
}

TEST(GrowingLog, TakesALineThatIsLargerThanItself) {
  GrowingLog log(100);
  const std::string large = std::string(500, 'x') + "\n";
  log.add(large);
  std::uint64_t place = log.start().place;
  EXPECT_EQ(read_all(log, place), large);
  log.add(line(1));
  place = log.start().place;
  EXPECT_EQ(read_all(log, place), line(1));
}

}  // namespace
}  // namespace fencepost::host
