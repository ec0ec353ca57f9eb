// Which view a full store gives up. Only the desk keeps sheaves: it looks at all pairs of views, eight at a time.
#include <cmath>
#include <cstring>
#include <optional>

#include "firmware/recon/models/sheaf.hpp"
#include "hal/base/check.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::recon {
namespace {

// GCC's and clang's, on any processor; never an argument, for how vectors are passed depends on the processor.
using Floats = float __attribute__((vector_size(kThinningLanes * sizeof(float))));
using Whole = std::int32_t __attribute__((vector_size(kThinningLanes * sizeof(float))));

constexpr float kNobody = 4.0F;  // the whole circle's diameter, squared

// Squares are not negative, and then their bits rise as they do.
std::int32_t bits_of(float square) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &square, sizeof bits);
  return bits;
}
float square_of(std::int32_t bits) {
  float square = 0;
  std::memcpy(&square, &bits, sizeof square);
  return square;
}

struct Bearings {
  const float* x;
  const float* y;
  std::size_t size;
};

// The chords from a bearing to its nearest neighbours on either side: how large a gap it would leave. Of two that are
// the same, the later one is to the left.
[[gnu::always_inline]] inline float gap_around(const Bearings& all, std::size_t i) {
  const auto own = static_cast<std::int32_t>(i);
  const Whole nobody = Whole{} + bits_of(kNobody);
  Whole left = nobody;
  Whole right = nobody;
  Whole index;
  for (std::size_t lane = 0; lane < kThinningLanes; ++lane) index[lane] = static_cast<std::int32_t>(lane);
  for (std::size_t j = 0; j < all.size; j += kThinningLanes) {
    Floats x;
    Floats y;
    std::memcpy(&x, all.x + j, sizeof x);
    std::memcpy(&y, all.y + j, sizeof y);
    const Floats dx = x - all.x[i];
    const Floats dy = y - all.y[i];
    const Floats side = all.x[i] * y - all.y[i] * x;
    const Floats squares = dx * dx + dy * dy;
    Whole away;
    std::memcpy(&away, &squares, sizeof away);
    away = index == own ? nobody : away;
    const Whole is_left = (side > 0.0F) | ((side == 0.0F) & (index > own));
    const Whole to_left = is_left ? away : nobody;
    const Whole to_right = is_left ? nobody : away;
    left = to_left < left ? to_left : left;
    right = to_right < right ? to_right : right;
    index += static_cast<std::int32_t>(kThinningLanes);
  }
  std::int32_t nearest_left = bits_of(kNobody);
  std::int32_t nearest_right = nearest_left;
  for (std::size_t lane = 0; lane < kThinningLanes; ++lane) {
    nearest_left = left[lane] < nearest_left ? left[lane] : nearest_left;
    nearest_right = right[lane] < nearest_right ? right[lane] : nearest_right;
  }
  return std::sqrt(square_of(nearest_left)) + std::sqrt(square_of(nearest_right));
}

}  // namespace

FENCEPOST_FOR_EACH_PROCESSOR
std::size_t view_to_give_up(std::span<const SheafView> views, const SheafView& newcomer, std::span<float> scratch) {
  FENCEPOST_CHECK(scratch.size() >= thinning_scratch(views.size()));
  const std::size_t room = thinning_scratch(views.size()) / 2;
  const Bearings all{scratch.data(), scratch.data() + room, room};
  for (std::size_t i = 0; i < room; ++i) {
    const Vec2 far{2 * kNobody, 2 * kNobody};  // nobody's neighbour
    const Vec2 bearing = i < views.size() ? views[i].bearing : i == views.size() ? newcomer.bearing : far;
    scratch[i] = bearing.x();
    scratch[room + i] = bearing.y();
  }
  std::optional<std::size_t> chosen_view;
  float smallest = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const float gap = gap_around(all, i) * static_cast<float>(views[i].true_ends());
    if (chosen_view && !(gap < smallest)) continue;
    chosen_view = i;
    smallest = gap;
  }
  return chosen_view.value_or(0);
}

}  // namespace fencepost::recon
