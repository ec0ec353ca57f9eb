// A camera of the test's own behind the kernel's calls; its memory is a file.
#include "hal/linux/v4l2.hpp"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <ctime>
#include <deque>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/folder.hpp"
#include "tests/hal/linux/fake_ioctl.hpp"

namespace fencepost::linux {
namespace {

using base::Error;
using base::milliseconds;
using base::Time;
using test::FakeIoctl;

constexpr std::uint32_t kPage = 4096;
constexpr std::size_t kCount = 4;

bool says(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// A camera with one size of each of its formats. A picture of it is a byte that fills its buffer.
struct Camera {
  std::optional<int> operator()(unsigned long request, void* argument) {
    if (request == failing) return -error;
    switch (request) {
      case VIDIOC_QUERYCAP: static_cast<v4l2_capability*>(argument)->capabilities = abilities; return 0;
      case VIDIOC_S_FMT: return set_format(static_cast<v4l2_format*>(argument)->fmt.pix);
      case VIDIOC_S_PARM:
        rate = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe.denominator;
        return 0;
      case VIDIOC_REQBUFS: static_cast<v4l2_requestbuffers*>(argument)->count = kCount; return 0;
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = kPage;
        buffer.m.offset = buffer.index * kPage;
        return 0;
      }
      case VIDIOC_QBUF: EXPECT_TRUE(queued.insert(static_cast<v4l2_buffer*>(argument)->index).second); return 0;
      case VIDIOC_STREAMON: streaming = true; return 0;
      case VIDIOC_DQBUF: return dequeue(*static_cast<v4l2_buffer*>(argument));
      default: return -ENOTTY;
    }
  }
  int set_format(v4l2_pix_format& format) const {
    if (formats.count(format.pixelformat) == 0) format.pixelformat = *formats.begin();
    format.width = width;
    format.height = height;
    format.bytesperline = stride;
    return 0;
  }
  int dequeue(v4l2_buffer& buffer) {
    if (pictures.empty()) return -EAGAIN;
    if (queued.empty()) return -EAGAIN;
    const v4l2_buffer next = pictures.front();
    pictures.pop_front();
    buffer.index = *queued.begin();
    buffer.bytesused = next.bytesused;
    buffer.flags = next.flags;
    buffer.timestamp = next.timestamp;
    queued.erase(queued.begin());
    std::fstream memory(path, std::ios::in | std::ios::out | std::ios::binary);
    memory.seekp(buffer.index * kPage);
    memory << std::string(kPage, static_cast<char>(next.sequence));
    return 0;
  }
  /// `sequence` is what it shows.
  void take(std::uint32_t what, std::uint32_t bytes, std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC,
            std::int64_t age_us = 0) {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t stamp = now.tv_sec * 1'000'000 + now.tv_nsec / 1'000 - age_us;
    v4l2_buffer picture{};
    picture.sequence = what;
    picture.bytesused = bytes;
    picture.flags = flags;
    picture.timestamp = {stamp / 1'000'000, stamp % 1'000'000};
    pictures.push_back(picture);
  }

  std::string path;
  std::uint32_t abilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::set<std::uint32_t> formats = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_MJPEG};
  std::uint32_t width = 40;
  std::uint32_t height = 30;
  std::uint32_t stride = 80;
  std::uint32_t rate = 0;
  unsigned long failing = 0;
  int error = 0;
  bool streaming = false;
  std::set<std::uint32_t> queued;
  std::deque<v4l2_buffer> pictures;
};

class V4l2Ioctl : public testing::Test {
 protected:
  V4l2Ioctl() {
    camera.path = folder_.file("video");
    plug();
  }
  void plug() const { std::ofstream(camera.path) << std::string(kCount * kPage, '\0'); }
  Opened<V4l2> open() { return V4l2::open({camera.path, 40, 30, 25}); }
  std::string problem() {
    const Opened<V4l2> opened = open();
    return opened ? "none" : opened.problem();
  }

 private:
  test::Folder folder_;

