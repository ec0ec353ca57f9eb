// Which view a full store gives up. Only the desk keeps sheaves: it looks at all pairs of views, four at a time.
#include <cmath>
#include <cstring>
#include <optional>

#include "firmware/recon/models/sheaf.hpp"
#include "hal/base/check.hpp"

namespace fencepost::recon {
namespace {

// GCC's and clang's, on any processor.
using Floats = float __attribute__((vector_size(16)));
using Whole = std::int32_t __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;

constexpr float kNobody = 4.0F;  // the whole circle's diameter, squared

// Squares are not negative, and then their bits rise as they do.
Whole bits_of(Floats values) {
  Whole bits;
  std::memcpy(&bits, &values, sizeof bits);
  return bits;
}
Whole chosen(Whole mask, Whole a, Whole b) { return (a & mask) | (b & ~mask); }
Whole smaller(Whole a, Whole b) { return chosen(a < b, a, b); }

float smallest_of(Whole bits) {
  float least = kNobody;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    float value = 0;
    const std::int32_t one = bits[lane];
    std::memcpy(&value, &one, sizeof value);
    least = value < least ? value : least;
  }
  return least;
}

struct Bearings {
  const float* x;
  const float* y;
  std::size_t size;
};

// The chords from a bearing to its nearest neighbours on either side: how large a gap it would leave. Of two that are
// the same, the later one is to the left.
float gap_around(const Bearings& all, std::size_t i) {
  const Floats nobody{kNobody, kNobody, kNobody, kNobody};
  const auto own = static_cast<std::int32_t>(i);
  Whole left = bits_of(nobody);
  Whole right = left;
  Whole index{0, 1, 2, 3};
  for (std::size_t j = 0; j < all.size; j += kLanes) {
    Floats x;
    Floats y;
    std::memcpy(&x, all.x + j, sizeof x);
    std::memcpy(&y, all.y + j, sizeof y);
    const Floats dx = x - all.x[i];
    const Floats dy = y - all.y[i];
    const Floats side = all.x[i] * y - all.y[i] * x;
    const Whole away = chosen(index == own, bits_of(nobody), bits_of(dx * dx + dy * dy));
    const Whole is_left = (side > 0.0F) | ((side == 0.0F) & (index > own));
    left = smaller(chosen(is_left, away, left), left);
    right = smaller(chosen(is_left, right, away), right);
    index += static_cast<std::int32_t>(kLanes);
  }
  return std::sqrt(smallest_of(left)) + std::sqrt(smallest_of(right));
}

}  // namespace

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
