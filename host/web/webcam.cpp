#include "host/web/webcam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/scene/rgb.hpp"
#include "host/simulate/odometer.hpp"

namespace fencepost::host {
namespace {

/// s before the first picture: the robot stood there when it was exposed.
constexpr double kBefore = 0.1;
/// px to each side of a pixel that is clicked: much of a small thing, and enough to know its shades.
constexpr int kAround = 4;
/// Shares of red, green and blue that are nearer to a third are grey: other lamps move them by as much.
constexpr double kGreyShare = 0.06;

bool is_grey(sensor::Rgb rgb) {
  const double sum = std::max(1, rgb.red + rgb.green + rgb.blue);
  const auto near = [&](int part) { return std::abs(part / sum - 1 / 3.0) < kGreyShare; };
  return near(rgb.red) && near(rgb.green) && near(rgb.blue);
}

}  // namespace

std::string colour_word(sensor::Rgb rgb) {
  const int high = std::max({rgb.red, rgb.green, rgb.blue});
  const int spread = std::max(1, high - std::min({rgb.red, rgb.green, rgb.blue}));
  const auto sixth = [&](int from, int to) { return 60 * (from - to) / spread; };
  const int hue = high == rgb.red     ? sixth(rgb.green, rgb.blue)
                  : high == rgb.green ? 120 + sixth(rgb.blue, rgb.red)
                                      : 240 + sixth(rgb.red, rgb.green);
  struct Word {
    int below;  // degrees
    std::string_view word;
  };
  constexpr std::array<Word, 9> kWords = {{{-20, "pink"},
                                           {15, "red"},
                                           {45, "orange"},
                                           {70, "yellow"},
                                           {165, "green"},
                                           {200, "cyan"},
                                           {260, "blue"},
                                           {295, "purple"},
                                           {360, "pink"}}};
  return std::string(
      std::find_if(kWords.begin(), kWords.end() - 1, [&](const Word& one) { return hue < one.below; })->word);
}

Webcam::Webcam(std::uint16_t width, std::uint16_t height)
    : width_(width),
      height_(height),
      rgba_(std::size_t{4} * width * height),
      picture_{width, height, std::vector<sensor::Rgb>(std::size_t{1} * width * height)},
      rows_(std::size_t{3} * width * height) {
  record::Header header;
  header.product = "fencepost";
  header.version = FENCEPOST_VERSION;
  header.target = "webcam";
  header.profile = "full";
  live_.write(header);
  live_.write(segmenter::profile_of(width_, height_));
  configure();
}

void Webcam::configure() {
  segmenter::Config config;
  config.rules = segmenter::rules_of(width_, height_);
  for (const NamedColour& colour : trained_) (void)config.ranges.push_back(colour.trained.range);
  segmenter_.emplace(config);
}

bool Webcam::look(double t) {
  if (!begin_) begin_ = t - kBefore;
  if (t - *begin_ > LiveLog::kLongest) return false;
  last_ = std::max(base::Time::nearest(t - *begin_), base::Time{last_.raw + 1});
  for (std::size_t i = 0; i < picture_.pixels.size(); ++i) {
    picture_.pixels[i] = {rgba_[4 * i], rgba_[4 * i + 1], rgba_[4 * i + 2]};
    std::copy_n(&rgba_[4 * i], 3, &rows_[3 * i]);
  }
  for (; odometry_ <= last_; odometry_ = odometry_ + kOdometryPeriod) {
    live_.write(sensor::OdometrySample{odometry_, {}, {}, {}});
  }
  const auto found =
      segmenter_->segment({bus::PixelLayout::kRgb, width_, height_, std::size_t{3} * width_, rows_, last_});
  if (!found) return false;
  sensor::BlobFrame frame = *found;
  frame.frame = frames_++;
  return live_.write(frame);
}

std::uint8_t Webcam::signature_at(int u, int v) const {
  const sensor::Rgb rgb = picture_.at(u, v);
  std::vector<segmenter::ColourRange> ranges;
  for (const NamedColour& colour : trained_) ranges.push_back(colour.trained.range);
  return segmenter::signature_of(ranges, rgb.red, rgb.green, rgb.blue);
}

// "red", "red 2", ...
std::string Webcam::name_for(const TrainedColour& colour) const {
  const std::string word = colour_word(colour.rgb);
  std::string name = word;
  const auto taken = [&](const NamedColour& other) { return other.name == name; };
  for (int i = 2; std::any_of(trained_.begin(), trained_.end(), taken); ++i) name = fmt::format("{} {}", word, i);
  return name;
}

void Webcam::write_signature(const NamedColour& colour) {
  live_.write(record::Signature{colour.trained.range.signature, colour.trained.rgb, sensor::Text(colour.name)});
}

std::string Webcam::train(int u, int v) {
  const auto refused = [](const char* why) { return nlohmann::json{{"refused", why}}.dump(); };
  u = std::clamp(u, 0, width_ - 1);
  v = std::clamp(v, 0, height_ - 1);
  const std::uint8_t known = signature_at(u, v);
  if (known == 0 && trained_.size() == segmenter::kMaxRanges) return refused("full");
  const int left = std::max(0, u - kAround);
  const int top = std::max(0, v - kAround);
  const TrainingBox box{left, top, std::min<int>(width_, u + kAround + 1) - left,
                        std::min<int>(height_, v + kAround + 1) - top,
                        known != 0 ? known : static_cast<std::uint8_t>(trained_.size() + 1)};
  const TrainedColour colour = train_colours(picture_, {&box, 1}).front();
  if (colour.found == 0) return refused("dark");
  if (is_grey(colour.rgb)) return refused("grey");
  if (known == 0) trained_.push_back({colour, name_for(colour)});
  NamedColour& named = trained_[box.signature - 1U];
  named.trained = colour;
  configure();
  write_signature(named);
  return nlohmann::json{{"signature", box.signature},
                        {"name", named.name},
                        {"rgb", rgb_text(colour.rgb)},
                        {"patchy", is_patchy(colour)},
                        {"elsewhere", is_elsewhere(colour, width_, height_)}}
      .dump();
}

}  // namespace fencepost::host
