// A film through the whole way: trained on its first picture, opened as `run` opens it, driven, logged, replayed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "host/devices/open_devices.hpp"
#include "host/live/live_loop.hpp"
#include "host/replay/replay.hpp"
#include "host/report/report.hpp"
#include "host/video/colour_training.hpp"
#include "tests/host/video/files.hpp"
#include "tests/host/video/studio.hpp"

namespace fencepost::host {
namespace {

using base::Duration;
using base::Error;
using base::milliseconds;
using base::Time;
using testing::Studio;
using testing::TrueBox;

constexpr int kPictures = 64;

/// The pose of the studio's robot, 50 times a second.
class StudioWheels final : public OdometryDevice {
 public:
  base::Result<sensor::OdometrySample> poll(Time now) override {
    if (now < due_) return Error::kNotReady;
    const Time t = due_;
    due_ = due_ + milliseconds(20);
    return sensor::OdometrySample{t, base::Metres::nearest(Studio::x_at(t.to_double())), {}, {}};
  }
  [[nodiscard]] sensor::LinkState link() const override { return sensor::LinkState::kOk; }

 private:
  Time due_;
};

using Truth = std::vector<std::vector<TrueBox>>;  // of each picture

/// Gives the true boxes when the film gives its pictures.
class TrueCamera final : public CameraDevice {
 public:
  explicit TrueCamera(const Truth& truth) : truth_(truth) {}
  base::Result<sensor::BlobFrame> poll(Time now) override {
    const Time due = Time{} + Duration::nearest(given_ / Studio::kRate);
    if (now < due || given_ == kPictures) return Error::kNotReady;
    sensor::BlobFrame frame;
    frame.t = due;
    frame.frame = static_cast<std::uint32_t>(given_++);
    std::vector<TrueBox> boxes = truth_[frame.frame];
    std::sort(boxes.begin(), boxes.end(), [](const TrueBox& a, const TrueBox& b) { return a.pixels > b.pixels; });
    for (const TrueBox& box : boxes) {
      if (box.pixels < segmenter::BlobRules{}.min_pixels) continue;
      sensor::Blob blob;
      blob.signature = box.signature;
      blob.x1 = static_cast<std::int16_t>(box.x1);
      blob.y1 = static_cast<std::int16_t>(box.y1);
      blob.x2 = static_cast<std::int16_t>(box.x2);
      blob.y2 = static_cast<std::int16_t>(box.y2);
      blob.cx = {5 * (box.x1 + box.x2)};
      blob.cy = {5 * (box.y1 + box.y2)};
      blob.pixels = box.pixels;
      (void)frame.blobs.push_back(blob);
    }
    return frame;
  }
  [[nodiscard]] sensor::LinkState link() const override { return sensor::LinkState::kOk; }
  [[nodiscard]] std::uint32_t dropped() const override { return 0; }

 private:
  const Truth& truth_;
  int given_ = 0;
};

/// Nobody types, and all is read.
class NoConsole final : public ConsolePort {
 public:
  base::Result<std::size_t> read(std::span<std::uint8_t>) override { return Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override { return out.size(); }
  void tend(Time) override {}
  [[nodiscard]] bool connected() const override { return true; }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }
};

/// The log of a run of the whole film.
std::string drive(CameraDevice& camera, const sensor::CameraIntrinsics& intrinsics, const RobotFile& robot) {
  StudioWheels wheels;
  NoConsole port;
  PatientConsole console(port, true);
  const auto loop = make_live_loop("full", camera, wheels, console, console::Mode::kQuiet);
  record::Header header;
  header.product = "fencepost";
  header.version = "0";
  header.target = "test";
  loop->start(header, intrinsics, robot);
  std::string log;
  const auto keep = [&] {
    log.append(loop->journal().begin(), loop->journal().end());
    loop->journal_taken(loop->journal().size());
  };
  for (Time now; now < Time{} + Duration::nearest(kPictures / Studio::kRate + 0.5); now = now + milliseconds(5)) {
    camera.tend(now);
    while (loop->step(now)) keep();
    keep();
  }
  loop->finish();
  keep();
  return log;
}

/// s of the first record of a STOP; nothing: none.
std::optional<double> first_stop(const std::string& log) {
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$FPALR,") && line.find(",stop,") != std::string::npos) return std::atof(line.c_str() + 7);
  }
  return std::nullopt;
}

struct Tally {
  int seen = 0;      ///< true boxes
  int close = 0;     ///< of them found, each edge within 3 px
  int invented = 0;  ///< blobs that are of no true box
};

class FilmRun : public ::testing::TestWithParam<testing::Light (*)(double)> {
 protected:
  FilmRun() {
    test::spill(path_, studio_.film(kPictures));
    for (int i = 0; i < kPictures; ++i) truth_.push_back(studio_.truth(i / Studio::kRate));
    linux::Opened<RgbPicture> first = read_picture(path_);
    EXPECT_TRUE(first) << path_;
    std::vector<TrainingBox> boxes;
    for (const TrueBox& box : truth_[0]) {
      const int width = box.x2 - box.x1 + 1;
      const int height = box.y2 - box.y1 + 1;
      boxes.push_back({box.x1 + width / 5, box.y1 + height / 5, width * 3 / 5, height * 3 / 5, box.signature});
    }
    EXPECT_EQ(boxes.size(), 3U);
    for (const TrainedColour& one : train_colours(*first, boxes)) {
      (void)robot_.colours.push_back(one.range);
      robot_.signatures.push_back({one.range.signature, one.rgb, "block"});
      EXPECT_GT(one.found, 0.9) << int{one.range.signature};
    }
    robot_.camera.mount = studio_.camera().mount;
  }