 public:
  Camera camera;
  FakeIoctl ioctl_{[this](unsigned long request, void* argument) { return camera(request, argument); }};
};

TEST_F(V4l2Ioctl, GivesThePictureWhereTheKernelWroteIt) {
  Opened<V4l2> opened = open();
  ASSERT_TRUE(opened) << opened.problem();
  V4l2 video = std::move(*opened);
  EXPECT_TRUE(camera.streaming);
  EXPECT_EQ(camera.rate, 25U);
  EXPECT_EQ(camera.queued.size(), kCount);
  EXPECT_TRUE(video.connected());
  EXPECT_GE(video.descriptor(), 0);
  video.tend(Time{} + milliseconds(500));
  EXPECT_EQ(video.next().error(), Error::kNotReady);
  camera.take(7, 2400, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, 20'000);
  video.tend(Time{} + milliseconds(600));
  const auto picture = video.next();
  ASSERT_TRUE(picture.ok());
  EXPECT_EQ(picture->coding, PictureCoding::kYuyv);
  EXPECT_EQ(picture->width, 40);
  EXPECT_EQ(picture->height, 30);
  EXPECT_EQ(picture->stride, 80U);
  ASSERT_EQ(picture->bytes.size(), 2400U);
  EXPECT_EQ(picture->bytes[0], 7);
  EXPECT_EQ(picture->bytes[2399], 7);
  // Its stamp is 20 ms old, on the clock that said 600 ms; a busy machine may have spent some more between both calls.
  EXPECT_LE(picture->t, Time{} + milliseconds(580));
  EXPECT_GE(picture->t, Time{} + milliseconds(100));
}

TEST_F(V4l2Ioctl, GivesTheNewestAndQueuesTheOthersAgain) {
  V4l2 video = std::move(*open());
  for (std::uint32_t what = 1; what <= 3; ++what) camera.take(what, 2400);
  EXPECT_EQ(video.next()->bytes[0], 3);
  EXPECT_EQ(camera.queued.size(), kCount - 1) << "the one that is read";
  EXPECT_EQ(video.next().error(), Error::kNotReady);
  camera.take(4, 2400);
  EXPECT_EQ(video.next()->bytes[0], 4);
  EXPECT_EQ(camera.queued.size(), kCount - 1);
}

TEST_F(V4l2Ioctl, TakesJpegWhereThereIsNoYuyv) {
  camera.formats = {V4L2_PIX_FMT_MJPEG};
  V4l2 video = std::move(*open());
  camera.take(1, 99);
  const auto picture = video.next();
  EXPECT_EQ(picture->coding, PictureCoding::kJpeg);
  EXPECT_EQ(picture->stride, 0U);
  EXPECT_EQ(picture->bytes.size(), 99U);
}

TEST_F(V4l2Ioctl, StampsOfAnotherClockAreNow) {
  V4l2 video = std::move(*open());
  video.tend(Time{} + milliseconds(700));
  camera.take(1, 2400, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, 5'000'000);
  EXPECT_EQ(video.next()->t, Time{} + milliseconds(700));
}

TEST_F(V4l2Ioctl, ADamagedPictureIsBadInput) {
  V4l2 video = std::move(*open());
  camera.take(1, 2400, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR);
  EXPECT_EQ(video.next().error(), Error::kBadInput);
  camera.take(2, 9'999'999);
  EXPECT_EQ(video.next()->bytes.size(), kPage) << "no more than its buffer";
}

TEST_F(V4l2Ioctl, OpensItAgainAfterItWasUnplugged) {
  V4l2 video = std::move(*open());
  video.tend(Time{});
  camera.failing = VIDIOC_DQBUF;
  camera.error = ENODEV;
  std::filesystem::remove(camera.path);
  camera.queued.clear();
  EXPECT_EQ(video.next().error(), Error::kGone);
  EXPECT_FALSE(video.connected());
  EXPECT_EQ(video.descriptor(), -1);
  EXPECT_EQ(video.next().error(), Error::kGone);
  video.tend(Time{} + milliseconds(1'000));
  EXPECT_TRUE(says(video.problem(), "plug it in")) << video.problem();
  plug();
  camera.failing = 0;
  video.tend(Time{} + milliseconds(1'249));
  EXPECT_FALSE(video.connected()) << "at most four times a second";
  video.tend(Time{} + milliseconds(1'250));
  EXPECT_TRUE(video.connected());
  EXPECT_EQ(video.problem(), "");
  camera.take(9, 2400);
  EXPECT_EQ(video.next()->bytes[0], 9);
}

TEST_F(V4l2Ioctl, SaysWhatIsWrong) {
  EXPECT_EQ(problem(), "none");
  camera.queued.clear();
  camera.width = 41;
  EXPECT_TRUE(says(problem(), "has no pictures of 40 x 30 px; 'v4l2-ctl --list-formats-ext -d " + camera.path));
  camera.width = 40;
  camera.formats = {V4L2_PIX_FMT_H264};
  EXPECT_TRUE(says(problem(), "has no pictures of 40 x 30 px"));
  camera.formats = {V4L2_PIX_FMT_YUYV};
  camera.abilities = V4L2_CAP_STREAMING;
  EXPECT_TRUE(says(problem(), "name a camera that can capture"));
  camera.abilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  camera.error = EBUSY;
  for (const unsigned long request : {VIDIOC_REQBUFS, VIDIOC_QUERYBUF, VIDIOC_QBUF, VIDIOC_STREAMON}) {
    camera.failing = request;
    camera.queued.clear();
    EXPECT_TRUE(says(problem(), "another program has it")) << request;
  }
  camera.failing = VIDIOC_QUERYCAP;
  camera.error = ENOTTY;
  EXPECT_TRUE(says(problem(), "name a camera"));
}

TEST(V4l2Problem, NamesThePathAndWhatToTry) {
  const Opened<V4l2> missing = V4l2::open({"/dev/video250"});
  ASSERT_FALSE(missing);
  EXPECT_TRUE(says(missing.problem(), "cannot open the camera /dev/video250"));
  EXPECT_TRUE(says(missing.problem(), "v4l2-ctl --list-devices"));
  for (const char* path : {"/dev/null", "/dev"}) {
    EXPECT_TRUE(says(V4l2::open({path}).problem(), "name a camera")) << path;
  }
}

// A real one, where there is: two seconds of pictures.
TEST(V4l2Device, GivesPictures) {
  if (!std::filesystem::exists("/dev/video0"))
    GTEST_SKIP() << "NO CAMERA AT /dev/video0: THE REAL DEVICE WAS NOT TRIED";
  Opened<V4l2> opened = V4l2::open({"/dev/video0"});
  ASSERT_TRUE(opened) << opened.problem();
  V4l2 video = std::move(*opened);
  int pictures = 0;
  for (int ms = 0; ms < 2'000 && pictures == 0; ms += 10) {
    ::timespec pause{0, 10'000'000};
    ::nanosleep(&pause, nullptr);
    video.tend(Time{} + milliseconds(ms));
    pictures += video.next().ok() ? 1 : 0;
  }
  EXPECT_GT(pictures, 0);
}

}  // namespace
}  // namespace fencepost::linux
