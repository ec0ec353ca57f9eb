#include "host/import/take_times.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/import/table.hpp"

namespace fencepost::host {
namespace {

/// s. Longest time of a record stream.
constexpr double kMaxSpan = 999'999;
/// s. Longest time without poses; each second of it becomes 50 poses.
constexpr double kMaxStationary = 36'000;
/// s. Shortest median step that is taken for another unit: 5 ms, of a camera with 200 frames a second.
constexpr double kMinForeignStep = 5;

template <class Item>
std::vector<double> times_of(const std::vector<Item>& items) {
  std::vector<double> times;
  for (const Item& item : items) times.push_back(item.t);
  return times;
}

struct Gap {
  double from = 0;
  double length = 0;
};

Gap longest_gap(const std::vector<double>& times) {
  Gap longest;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double length = times[i] - times[i - 1];
    if (length > longest.length) longest = {times[i - 1], length};
  }
  return longest;
}

/// Median step; 0 for fewer than three times, since one step can as well be a gap.
double usual_step(const std::vector<double>& times) {
  if (times.size() < 3) return 0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

/// For steps of 5 ms to 5 s.
const char* unit_of(double step) {
  if (step < 1e3 * kMinForeignStep) return "milliseconds";
  return step < 1e6 * kMinForeignStep ? "microseconds" : "nanoseconds";
}

std::string foreign_step(double step) { return fmt::format("times go up by {:.0f} between rows", step); }

}  // namespace

void check_times(Taken& taken, const std::string& source) {
  const std::vector<double> frames = times_of(taken.frames);
  const double step = usual_step(frames);
  const bool foreign = step >= kMinForeignStep;
  std::vector<double> all = times_of(taken.poses);
  for (const TakenCar& car : taken.car) all.push_back(car.t);
  const bool stationary = all.empty();
  all.insert(all.end(), frames.begin(), frames.end());
  std::ranges::sort(all);
  const double span = all.back() - all.front();
  const double limit = stationary ? kMaxStationary : kMaxSpan;
  if (foreign && (stationary || span > limit)) {
    throw ImportProblem{source, foreign_step(step),
                        fmt::format("are they {}? The importer reads seconds", unit_of(step))};
  }
  if (span > limit) {
    const Gap gap = longest_gap(all);
    if (gap.length > limit / 2) {
      throw ImportProblem{source, fmt::format("has a gap of {:.0f} s behind the time {:.3f} s", gap.length, gap.from),
                          "leave out the rows before it or behind it; frames and poses need one clock"};
    }
    throw ImportProblem{source, fmt::format("lasts {:.0f} s", span),
                        fmt::format("at most {:.0f} s can be imported{}", limit, stationary ? " without poses" : "")};
  }
  if (foreign) {
    taken.notes.push_back(foreign_step(step) + fmt::format(": are they {}? Seconds were read", unit_of(step)));
  }
}

}  // namespace fencepost::host
