#include "host/calibrate/causes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <variant>

#include "host/calibrate/findings.hpp"
#include "host/calibrate/fit.hpp"
#include "host/calibrate/pads.hpp"
#include "host/calibrate/regroup.hpp"

namespace fencepost::host {
namespace {

constexpr double kSure = 3;           ///< sigmas
constexpr double kWidthError = 0.05;  ///< of a width in FPSIG (share/doc/stream.md)

using Matrix = std::vector<std::vector<double>>;

/// One number that could be wrong, or the pads of all signatures together.
struct Suspect {
  CauseKind kind;
  std::optional<std::size_t> of{};    ///< index of a signature's numbers
  std::vector<std::size_t> places{};  ///< in the covariance
  std::vector<std::size_t> rows{};    ///< in Contradiction
  double least = 0;                   ///< below this no map notices
};

/// The inverse of a positive definite matrix, by Gauss and Jordan; nothing where it is singular.
std::optional<Matrix> inverted(Matrix a) {
  const std::size_t size = a.size();
  for (std::size_t k = 0; k < size; ++k) {
    const double pivot = a[k][k];
    if (!(std::abs(pivot) > 0)) return std::nullopt;
    a[k][k] = 1;
    for (double& value : a[k]) value /= pivot;
    for (std::size_t i = 0; i < size; ++i) {
      if (i == k) continue;
      const double factor = std::exchange(a[i][k], 0);
      for (std::size_t j = 0; j < size; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return a;
}

/// Least squares of few unknowns, as the whole problem has it near its optimum.
struct Contradiction {
  Matrix weights;           ///< the inverse of the covariance
  std::vector<double> off;  ///< the optimum minus the configured value
};

struct Explained {
  double gain = 0;  ///< decrease of the sum of squares
  std::vector<double> variances{};
};

Explained explain(const Contradiction& all, const std::vector<Suspect>& suspects,
                  const std::vector<std::size_t>& chosen) {
  const std::size_t size = chosen.size();
  Matrix normal(size, std::vector<double>(size));
  std::vector<double> right(size);
  for (std::size_t a = 0; a < size; ++a) {
    for (const std::size_t i : suspects[chosen[a]].rows) {
      for (std::size_t j = 0; j < all.off.size(); ++j) right[a] += all.weights[i][j] * all.off[j];
      for (std::size_t b = 0; b < size; ++b) {
        for (const std::size_t j : suspects[chosen[b]].rows) normal[a][b] += all.weights[i][j];
      }
    }
  }
  const auto inverse = inverted(std::move(normal));
  if (!inverse) return {};
  Explained explained;
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b < size; ++b) explained.gain += right[a] * (*inverse)[a][b] * right[b];
    explained.variances.push_back((*inverse)[a][a]);
  }
  return explained;
}

/// A gain that one number may bring by chance no more often than three sigmas are exceeded.
constexpr double kMinGain = kSure * kSure * kCaution * kCaution;

std::vector<std::size_t> with(std::vector<std::size_t> chosen, std::size_t one) {
  chosen.push_back(one);
  return chosen;
}

/// The suspect that explains most beside those chosen.
std::optional<std::size_t> best_beside(const Contradiction& all, const std::vector<Suspect>& suspects,
                                       const std::vector<std::size_t>& chosen) {
  double most = explain(all, suspects, chosen).gain + kMinGain;
  std::optional<std::size_t> best;
  for (std::size_t s = 0; s < suspects.size(); ++s) {
    if (std::ranges::find(chosen, s) != chosen.end()) continue;
    const double gain = explain(all, suspects, with(chosen, s)).gain;
    if (gain <= most) continue;
    most = gain;
    best = s;
  }
  return best;
}

/// Drops what the others explain.
void drop_needless(const Contradiction& all, const std::vector<Suspect>& suspects, std::vector<std::size_t>& chosen) {
  for (std::size_t i = 0; i < chosen.size() && chosen.size() > 1;) {
    std::vector<std::size_t> others = chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double lost = explain(all, suspects, chosen).gain - explain(all, suspects, others).gain;
    if (lost < kMinGain) {
      chosen = std::move(others);
    } else {
      ++i;
    }
  }
}

std::vector<std::size_t> choose(const Contradiction& all, const std::vector<Suspect>& suspects) {
  constexpr std::size_t kMaxCauses = 6;
  std::vector<std::size_t> chosen;
  while (chosen.size() < kMaxCauses) {
    const auto best = best_beside(all, suspects, chosen);
    if (!best) break;
    chosen.push_back(*best);
    drop_needless(all, suspects, chosen);
  }
  return chosen;
}

/// Other kinds of causes that would explain nearly as much in place of `chosen[i]`.
std::vector<CauseKind> instead_of(const Contradiction& all, const std::vector<Suspect>& suspects,
                                  const std::vector<std::size_t>& chosen, std::size_t i) {
  const double gain = explain(all, suspects, chosen).gain;
  std::vector<CauseKind> kinds;
  for (std::size_t s = 0; s < suspects.size(); ++s) {
    if (suspects[s].kind == suspects[chosen[i]].kind) continue;
    if (std::ranges::find(chosen, s) != chosen.end()) continue;
    std::vector<std::size_t> other = chosen;
    other[i] = s;
    if (explain(all, suspects, other).gain < gain - kMinGain) continue;
    if (std::ranges::find(kinds, suspects[s].kind) == kinds.end()) kinds.push_back(suspects[s].kind);
  }
  return kinds;
}

double& number_at(Estimate& estimate, std::size_t place) {
  if (place < kCameraParameters) return estimate.camera[place];
  if (place < kCalibrated) return estimate.wheels[place - kCameraParameters];
  return estimate.kinds[(place - kCalibrated) / kKindParameters][(place - kCalibrated) % kKindParameters];
}

class Search {
 public:
  Search(const DriveLog& log, StartedProblem started)
      : log_(log), started_(std::move(started)), configured_(started_.estimate) {}

  std::vector<Cause> causes() {
    if (!fit_all()) return {};
    const std::vector<std::size_t> chosen = choose(all_, suspects_);
    if (chosen.empty()) return {};
    if (!fit_chosen(chosen)) return {};
    std::vector<Cause> causes;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Suspect& suspect = suspects_[chosen[i]];
      if (suspect.kind == CauseKind::kPad && objects_of(suspect).size() < kMinPadObjects) continue;
      const double value = value_of(suspect, started_.estimate);
      if (std::abs(value) < suspect.least) continue;
      const double formal = kCaution * std::sqrt(explain(all_, suspects_, chosen).variances[i]);
      const double sigma = std::max(formal, scatter_of(suspect));
      if (std::abs(value) < kSure * sigma) continue;
      causes.push_back(described(suspect, value, sigma));
      causes.back().or_else = instead_of(all_, suspects_, chosen, i);
    }
    return causes;
  }

 private:
  /// Everything that may be wrong is free. False: the log cannot say.
  bool fit_all() {
    if (solve(started_.problem, only_objects(), started_.estimate)) return false;
    free_ = possible(started_.problem);
    free_.hold_camera[kK1] = true;
    free_.free_kinds.assign(started_.estimate.kinds.size(), {true, !started_.problem.sizes.empty()});
    if (fit(started_, free_, [] {}) || too_few(started_.estimate.objects.size())) return false;
    const auto matrix = covariance_at(started_.problem, free_, started_.estimate);
    if (!matrix) return false;
    add_suspects();
    return believable() && contradict(*matrix);
  }

  /// Where the whole map has shrunk, every error is small.
  [[nodiscard]] bool believable() const {
    constexpr double kMaxSigmas = 6;  // sigmas of the prior
    const auto within = [](double off, double sigma) { return std::abs(off) < kMaxSigmas * sigma; };
    const CalibrationProblem& problem = started_.problem;
    for (std::size_t i = 0; i < kCameraParameters; ++i) {
      if (!within(started_.estimate.camera[i] - configured_.camera[i], problem.camera_sigma[i])) return false;
    }
    for (std::size_t i = 0; i < kWheelParameters; ++i) {
      if (!within(started_.estimate.wheels[i] - configured_.wheels[i], problem.wheel_sigma[i])) return false;
    }
    return true;
  }

  void add_suspects() {
    const auto add = [&](CauseKind kind, std::size_t place, bool held = false) {
      if (!held) suspects_.push_back({kind, std::nullopt, {place}, {}, of_use(place)});
    };
    add(CauseKind::kFocal, kFocal);
    add(CauseKind::kYaw, kYaw);
    add(CauseKind::kPitch, kPitch, free_.hold_camera[kPitch] || !log_.camera.mount.pitch);
    add(CauseKind::kLatency, kLatency);
    add(CauseKind::kHeight, kHeight, free_.hold_camera[kHeight]);
    add(CauseKind::kStep, place_of(kStep), free_.hold_wheels[kStep]);
    add(CauseKind::kTurn, place_of(kTurn));
    add(CauseKind::kCurve, place_of(kCurve));
    std::set<std::size_t> seen;
    std::set<std::size_t> sized;
    for (const Sighting& sighting : started_.problem.sightings) seen.insert(started_.problem.kinds[sighting.object]);
    for (const KnownSize& size : started_.problem.sizes) sized.insert(started_.problem.kinds[size.object]);
    Suspect padded{CauseKind::kPad, std::nullopt, {}, {}, kMinPad};
    for (const std::size_t k : seen) {
      padded.places.push_back(place_of(k, kPad));
      if (seen.size() > 1) suspects_.push_back({CauseKind::kPad, k, {place_of(k, kPad)}, {}, kMinPad});
      if (sized.contains(k)) suspects_.push_back({CauseKind::kWidth, k, {place_of(k, kWidthRatio)}, {}, kWidthError});
    }
    suspects_.push_back(std::move(padded));
  }

  /// Numbers that are no suspects stay free. False: singular.
  bool contradict(const CalibratedMatrix& matrix) {
    std::set<std::size_t> places;
    for (const Suspect& suspect : suspects_) places.insert(suspect.places.begin(), suspect.places.end());
    const std::vector<std::size_t> order(places.begin(), places.end());
    Matrix covariance;
    for (const std::size_t i : order) {
      covariance.emplace_back();
      for (const std::size_t j : order) covariance.back().push_back(matrix[i][j]);
      all_.off.push_back(number_at(started_.estimate, i) - number_at(configured_, i));
    }
    for (Suspect& suspect : suspects_) {
      for (const std::size_t place : suspect.places) {
        suspect.rows.push_back(static_cast<std::size_t>(std::ranges::lower_bound(order, place) - order.begin()));
      }
    }
    auto inverse = inverted(std::move(covariance));
    if (inverse) all_.weights = std::move(*inverse);
    return inverse.has_value();
  }

  /// The same with only the chosen suspects free, and those that never were any.
  bool fit_chosen(const std::vector<std::size_t>& chosen) {
    for (const Suspect& suspect : suspects_) {
      for (const std::size_t place : suspect.places) {
        number_at(started_.estimate, place) = number_at(configured_, place);
        hold(place);
      }
    }
    for (const std::size_t c : chosen) {
      for (const std::size_t place : suspects_[c].places) release(place);
    }
    share_pads(chosen);
    return !solve(started_.problem, free_, started_.estimate);
  }
  void hold(std::size_t place) { set_free(place, false); }
  void release(std::size_t place) { set_free(place, true); }
  void set_free(std::size_t place, bool is_free) {
    if (place < kCameraParameters) {
      free_.hold_camera[place] = !is_free;
    } else if (place < kCalibrated) {
      free_.hold_wheels[place - kCameraParameters] = !is_free;
    } else {
      free_.free_kinds[(place - kCalibrated) / kKindParameters][(place - kCalibrated) % kKindParameters] = is_free;
    }
  }

  /// Signatures that nothing is said about singly have their pads in one place.
  void share_pads(const std::vector<std::size_t>& chosen) {
    std::set<std::size_t> single;
    bool all = false;
    for (const std::size_t c : chosen) {
      if (suspects_[c].of) single.insert(*suspects_[c].of);
      all = all || (suspects_[c].kind == CauseKind::kPad && !suspects_[c].of);
    }
    if (!all) return;
    for (std::size_t& kind : started_.problem.kinds) {
      if (single.contains(kind)) continue;
      if (!shared_) shared_ = kind;
      kind = *shared_;
    }
  }

  double value_of(const Suspect& suspect, const Estimate& estimate) {
    Estimate found = estimate;
    const std::size_t place =
        suspect.kind == CauseKind::kPad && !suspect.of && shared_ ? place_of(*shared_, kPad) : suspect.places.front();
    return number_at(found, place) - number_at(configured_, place);
  }

  [[nodiscard]] bool is_about(const Suspect& suspect, const Sighting& sighting) const {
    return !suspect.of || started_.problem.kinds[sighting.object] == *suspect.of;
  }

  [[nodiscard]] std::set<std::size_t> objects_of(const Suspect& suspect) const {
    std::set<std::size_t> objects;
    for (const Sighting& sighting : started_.problem.sightings) {
      if (is_about(suspect, sighting)) objects.insert(sighting.object);
    }
    return objects;
  }

  /// The standard deviation by the jackknife: each time an object's sightings are left out; of few objects, some of
  /// one's.
  double scatter_of(const Suspect& suspect) {
    constexpr std::size_t kParts = 8;
    std::map<std::size_t, std::size_t> count;
    for (const Sighting& sighting : started_.problem.sightings) {
      if (is_about(suspect, sighting)) ++count[sighting.object];
    }
    const std::size_t blocks = count.size() < kMinPadObjects ? (kParts + count.size() - 1) / count.size() : 1;
    const std::size_t parts = std::min(blocks * count.size(), kParts);
    std::vector<double> values;
    for (std::size_t part = 0; part < parts; ++part) {
      CalibrationProblem problem = started_.problem;
      std::map<std::size_t, std::size_t> rank;
      std::erase_if(problem.sightings, [&](const Sighting& sighting) {
        if (!is_about(suspect, sighting)) return false;
        const auto object = static_cast<std::size_t>(std::distance(count.begin(), count.find(sighting.object)));
        const std::size_t block = blocks * rank[sighting.object]++ / count[sighting.object];
        return (object * blocks + block) % parts == part;
      });
      Estimate estimate = started_.estimate;
      if (solve(problem, free_, estimate)) continue;
      values.push_back(value_of(suspect, estimate));
    }
    const auto size = static_cast<double>(values.size());
    double mean = 0;
    double squares = 0;
    for (const double value : values) mean += value / size;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::sqrt((size - 1) / size * squares);
  }

  Cause described(const Suspect& suspect, double value, double sigma) {
    Cause cause;
    cause.kind = suspect.kind;
    cause.sigma = sigma;
    const std::set<std::size_t> objects = objects_of(suspect);
    cause.sightings = static_cast<std::size_t>(std::ranges::count_if(
        started_.problem.sightings, [&](const Sighting& sighting) { return is_about(suspect, sighting); }));
    cause.objects = objects.size();
    if (suspect.of) cause.signature = started_.signatures[*objects.begin()];
    cause.configured =
        suspect.of || suspect.kind == CauseKind::kPad ? 0 : number_at(configured_, suspect.places.front());
    cause.found = cause.configured + value;
    if (suspect.kind == CauseKind::kFocal) {
      cause.configured = log_.camera.fx.to_double();
      cause.found = cause.configured * std::exp(value);
      cause.sigma *= cause.found;
    } else if (suspect.kind == CauseKind::kWidth) {
      cause.configured = width_of(log_, *cause.signature);
      cause.found = cause.configured * std::exp(value);
      cause.sigma *= cause.found;
    }
    return cause;
  }

  static double width_of(const DriveLog& log, std::uint8_t signature) {
    const auto known = std::ranges::find(log.signatures, signature, &record::Signature::signature);
    return known == log.signatures.end() ? 0 : known->width / 1e3;
  }

 public:
  /// Widths that the log's FPSIG have.
  static void add_widths(const DriveLog& log, StartedProblem& started) {
    for (std::size_t o = 0; o < started.signatures.size(); ++o) {
      const double width = width_of(log, started.signatures[o]);
      if (width > 0) started.problem.sizes.push_back({o, width, kWidthError * width});
    }
  }

 private:
  const DriveLog& log_;
  StartedProblem started_;
  Estimate configured_;
  SolverOptions free_;
  std::vector<Suspect> suspects_;
  Contradiction all_;
  std::optional<std::size_t> shared_;  ///< index of the signature whose pad is that of all others
};

/// True: there is more of it. A fault lasts, so the beginning shows it.
bool cut(DriveLog& log) {
  if (log.frames.empty()) return false;
  const double end = log.frames.front().t + kJudgedSeconds;
  if (log.frames.back().t <= end) return false;
  std::erase_if(log.frames, [&](const SeenFrame& frame) { return frame.t > end; });
  const auto after = std::ranges::find_if(log.odometry, [&](const TimedPose& pose) { return pose.t >= end; });
  if (after != log.odometry.end()) log.odometry.erase(after + 1, log.odometry.end());
  return true;
}

/// Wheels roll along their heading: the model of their errors has no way to the side.
bool moves_sideways(const OdometryTrack& track) {
  constexpr double kMaxShare = 0.1;  // of the way
  double moved = 0;
  for (double t = track.begin(); t < track.end(); t += 1) {
    const TrackPose a = track.at(t);
    const TrackPose b = track.at(std::min(t + 1, track.end()));
    moved += std::hypot(b.x - a.x, b.y - a.y);
  }
  return track.driven() < (1 - kMaxShare) * moved;
}

/// True: there are more.
bool keep_most_seen(StartedProblem& started) {
  const std::size_t count = started.estimate.objects.size();
  if (count <= kJudgedObjects) return false;
  std::vector<std::size_t> views(count);
  for (const Sighting& sighting : started.problem.sightings) ++views[sighting.object];
  std::vector<std::size_t> place(count);
  std::iota(place.begin(), place.end(), 0);
  std::vector<std::size_t> order = place;
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t o) { return views[o]; });
  for (std::size_t i = kJudgedObjects; i < count; ++i) place[order[i]] = kGone;
  renumber(started, place);
  return true;
}

}  // namespace

Causes find_causes(DriveLog log) {
  Causes found;
  const double boxes = static_cast<double>(log.moving) + 0.5 * static_cast<double>(log.ends);
  if (boxes > 0) found.moving = static_cast<double>(log.moving) / boxes;
  if (found.moving > kMaxMoving) return found;
  found.is_part = cut(log);
  std::variant<StartedProblem, std::string> start = start_problem(log);
  if (!std::holds_alternative<StartedProblem>(start)) return found;
  StartedProblem& started = std::get<StartedProblem>(start);
  found.sideways = moves_sideways(started.problem.odometry);
  if (found.sideways) return found;
  found.is_part = keep_most_seen(started) || found.is_part;
  // A fault may be larger than the priors for a user who calibrates.
  started.problem.camera_sigma[kHeight] = 0.03;      // m
  started.problem.wheel_sigma = {0.05, 0.15, 0.15};  // shares, rad/m
  Search::add_widths(log, started);
  found.causes = Search(log, std::move(started)).causes();
  found.several = found.causes.size() > 1;
  if (found.several) found.causes.clear();
  return found;
}

}  // namespace fencepost::host