  Devices open() {
    const auto camera = devices::parse_device("video:" + path_, devices::Use::kCamera);
    const auto odometry = devices::parse_device("console", devices::Use::kOdometry);
    EXPECT_TRUE(camera.ok()) << camera.error();
    auto opened = devices::open_devices(*camera, *odometry, robot_, linux::MonotonicClock(), false);
    return std::move(std::get<Devices>(opened));
  }

  Tally compare(CameraDevice& camera) {
    Tally tally;
    int pictures = 0;
    for (Time now; pictures < kPictures && now < Time{} + milliseconds(10'000); now = now + milliseconds(5)) {
      camera.tend(now);
      const auto frame = camera.poll(now);
      if (!frame) continue;
      ++pictures;
      count(*frame, truth_[frame->frame], tally);
    }
    EXPECT_EQ(pictures, kPictures);
    return tally;
  }

  test::Folder folder_;
  std::string path_ = folder_.file("film.y4m");
  Studio studio_{GetParam()};
  Truth truth_;
  RobotFile robot_;

 private:
  static void count(const sensor::BlobFrame& frame, const std::vector<TrueBox>& truth, Tally& tally) {
    constexpr int kClose = 3;  // px
    for (const TrueBox& box : truth) {
      // Twice what a blob needs: a film's noise takes a part of it.
      if (box.pixels < 2 * segmenter::BlobRules{}.min_pixels) continue;
      ++tally.seen;
      tally.close += std::any_of(frame.blobs.begin(), frame.blobs.end(), [&](const sensor::Blob& blob) {
        return blob.signature == box.signature && std::abs(blob.x1 - box.x1) <= kClose &&
               std::abs(blob.y1 - box.y1) <= kClose && std::abs(blob.x2 - box.x2) <= kClose &&
               std::abs(blob.y2 - box.y2) <= kClose;
      });
    }
    for (const sensor::Blob& blob : frame.blobs) {
      tally.invented += std::none_of(truth.begin(), truth.end(), [&](const TrueBox& box) {
        return blob.signature == box.signature && blob.x1 <= box.x2 + kClose && blob.x2 >= box.x1 - kClose;
      });
    }
  }
};

// One test, since a film takes long to render.
TEST_P(FilmRun, FindsItsBoxesStopsInTimeAndItsLogReplaysAndIsReported) {
  const Devices watched = open();
  const Tally tally = compare(*watched.camera);
  std::cout << tally.close << " of " << tally.seen << " boxes within 3 px, " << tally.invented << " invented\n";
  EXPECT_GT(tally.seen, 130);
  EXPECT_GE(tally.close, 0.95 * tally.seen);
  EXPECT_EQ(tally.invented, 0);

  const Devices devices = open();
  ASSERT_TRUE(devices.intrinsics.has_value());
  EXPECT_EQ(devices.intrinsics->width, 320);
  const std::string log = drive(*devices.camera, *devices.intrinsics, robot_);
  TrueCamera exact(truth_);
  const std::optional<double> stop = first_stop(log);
  const std::optional<double> right = first_stop(drive(exact, *devices.intrinsics, robot_));
  ASSERT_TRUE(right.has_value());
  ASSERT_TRUE(stop.has_value());
  std::cout << "STOP at " << *stop << " s, with true boxes at " << *right << " s\n";
  EXPECT_LE(*stop, *right + 1.5 / Studio::kRate) << "a picture later at most";
  EXPECT_LT(Studio::x_at(*stop), 1.7) << "before it is there";

  ReplayOptions options;
  options.check = true;
  const ReplayOutcome outcome = replay(log, "film.log", options);
  ASSERT_FALSE(outcome.unreadable) << outcome.unreadable->message;
  EXPECT_GT(outcome.check.compared, 20U);
  EXPECT_EQ(outcome.check.differing, 0U) << outcome.check.mismatches.front();
  EXPECT_NE(write_report(outcome.result, std::nullopt, {}).find("<svg"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Lights, FilmRun,
                         ::testing::Values(&testing::steady_light, &testing::changing_light, &testing::evening_light,
                                           &testing::switched_light, &testing::glaring_light));

}  // namespace
}  // namespace fencepost::host
