// One robot: a board, its camera, its odometry, the loop and all memory. There is one of it, and nothing else.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/app/loop.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/image/boot.hpp"
#include "firmware/image/keeper.hpp"
#include FENCEPOST_BOARD
#include FENCEPOST_CAMERA
#include FENCEPOST_ODOMETRY

namespace fencepost::image {

using Profile = config::FENCEPOST_PROFILE;
using Console = std::remove_reference_t<decltype(board::console())>;

inline const record::Header kHeader = {record::kStreamFormat, "fencepost", FENCEPOST_VERSION, board::kTarget,
                                       Profile::kName};

class Robot {
 public:
  Robot()
      : loop_(memory_, camera_, odometry_, board::console(), app::Mode::kText), keeper_(pipeline(), board::flash()) {}

  void start() {
    board::start(FENCEPOST_CONSOLE_BAUD);
    Camera::start();
    Odometry::start();
    pipeline().start_run(kHeader);
    if (const auto camera = Camera::calibration(); camera.width > 0) pipeline().set_camera(camera);
    keeper_.restore();
    const BootFacts facts{kHeader, board::take_reset_reason(), board::take_panic()};
    for (std::size_t n = 0; n < kBootLines; ++n) {
      pipeline().telling().say([&](std::span<char> room) { return write_boot_line(n, facts, room); });
    }
  }

  void turn() {
    work();
    board::idle();
  }

 private:
  // Not inlined: its instructions are counted by that name.
  [[gnu::noinline]] void work() {
    const std::uint32_t began = board::clock().microseconds();
    board::feed_watchdog();
    loop_.step(board::clock().now());
    if (!keeper_.keep()) pipeline().telling().say(not_kept);
    const std::uint32_t took = board::clock().microseconds() - began;
    std::uint32_t& longest = memory_.counters.loop_us_max;
    longest = took > longest ? took : longest;
  }

  static std::size_t not_kept(std::span<char> room) {
    return app::Sentence(room).put("error: the change holds until the next reset: it could not be written").end();
  }
  app::Pipeline<Profile>& pipeline() { return loop_.pipeline(); }

  app::Memory<Profile> memory_;
  Camera camera_{memory_.counters};
  Odometry odometry_{memory_.counters};
  app::Loop<Profile, Camera, Odometry, Console> loop_;
  Keeper<Profile, board::Flash> keeper_;
};

}  // namespace fencepost::image
