// A random drive as the lines of its log. All of it follows from one number, and is the same on every machine: our own
// trigonometry, no distribution of the library's. It is rough on purpose: noise, losses, split and foreign boxes, gaps,
// jumps, drift, movers, commands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "hal/base/trig.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {

class RandomDrive {
 public:
  explicit RandomDrive(std::uint32_t seed) : random_(seed), car_(seed % 5 == 4) {
    choose_camera();
    const int things = 3 + below(9);
    for (int i = 0; i < things; ++i) {
      Thing thing{0.01 * (below(500) - 150),
                  0.01 * (below(400) - 200),
                  0.01 * (2 + below(i % 4 == 0 ? 30 : 8)),
                  0.01 * (4 + below(40)),
                  0,
                  0,
                  1 + below(4)};
      if (chance(8)) thing.vx = 0.01 * (below(60) - 30);
      if (chance(8)) thing.vy = 0.01 * (below(60) - 30);
      things_.push_back(thing);
    }
    drift_ = chance(2) ? 0.001 * (below(80) - 40) : 0;
    frame_every_ = 20 * (1 + below(5));
    noise_ = below(3);
  }

  /// Typed, or sent, before it starts.
  std::string first() {
    std::string lines = camera_ + "\n";
    static constexpr const char* kWidths[] = {"", ",0.064", ",0.080", ""};
    static constexpr const char* kNames[] = {"red", "green", "blue", ""};
    static constexpr const char* kColours[] = {"d02020", "20d020", "2020d0", "d0d020"};
    for (int i = 0; i < 4; ++i) {
      const std::string tail = kWidths[below(4)];
      lines += record::sealed("FPSIG," + std::to_string(i + 1) + "," + kColours[i] + "," + kNames[i] + tail) + "\n";
    }
    if (car_) lines += "set car.counts 2000\nset car.wheelbase 0.17\n";
    for (int i = below(4); i > 0; --i) lines += setting() + "\n";
    return lines;
  }

  /// The lines of the next 20 ms, and their time `t` in seconds.
  std::string next(double& t) {
    t_ += 20;
    move();
    std::string lines;
    if (t_ > silent_until_ && !chance(40)) lines += car_ ? car() : odometry();
    if (t_ % frame_every_ == 0 && !chance(30)) lines += frame();
    if (chance(150)) lines += command() + "\n";
    if (chance(700)) silent_until_ = t_ + 200 * (1 + below(6));
    if (chance(900)) odometry_x_ += 0.01 * below(60);
    t = 0.001 * t_;
    return lines;
  }

