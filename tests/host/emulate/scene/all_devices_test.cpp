// Every device at once on one clock: over ptys with hal/linux, and over TCP. Each camera's driver gets
// frames of the feed, each wheel base's the way.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "drivers/cmucam/cmucam.hpp"
#include "drivers/create/create.hpp"
#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/nxtcam/serial_camera.hpp"
#include "drivers/pixy2/camera.hpp"
#include "drivers/xbc/xbc.hpp"
#include "hal/linux/tty.hpp"
#include "tests/folder.hpp"
#include "tests/host/emulate/scene/running.hpp"

namespace fencepost::emulate {
namespace {

/// A host with a driver for each device, whatever the link.
template <class Link>
class Host {
 public:
  using Open = std::function<std::unique_ptr<Link>(std::size_t index, std::uint32_t baud)>;

  explicit Host(const Open& open)
      : links_{open(0, 19'200),  open(1, 115'200), open(2, 115'200), open(3, 115'200), open(4, 19'200),
               open(5, 115'200), open(6, 38'400),  open(7, 115'200), open(8, 115'200)},
        pixy2_(*links_[0]),
        cmucam1_(*links_[1], config_of(cmucam::kCmuCam1)),
        cmucam2_(*links_[2], config_of(cmucam::kCmuCam2)),
        cmucam3_(*links_[3], config_of(cmucam::kCmuCam3)),
        cmucam4_(*links_[4], config_of(cmucam::kCmuCam4)),
        nxtcam_(*links_[5]),
        xbc_(*links_[6], xbc::Config{}),
        create2_(*links_[7], create::Config{}),
        framed_(*links_[8]),
        brick_(framed_),
        nxt_(brick_.conversation(), {}) {}

  static std::vector<std::string> devices() {
    return {"pixy2", "cmucam1", "cmucam2", "cmucam3", "cmucam4", "nxtcam", "xbc", "create2", "nxt"};
  }
  static constexpr std::size_t kCameras = 7;

  void poll(base::Time now) {
    brick_.poll(now);
    take(0, pixy2_.poll(now));
    take(1, cmucam1_.poll(now));
    take(2, cmucam2_.poll(now));
    take(3, cmucam3_.poll(now));
    take(4, cmucam4_.poll(now));
    take(5, nxtcam_.poll(now));
    take(6, xbc_.poll(now));
    if (const auto sample = create2_.poll(now)) create2_x = sample->x.to_double();
    if (const auto sample = nxt_.poll(now)) nxt_x = sample->x.to_double();
  }

  std::vector<sensor::Blob> seen[kCameras];  ///< changes of the first blob
  double create2_x = 0;
  double nxt_x = 0;

 private:
  static cmucam::Config config_of(const cmucam::Dialect& dialect) {
    cmucam::Config config;
    config.dialect = &dialect;
    config.settle = base::milliseconds(50);
    (void)config.windows.push_back({1, 180, 240, 16, 60, 16, 60});
    return config;
  }
  void take(std::size_t camera, const base::Result<sensor::BlobFrame>& frame) {
    if (!frame || frame->blobs.empty()) return;
    std::vector<sensor::Blob>& list = seen[camera];
    const sensor::Blob& blob = frame->blobs[0];
    if (list.empty() || list.back().x1 != blob.x1 || list.back().x2 != blob.x2) list.push_back(blob);
  }

  std::unique_ptr<Link> links_[9];
  pixy2::Camera<Link> pixy2_;
  cmucam::CmuCam<Link> cmucam1_;
  cmucam::CmuCam<Link> cmucam2_;
  cmucam::CmuCam<Link> cmucam3_;
  cmucam::CmuCam<Link> cmucam4_;
  nxtcam::SerialCamera<Link> nxtcam_;
  xbc::Xbc<Link> xbc_;
  create::Create<Link> create2_;
  nxt::FramedLink<Link> framed_;
  nxt::Brick<nxt::FramedLink<Link>> brick_;
  nxt::TachoOdometry nxt_;
};

/// Boxes that fit into all the images and move two columns a frame, so that the NXTCam's rounding keeps them apart.
Feed small_boxes() {
  Feed feed = moving_box(80, 143, 10);
  feed.camera.reset();
  for (std::size_t i = 0; i < feed.frames.size(); ++i) {
    const int x = 2 * static_cast<int>(i) + 4;
    feed.frames[i].blobs.clear();
    (void)feed.frames[i].blobs.push_back(box(1, x, 5, x + 21, 60));
  }
  return feed;
}

template <class Link>
void expect_everything(Running& running, Host<Link>& host, const Feed& feed) {
  const auto all_seen = [&] {
    for (const auto& list : host.seen) {
      if (list.size() < feed.frames.size()) return false;
    }
    return host.create2_x > 0.195 && host.nxt_x > 0.195;
  };
  EXPECT_TRUE(eventually(running.clock(), [&] {
    host.poll(running.clock().now());
    return all_seen() || running.finished();
  }));
  EXPECT_NEAR(host.create2_x, 0.2, 0.005);
  EXPECT_NEAR(host.nxt_x, 0.2, 0.005);
  for (std::size_t camera = 0; camera < Host<Link>::kCameras; ++camera) {
    EXPECT_TRUE(in_order(host.seen[camera], feed)) << Host<Link>::devices()[camera];
  }
}

TEST(AllEmulatedDevices, OnPtysWithTheMachinesOwnBus) {
  const test::Folder folder;
  const Feed feed = small_boxes();
  Running running(feed, unhurried());
  const std::vector<std::string> devices = Host<linux::Tty>::devices();
  for (const std::string& device : devices) running.add(device, open_pty(folder.file(device)));
  running.start();
  Host<linux::Tty> host([&](std::size_t index, std::uint32_t baud) {
    auto tty = linux::Tty::open({folder.file(devices[index]), baud});
    EXPECT_TRUE(tty.ok()) << devices[index];
    return std::make_unique<linux::Tty>(std::move(*tty));
  });
  expect_everything(running, host, feed);
  EXPECT_TRUE(running.join());
}

TEST(AllEmulatedDevices, OnTcp) {
  const Feed feed = small_boxes();
  Running running(feed, unhurried());
  const std::vector<std::string> devices = Host<Socket>::devices();
  for (const std::string& device : devices) running.add(device, open_tcp("0"));
  running.start();
  Host<Socket> host([&](std::size_t index, std::uint32_t) { return std::make_unique<Socket>(running.place(index)); });
  expect_everything(running, host, feed);
  EXPECT_TRUE(running.join());
}

}  // namespace
}  // namespace fencepost::emulate
