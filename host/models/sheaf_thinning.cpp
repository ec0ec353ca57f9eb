// Which view a full store gives up. Only the desk keeps sheaves: it looks at eight views at a time.
#include <cmath>
#include <cstring>
#include <limits>

#include "hal/base/check.hpp"
#include "hal/base/vectors.hpp"
#include "host/models/sheaf.hpp"

namespace fencepost::recon {
namespace {

// GCC's and clang's, on any processor; never an argument, for how vectors are passed depends on the processor.
using Floats = float __attribute__((vector_size(kThinningLanes * sizeof(float))));
using Whole = std::int32_t __attribute__((vector_size(kThinningLanes * sizeof(float))));

constexpr float kNobody = 4.0F;  // the whole circle's diameter, squared
constexpr float kFar = 8.0F;     // both coordinates of a place without a view: nobody's neighbour

struct Columns {
  float* x;
  float* y;
  float* ends;
  float* left;  // squared chord to the nearest bearing on that side, or kNobody
  float* right;
  std::size_t room;
};

Columns columns_in(std::span<float> values, std::size_t views) {
  const std::size_t room = thinning_room(views);
  FENCEPOST_CHECK(values.size() >= kThinningColumns * room);
  const auto column = [&](std::size_t i) { return values.data() + i * room; };
  return {column(0), column(1), column(2), column(3), column(4), room};
}

[[gnu::always_inline]] inline void load(Floats& to, const float* from) { std::memcpy(&to, from, sizeof to); }
[[gnu::always_inline]] inline void save(float* to, const Floats& from) { std::memcpy(to, &from, sizeof from); }
[[gnu::always_inline]] inline void lower(Floats& least, const Floats& other) { least = other < least ? other : least; }
[[gnu::always_inline]] inline float least_of(const Floats& lanes) {
  float least = lanes[0];
  for (std::size_t lane = 1; lane < kThinningLanes; ++lane) least = lanes[lane] < least ? lanes[lane] : least;
  return least;
}

// From views j to j + 7 to one with this bearing: squared chords, and on which side. `side` of one seen from the other
// is the same with another sign, to the last bit.
struct Apart {
  Floats squares{};
  Floats side{};
};
[[gnu::always_inline]] inline void look(const Columns& all, std::size_t j, float x, float y, Apart& apart) {
  Floats from_x;
  Floats from_y;
  load(from_x, all.x + j);
  load(from_y, all.y + j);
  const Floats dx = x - from_x;
  const Floats dy = y - from_y;
  apart.side = from_x * y - from_y * x;
  apart.squares = dx * dx + dy * dy;
}

struct Nearest {
  Floats left{};
  Floats right{};
};
[[gnu::always_inline]] inline void put(Nearest& nearest, const Whole& is_left, const Floats& squares) {
  const Floats nobody = Floats{} + kNobody;
  lower(nearest.left, is_left ? squares : nobody);
  lower(nearest.right, is_left ? nobody : squares);
}

// A later view, seen from those at j: of two with the same bearing the later one is to the left. `own`: what the later
// one sees of them.
[[gnu::always_inline]] inline void meet_later(const Columns& all, std::size_t j, float x, float y, Nearest& theirs,
                                              Nearest& own) {
  Apart apart;
  look(all, j, x, y, apart);
  const Whole is_left = apart.side >= 0.0F;
  put(theirs, is_left, apart.squares);
  put(own, ~is_left, apart.squares);
}

[[gnu::always_inline]] inline void clear(Nearest& nearest) { nearest.left = nearest.right = Floats{} + kNobody; }
[[gnu::always_inline]] inline void load(Nearest& nearest, const Columns& all, std::size_t j) {
  load(nearest.left, all.left + j);
  load(nearest.right, all.right + j);
}

// One view more is known, the latest one.
[[gnu::always_inline]] inline void append(const Columns& all, std::size_t& known, const SheafView& view) {
  const float x = view.bearing.x();
  const float y = view.bearing.y();
  Nearest own;
  clear(own);
  for (std::size_t j = 0; j < known; j += kThinningLanes) {
    Nearest theirs;
    load(theirs, all, j);
    meet_later(all, j, x, y, theirs, own);
    save(all.left + j, theirs.left);
    save(all.right + j, theirs.right);
  }
  all.x[known] = x;
  all.y[known] = y;
  all.ends[known] = static_cast<float>(view.true_ends());
  all.left[known] = least_of(own.left);
  all.right[known] = least_of(own.right);
  ++known;
}

[[gnu::always_inline]] inline void count_lanes(Whole& index) {
  for (std::size_t lane = 0; lane < kThinningLanes; ++lane) index[lane] = static_cast<std::int32_t>(lane);
}

// A known view's neighbours among all known ones.
[[gnu::always_inline]] inline void look_around(const Columns& all, std::size_t known, std::size_t i) {
  const auto own = static_cast<std::int32_t>(i);
  Whole index;
  count_lanes(index);
  Nearest nearest;
  clear(nearest);
  for (std::size_t j = 0; j < known; j += kThinningLanes) {
    Apart apart;
    look(all, j, all.x[i], all.y[i], apart);
    const Floats squares = index == own ? Floats{} + kNobody : apart.squares;
    put(nearest, (apart.side < 0.0F) | ((apart.side == 0.0F) & (index > own)), squares);
    index += static_cast<std::int32_t>(kThinningLanes);
  }
  all.left[i] = least_of(nearest.left);
  all.right[i] = least_of(nearest.right);
}

[[gnu::always_inline]] inline bool any(const Whole& lanes) {
  std::array<std::uint64_t, sizeof lanes / 8> parts;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::memcpy(parts.data(), &lanes, sizeof lanes);
  std::uint64_t all = 0;
  for (const std::uint64_t part : parts) all |= part;
  return all != 0;
}

// One view less. Those whose neighbour it may have been look around again.
[[gnu::always_inline]] inline void take_out(const Columns& all, std::size_t& known, std::size_t gone) {
  const float x = all.x[gone];
  const float y = all.y[gone];
  for (float* column : {all.x, all.y, all.ends, all.left, all.right}) {
    std::memmove(column + gone, column + gone + 1, (known - gone - 1) * sizeof(float));
  }
  --known;
  all.x[known] = all.y[known] = kFar;
  for (std::size_t j = 0; j < known; j += kThinningLanes) {
    Apart apart;
    look(all, j, x, y, apart);
    Nearest nearest;
    load(nearest, all, j);
    const Whole was_nearest = (apart.squares == nearest.left) | (apart.squares == nearest.right);
    if (!any(was_nearest)) continue;
    for (std::size_t lane = 0; lane < kThinningLanes && j + lane < known; ++lane) {
      if (was_nearest[lane] != 0) look_around(all, known, j + lane);
    }
  }
}

struct Choice {
  std::size_t view;
  float gap;
};

// In each lane the oldest of the views with the smallest gap.
struct Choices {
  Whole view = Whole{} - 1;
  Floats gap = Floats{} + std::numeric_limits<float>::max();
};
[[gnu::always_inline]] inline Choice oldest_of(const Choices& all) {
  Choice choice{static_cast<std::size_t>(all.view[0]), all.gap[0]};
  for (std::size_t lane = 1; lane < kThinningLanes; ++lane) {
    const auto view = static_cast<std::size_t>(all.view[lane]);
    if (all.gap[lane] > choice.gap || (all.gap[lane] == choice.gap && view > choice.view)) continue;
    choice = {view, all.gap[lane]};
  }
  return choice;
}

// Chooses among the known views, when two more come after them: the oldest of those with the smallest gap. `last`: the
// first one of the two, which may go as well.
[[gnu::always_inline]] inline Choice choose(const Columns& all, std::size_t known, const SheafView& last,
                                            const SheafView& newcomer) {
  Nearest of_last;
  Nearest of_newcomer;  // it stays: nobody asks
  clear(of_last);
  clear(of_newcomer);
  Choices choices;
  const auto count = static_cast<std::int32_t>(known);
  Whole index;
  count_lanes(index);
  for (std::size_t j = 0; j < known; j += kThinningLanes) {
    Nearest theirs;
    load(theirs, all, j);
    meet_later(all, j, last.bearing.x(), last.bearing.y(), theirs, of_last);
    meet_later(all, j, newcomer.bearing.x(), newcomer.bearing.y(), theirs, of_newcomer);
    Floats ends;
    load(ends, all.ends + j);
    Floats gaps;
    for (std::size_t lane = 0; lane < kThinningLanes; ++lane) {
      gaps[lane] = std::sqrt(theirs.left[lane]) + std::sqrt(theirs.right[lane]);
    }
    gaps *= ends;
    const Whole better = (gaps < choices.gap) & (index < count);
    choices.view = better ? index : choices.view;
    choices.gap = better ? gaps : choices.gap;
    index += static_cast<std::int32_t>(kThinningLanes);
  }
  Choice choice = oldest_of(choices);
  float left = least_of(of_last.left);
  float right = least_of(of_last.right);
  const Vec2 apart = newcomer.bearing - last.bearing;
  float& of_side = cross(last.bearing, newcomer.bearing) >= 0 ? left : right;
  const float square = apart.squared_norm();
  of_side = square < of_side ? square : of_side;
  const float gap = (std::sqrt(left) + std::sqrt(right)) * static_cast<float>(last.true_ends());
  if (known == 0 || gap < choice.gap) choice = {known, gap};
  return choice;
}

}  // namespace

FENCEPOST_FOR_EACH_PROCESSOR
std::size_t view_to_give_up(std::span<const SheafView> views, const SheafView& newcomer, ThinningColumns columns) {
  const Columns all = columns_in(columns.values, views.size());
  std::size_t known = columns.known;
  if (known == 0) {
    for (std::size_t i = 0; i < all.room; ++i) all.x[i] = all.y[i] = kFar;
    for (std::size_t i = 0; i < all.room; ++i) all.ends[i] = all.left[i] = all.right[i] = kNobody;
  }
  while (known + 1 < views.size()) append(all, known, views[known]);
  const Choice choice = choose(all, known, views[known], newcomer);
  if (choice.view < known) take_out(all, known, choice.view);
  columns.known = known;
  return choice.view;
}

}  // namespace fencepost::recon