 private:
  struct Thing {
    double x, y, radius, height, vx, vy;
    int signature;
  };
  struct Box {
    int signature, x1, y1, x2, y2;
    [[nodiscard]] int area() const { return (x2 - x1 + 1) * (y2 - y1 + 1); }
  };

  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)); }
  bool chance(int one_in) { return below(one_in) == 0; }
  static std::int64_t microradians(double angle) { return static_cast<std::int64_t>(angle * 1e6); }

  void choose_camera() {
    const bool small = chance(4);
    width_ = small ? 88 : 316;
    height_ = small ? 143 : 208;
    focal_ = small ? 108.63 : 188 + 0.1 * below(900);
    lens_height_ = 0.01 * (8 + below(25));
    forward_ = 0.01 * (below(30) - 10);
    static constexpr const char* kPitches[] = {"0.0000", "0.0000", "0.0200", "0.1500", ""};
    static constexpr const char* kDistortions[] = {"0.0000", "0.0000", "-0.0500", "0.0300"};
    const char* distortion = kDistortions[below(4)];  // one after the other: the order of arguments is not fixed
    const char* pitch = kPitches[below(5)];
    const double latency = 0.01 * below(9);
    const char* lens = chance(6) ? ",equidistant" : "";
    char line[200];
    std::snprintf(line, sizeof line, "FPCAM,drawn,%d,%d,%.2f,%.2f,%.2f,%.2f,%s,%.4f,0.0100,%.4f,0.0000,%s,%.4f%s",
                  width_, height_, focal_, focal_, (width_ - 1) / 2.0, (height_ - 1) / 2.0, distortion, forward_,
                  lens_height_, pitch, latency, lens);
    camera_ = record::sealed(line);
  }

  void move() {
    if (--steps_left_ <= 0) {
      static constexpr double kSpeeds[] = {0, 0.1, 0.2, 0.2, 0.35, 0.5, -0.15};
      static constexpr double kTurns[] = {0, 0, 0, 0.3, -0.3, 0.8, -0.8, 2};
      steps_left_ = 15 + below(120);
      speed_ = kSpeeds[below(7)];
      turn_ = kTurns[below(8)];
    }
    constexpr double kStep = 0.02;
    const base::SinCos way = base::sincos_urad(microradians(heading_));
    x_ += kStep * speed_ * static_cast<double>(way.cos);
    y_ += kStep * speed_ * static_cast<double>(way.sin);
    heading_ += kStep * turn_;
    const base::SinCos told = base::sincos_urad(microradians(odometry_heading_));
    odometry_x_ += kStep * speed_ * (1 + drift_) * static_cast<double>(told.cos);
    odometry_y_ += kStep * speed_ * (1 + drift_) * static_cast<double>(told.sin);
    odometry_heading_ += kStep * (turn_ + drift_ * speed_);
    counts_ += kStep * speed_ * 2000;
    for (Thing& thing : things_) {
      thing.x += kStep * thing.vx;
      thing.y += kStep * thing.vy;
    }
  }

  std::string odometry() {
    char line[100];
    std::snprintf(line, sizeof line, "FPODO,%.4f,%.4f,%.4f,%.4f", 0.001 * t_, odometry_x_, odometry_y_,
                  odometry_heading_);
    return record::sealed(line) + "\n";
  }
  std::string car() {
    char line[100];
    std::snprintf(line, sizeof line, "FPCAR,%.4f,%lld,,%.4f", 0.001 * t_, static_cast<long long>(counts_),
                  turn_ + 0.0001 * (below(60) - 30) + 0.01);
    return record::sealed(line) + "\n";
  }

  // Both tangents of a circle, its foot nearest and its top; noise, then what the image holds of it.
  void see(const Thing& thing, std::vector<Box>& boxes) {
    const base::SinCos way = base::sincos_urad(microradians(heading_));
    const double dx = thing.x - x_ - forward_ * static_cast<double>(way.cos);
    const double dy = thing.y - y_ - forward_ * static_cast<double>(way.sin);
    const double depth = dx * static_cast<double>(way.cos) + dy * static_cast<double>(way.sin);
    const double left = dy * static_cast<double>(way.cos) - dx * static_cast<double>(way.sin) - 0.01;
    const double square = depth * depth + left * left - thing.radius * thing.radius;
    if (depth < thing.radius + 0.03 || square <= 0) return;
    const double across = depth * depth - thing.radius * thing.radius;
    const double beside = thing.radius * std::sqrt(square);
    const double middle = (width_ - 1) / 2.0;
    const double foot = (height_ - 1) / 2.0 + focal_ * lens_height_ / (depth - thing.radius);
    const double top = (height_ - 1) / 2.0 + focal_ * (lens_height_ - thing.height) / depth;
    const auto at = [this](double edge) {
      return static_cast<int>(std::clamp(edge, -9999.0, 9999.0)) + below(2 * noise_ + 1) - noise_;
    };
    Box box{thing.signature, at(middle - focal_ * (left * depth + beside) / across + 0.5), at(top + 0.5),
            at(middle - focal_ * (left * depth - beside) / across - 0.5), at(foot - 0.5)};
    if (box.x2 < box.x1 || box.y2 < box.y1 || box.x1 >= width_ || box.x2 < 0 || box.y1 >= height_ || box.y2 < 0) return;
    box = {box.signature, std::max(box.x1, 0), std::max(box.y1, 0), std::min(box.x2, width_ - 1),
           std::min(box.y2, height_ - 1)};
    if (box.x2 > box.x1 + 4 && chance(25)) {  // split, a column lost between
      const int cut = (box.x1 + box.x2) / 2;
      boxes.push_back({box.signature, cut + 1, box.y1, box.x2, box.y2});
      box.x2 = cut - 1;
    }
    boxes.push_back(box);
  }

  std::string frame() {
    std::vector<Box> boxes;
    for (const Thing& thing : things_) {
      if (!chance(12)) see(thing, boxes);
    }
    if (chance(20)) boxes.push_back({1 + below(4), below(40), below(60), 40 + below(40), 60 + below(60)});
    std::stable_sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.area() > b.area(); });
    if (boxes.size() > 16) boxes.resize(16);
    std::string line = "FPFRM,";
    char part[120];
    std::snprintf(part, sizeof part, "%.4f,%u,%zu", 0.001 * t_ + 0.0001, frame_++, boxes.size());
    line += part;
    for (const Box& box : boxes) {
      std::snprintf(part, sizeof part, ",%d,%d,%d,%d,%d,%.1f,%.1f,%d,", box.signature, box.x1, box.y1, box.x2, box.y2,
                    (box.x1 + box.x2) / 2.0, (box.y1 + box.y2) / 2.0, chance(9) ? 0 : box.area() * 4 / 5);
      line += part;
      if (!chance(3)) line += chance(2) ? "d02020" : "30c040";
    }
    return record::sealed(line) + "\n";
  }

  std::string setting() {
    static constexpr const char* kSettings[] = {"set correct.pose on",  "set correct.pose off", "set correct.pose auto",
                                                "set correct.drift 8",  "set camera.noise 1.2", "set robot.width 0.35",
                                                "set robot.front 0.2",  "set robot.rear 0.3",   "set robot.margin 0.12",
                                                "set confirm.k 2",      "set confirm.n 7",      "set alert.rate 20",
                                                "set alert.stop 0.4",   "set alert.warn 0.9",   "set alert.notice 2",
                                                "set alert.ttc_stop 2", "set alert.ttc_warn 5", "set robot.width 0.05"};
    return kSettings[below(static_cast<int>(std::size(kSettings)))];
  }
  std::string command() {
    static constexpr const char* kCommands[] = {"objects",   "map",        "next",      "next 1",     "next 2",
                                                "status",    "sectors",    "calibrate", "stop",       "go",
                                                "mode text", "mode log",   "mode plot", "alerts off", "alerts on",
                                                "watch",     "mode quiet", "get",       "objekts"};
    return chance(3) ? setting() : kCommands[below(static_cast<int>(std::size(kCommands)))];
  }

  std::mt19937 random_;
  bool car_;
  std::string camera_;
  int width_ = 0, height_ = 0, frame_every_ = 0, noise_ = 0;
  double focal_ = 0, lens_height_ = 0, forward_ = 0;
  std::vector<Thing> things_;
  int t_ = 0, silent_until_ = 0;
  unsigned frame_ = 0;
  int steps_left_ = 0;
  double speed_ = 0, turn_ = 0, drift_ = 0, counts_ = 0;
  double x_ = 0, y_ = 0, heading_ = 0, odometry_x_ = 0, odometry_y_ = 0, odometry_heading_ = 0;
};

}  // namespace fencepost::test
