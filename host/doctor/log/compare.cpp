#include "host/doctor/log/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/doctor/log/text.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::doctor {
namespace {

/// Allowed difference of two drives: a share of the good value, or `least` of the quantity itself if that is more.
struct Allowed {
  double share = 0;
  double least = 0;
};

class Comparison {
 public:
  void lower_is_worse(const std::string& what, double today, double good, Allowed allowed) {
    if (good - today > std::max(allowed.least, allowed.share * good)) worse_.push_back({what, today, good});
  }
  void higher_is_worse(const std::string& what, double today, double good, Allowed allowed) {
    if (today - good > std::max(allowed.least, allowed.share * good)) worse_.push_back({what, today, good});
  }
  [[nodiscard]] std::vector<Worse> take() { return std::move(worse_); }

 private:
  std::vector<Worse> worse_;
};

double a_thousand(double count, double of) { return of > 0 ? 1000 * count / of : 0; }

double lines_of(const LogSurvey& survey) {
  return static_cast<double>(survey.counts.records) + survey.counts.foreign + survey.counts.rejected();
}

double a_minute(double count, const LogSurvey& survey) { return survey.seconds > 0 ? 60 * count / survey.seconds : 0; }

double down_share(const LogSurvey& survey) {
  double seconds = 0;
  for (const auto& [device, trouble] : survey.links) seconds += trouble.seconds;
  return survey.seconds > 0 ? 100 * seconds / survey.seconds : 0;
}

double refused_of(const LogSurvey& survey) {
  const RefusedFrames& refused = survey.replayed.result.log.refused;
  return static_cast<double>(refused.no_pose + refused.odometry_gap + refused.no_camera + refused.queue);
}

const ColourQuality* find(const LogSurvey& survey, std::uint8_t signature) {
  const auto found = std::ranges::find(survey.colours, signature, &ColourQuality::signature);
  return found == survey.colours.end() ? nullptr : &*found;
}

void compare_colours(const LogSurvey& today, const LogSurvey& good, Comparison& comparison) {
  for (const ColourQuality& was : good.colours) {
    const std::string name = colour_name(good, was.signature);
    const ColourQuality* now = find(today, was.signature);
    const ColourQuality nothing;
    const ColourQuality& is = now != nullptr ? *now : nothing;
    // How long a thing is in view is the drive's affair; to half of it, the colour's.
    comparison.lower_is_worse(name + ": seen, % of the frames", 100 * is.seen, 100 * was.seen, {0.5, 5});
    if (now == nullptr) continue;
    comparison.higher_is_worse(name + ": blobs a frame", is.blobs, was.blobs, {0.5, 0.5});
    comparison.higher_is_worse(name + ": flicker, of 100 frames", is.flicker, was.flicker, {0.5, 2});
    if (is.jitter_px > 0 && was.jitter_px > 0) {
      comparison.higher_is_worse(name + ": jitter, px", is.jitter_px, was.jitter_px, {0.5, 0.5});
    }
  }
}

}  // namespace

std::vector<Worse> what_is_worse(const LogSurvey& today, const LogSurvey& good) {
  Comparison comparison;
  comparison.lower_is_worse("frames a second", today.camera.rate, good.camera.rate, {0.1, 0});
  comparison.lower_is_worse("odometry a second", today.odometry.rate, good.odometry.rate, {0.1, 0});
  comparison.higher_is_worse("longest gap in the frames, s", today.camera.longest, good.camera.longest, {1, 0.1});
  comparison.higher_is_worse("longest gap in the odometry, s", today.odometry.longest, good.odometry.longest, {1, 0.1});
  comparison.higher_is_worse("rejected lines, of 1000", a_thousand(today.counts.rejected(), lines_of(today)),
                             a_thousand(good.counts.rejected(), lines_of(good)), {1, 0.5});
  comparison.higher_is_worse(
      "missing frames, of 1000",
      a_thousand(static_cast<double>(today.frames_missing), static_cast<double>(today.camera.count)),
      a_thousand(static_cast<double>(good.frames_missing), static_cast<double>(good.camera.count)), {1, 5});
  comparison.higher_is_worse("refused frames, of 1000",
                             a_thousand(refused_of(today), static_cast<double>(today.camera.count)),
                             a_thousand(refused_of(good), static_cast<double>(good.camera.count)), {1, 5});
  comparison.higher_is_worse("jumps of the pose a minute", a_minute(static_cast<double>(today.pose_jumps), today),
                             a_minute(static_cast<double>(good.pose_jumps), good), {1, 0.5});
  comparison.higher_is_worse("devices down, % of the time", down_share(today), down_share(good), {1, 1});
  comparison.higher_is_worse("blind, s", today.blind_seconds, good.blind_seconds, {1, 0.2});
  compare_colours(today, good, comparison);
  return comparison.take();
}

std::string worse_text(const std::vector<Worse>& worse, const std::string& good_name) {
  if (worse.empty()) return fmt::format("nothing is worse than in {}\n", printable(good_name));
  std::string text = fmt::format("{:<38} {:>8} {:>8}\n", "worse than in " + printable(good_name), "today", "then");
  for (const Worse& item : worse) {
    text += fmt::format("  {:<36} {:>8.4g} {:>8.4g}\n", printable(item.what), item.today, item.good);
  }
  return text;
}

nlohmann::ordered_json worse_json(const std::vector<Worse>& worse) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Worse& item : worse) {
    list.push_back({{"what", printable(item.what)}, {"today", item.today}, {"good", item.good}});
  }
  return list;
}

}  // namespace fencepost::host::doctor
