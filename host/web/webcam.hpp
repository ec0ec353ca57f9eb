// This machine's camera as a blob camera, on a stationary robot: pictures to boxes, the robot's loop, and the log of
// both.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/segmenter/camera.hpp"
#include "host/video/colours_file.hpp"
#include "host/web/live_log.hpp"

namespace fencepost::host {

/// A word for a colour: "red", "orange", ... "pink".
std::string colour_word(sensor::Rgb rgb);

class Webcam {
 public:
  /// Size of each picture, px: at most segmenter::kWidth along each side.
  Webcam(std::uint16_t width, std::uint16_t height);
  Webcam(const Webcam&) = delete;
  Webcam& operator=(const Webcam&) = delete;

  /// Where the next picture is put: red, green, blue and something else of each pixel, rows from the top.
  [[nodiscard]] std::span<std::uint8_t> pixels() { return rgba_; }
  /// Takes a picture that came at `t`, s on any clock that does not go back. False: the run has ended.
  bool look(double t);

  /// Trains the colour around a pixel of the latest picture. A colour that was found there is trained anew.
  /// Returns JSON: "signature", "name", "rgb", whether it is "patchy" or also "elsewhere". Or why it is "refused":
  /// "grey", "dark" or "full".
  std::string train(int u, int v);
  /// The trained colours, for `--colours`.
  [[nodiscard]] std::string colours() const { return colours_file(trained_); }

  void finish() { live_.finish(); }
  [[nodiscard]] LiveLog& live() { return live_; }

 private:
  [[nodiscard]] std::uint8_t signature_at(int u, int v) const;
  [[nodiscard]] std::string name_for(const TrainedColour& colour) const;
  void write_signature(const NamedColour& colour);
  void configure();

  std::uint16_t width_;
  std::uint16_t height_;
  std::vector<std::uint8_t> rgba_;
  RgbPicture picture_;
  std::vector<std::uint8_t> rows_;  ///< the same, as the segmenter takes it
  std::vector<NamedColour> trained_;
  std::optional<segmenter::Segmenter> segmenter_;
  LiveLog live_;
  std::optional<double> begin_;  ///< s, of the run on that clock
  base::Time last_{0};           ///< of a frame
  base::Time odometry_{0};       ///< of the next sample
  std::uint32_t frames_ = 0;
};

}  // namespace fencepost::host
