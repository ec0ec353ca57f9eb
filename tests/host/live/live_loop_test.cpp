// The robot's loop behind its interface of the host.
#include "host/live/live_loop.hpp"

#include <gtest/gtest.h>

#include "tests/text.hpp"

namespace fencepost::host {
namespace {

using test::count;

/// A sample at each poll, as a driver stamps it.
class Wheels final : public OdometryDevice {
 public:
  base::Result<sensor::OdometrySample> poll(base::Time now) override {
    if (last_ == now) return base::Error::kNotReady;
    last_ = now;
    return sensor::OdometrySample{now, {}, {}, {}};
  }
  [[nodiscard]] sensor::LinkState link() const override { return sensor::LinkState::kOk; }

 private:
  std::optional<base::Time> last_;
};

class Deaf final : public ConsolePort {
 public:
  base::Result<std::size_t> read(std::span<std::uint8_t>) override { return base::Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override { return out.size(); }
  void tend(base::Time) override {}
  [[nodiscard]] bool connected() const override { return true; }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }
};

// t of a record ends at 999,999 s.
TEST(LiveLoop, BeginsANewRunBeforeTheStreamsClockEnds) {
  ConsoleCamera camera;
  Wheels wheels;
  wheels.introduce(
      {"odometry create2 at /dev/ttyUSB0", "create2", "/dev/ttyUSB0", "check its power", "check the baud"});
  Deaf port;
  PatientConsole console(port, true);
  const auto loop = make_live_loop("full", camera, wheels, console, console::Mode::kQuiet);
  record::Header header;
  header.product = "fencepost";
  EXPECT_TRUE(loop->start(header, std::nullopt, {}).empty());
  std::string log;
  for (int second = 998'990; second < 1'000'100; second += 10) {
    const base::Time now{std::int64_t{10'000} * second};
    while (loop->step(now)) {
    }
    log.append(loop->journal().begin(), loop->journal().end());
    loop->journal_taken(loop->journal().size());
  }
  EXPECT_EQ(count(log, "$FPHDR,"), 2U);
  EXPECT_EQ(count(log, "$FPODO,"), 111U) << "one a step";
  EXPECT_NE(log.find("$FPODO,998990.0000,"), std::string::npos) << log.substr(0, 2000);
  EXPECT_NE(log.find("$FPODO,0.0000,"), std::string::npos);
  EXPECT_NE(log.find("$FPODO,1090.0000,"), std::string::npos);
  EXPECT_EQ(count(log, "$FPLNK,998990.0000,create2,ok"), 1U) << log.substr(0, 2000);
  EXPECT_EQ(count(log, ",create2,ok"), 2U) << "each run has the state in force";
  EXPECT_EQ(count(log, "$FPODO,99900"), 0U) << "the new run began in time";
}

TEST(LiveLoop, SaysAtTheStartThatTheCamerasPitchIsUnknown) {
  ConsoleCamera camera;
  Wheels wheels;
  wheels.introduce(
      {"odometry create2 at /dev/ttyUSB0", "create2", "/dev/ttyUSB0", "check its power", "check the baud"});
  Deaf port;
  PatientConsole console(port, true);
  const auto loop = make_live_loop("full", camera, wheels, console, console::Mode::kQuiet);
  sensor::CameraIntrinsics unknown;
  unknown.width = unknown.height = 100;
  sensor::CameraIntrinsics level = unknown;
  level.mount.pitch = base::Radians{};
  EXPECT_TRUE(loop->start({}, level, {}).empty());
  const std::vector<std::string> said = loop->start({}, unknown, {});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("pitch unknown"), std::string::npos) << said[0];
}

}  // namespace
}  // namespace fencepost::host
