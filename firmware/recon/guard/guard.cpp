#include "firmware/recon/guard/guard.hpp"

#include <algorithm>

#include "firmware/recon/floor_frame.hpp"

namespace fencepost::recon::guard {
namespace {

constexpr std::int32_t kUnitsPerMillimetre = kMapUnitsPerMetre / 1000;
constexpr std::int32_t kRefutes = static_cast<std::int32_t>(kRefutedAfter.raw / kDoubtTicks) / 3 * 3;
constexpr std::int32_t kMaxElapsed = kRefutes / 3;
constexpr std::int32_t kOldest = 200;  // kSeenTicks: an older front counts as no older
constexpr auto kUnconfirmedAge = static_cast<std::int32_t>(kUnconfirmed.raw / kSeenTicks);
static_assert(kRefutes <= 0xFF && kFewestViews == 3);

using Place = FloorPlace;

// The lens in the store's frame.
struct Lens : FloorFrame {
  using FloorFrame::see;
  [[nodiscard]] Place see(const Front& front) const { return see(front.x, front.y); }
  void put(const Place& place, Front& front) const {
    constexpr std::int32_t kHalf = kSlopeOne / 2;
    const std::int32_t dx = (axis_x * place.depth - axis_y * place.left + kHalf) >> kSlopeBits;
    const std::int32_t dy = (axis_y * place.depth + axis_x * place.left + kHalf) >> kSlopeBits;
    front.x = static_cast<std::int16_t>(x + dx);
    front.y = static_cast<std::int16_t>(y + dy);
  }
};

Lens lens_of(const LensPose& pose, const MapPoint& origin) {
  Lens lens;
  lens.x = (pose.anchor.x - origin.x) / kUnitsPerMillimetre + nearest_whole(1000 * pose.lens.x(), 4000);
  lens.y = (pose.anchor.y - origin.y) / kUnitsPerMillimetre + nearest_whole(1000 * pose.lens.y(), 4000);
  lens.axis_x = nearest_whole(static_cast<float>(kSlopeOne) * pose.axis.x());
  lens.axis_y = nearest_whole(static_cast<float>(kSlopeOne) * pose.axis.y());
  return lens;
}

// A set of places across the view, kSpacing wide each; those beyond half of 32 to a side count as the outermost.
class Cells {
 public:
  void add(std::int32_t from, std::int32_t to) { bits_ |= cells(from, to); }
  void remove(std::int32_t from, std::int32_t to) { bits_ &= ~cells(from, to); }
  [[nodiscard]] bool empty() const { return bits_ == 0; }
  /// Takes one out; its middle.
  std::int32_t take() {
    const int cell = __builtin_ctz(bits_);
    bits_ &= bits_ - 1;
    return (cell - kHalf) * kSpacing + kSpacing / 2;
  }

 private:
  static constexpr std::int32_t kHalf = 16;
  static std::uint32_t index(std::int32_t left) {
    return static_cast<std::uint32_t>(std::clamp((left >> kSpacingLog2) + kHalf, std::int32_t{0}, 2 * kHalf - 1));
  }
  // None, if `to` is before `from`.
  static std::uint32_t cells(std::int32_t from, std::int32_t to) {
    const std::uint32_t up_to_last = ~std::uint32_t{0} >> (2 * kHalf - 1 - index(to));
    const std::uint32_t from_first = ~std::uint32_t{0} << index(from);
    return up_to_last & from_first;
  }
  std::uint32_t bits_ = 0;
};

// The foot of one blob: a line across the view at one depth, for a box gives no more.
struct FootLine {
  bool cut = false;    // by the image's lower border: nearer than that
  bool moves = false;  // by itself: it leaves no points where it was
  bool faint = false;  // hardly above that border, so the next frame may not show it
  std::uint8_t signature = 0;
  std::int32_t depth = 0;    // where the foot is, or leaves the image
  std::int32_t past = 0;     // points nearer than this are looked past
  std::int32_t nearest = 0;  // points from here to `farthest` are supported
  std::int32_t farthest = 0;
  std::int32_t left = 0;  // slopes of the ends, with the edges' slack
  std::int32_t right = 0;
  std::int32_t line_left = 0;  // mm: new points are put from here
  std::int32_t line_right = 0;
  Cells wanted;  // of the line, without a point

  // The depth at which new points are put.
  [[nodiscard]] std::int32_t line() const { return cut ? (depth * kUnseenFoot) >> 4 : depth; }

  // True if the place is in the blob's columns, or no more than `beside` mm from them.
  [[nodiscard]] bool covers(const Place& place, std::int32_t beside = 0) const {
    return place.left <= times(place.depth, left) + beside && place.left >= times(place.depth, right) - beside;
  }
  // It goes on below the image, and the place would be close beside it: were the place its own, it would be wider.
  [[nodiscard]] bool ends_before(const Place& place) const {
    return cut && !faint && place.depth > 0 && place.depth <= farthest && covers(place, kSpacing);
  }
  // True if it moves and may have been at the place before: the place may be free, visible or not.
  [[nodiscard]] bool left_behind(const Place& place) const {
    return moves && !cut && place.depth > 0 && place.depth < past && covers(place, kSpacing);
  }
  [[nodiscard]] bool supports(const Place& place) const {
    if (place.depth > farthest || place.depth < nearest || moves) return false;
    if (cut) return !faint && covers(place);
    return place.left <= line_left + kSideSlack && place.left >= line_right - kSideSlack;
  }
};

using FootLines = base::FixedVector<FootLine, sensor::kMaxBlobs>;

// A box has one lowest row for all its columns. In some of them it shows the side of the thing, or another thing behind
// it, whose foot is farther away. Where the map knows the thing at that row, its foot is no wider than the thing.
void keep_within(const KnownFeet& known, std::int32_t gate, std::int32_t left_slope, std::int32_t right_slope,
                 FootLine& foot) {
  std::int32_t left = INT32_MIN;
  std::int32_t right = INT32_MAX;
  for (const KnownFoot& thing : known) {
    if (thing.signature != foot.signature || foot.depth < thing.nearest - gate) continue;
    if (!foot.cut && foot.depth > thing.farthest + gate) continue;
    const std::int32_t most = times(left_slope > 0 ? thing.farthest : thing.nearest, left_slope);
    const std::int32_t least = times(right_slope < 0 ? thing.farthest : thing.nearest, right_slope);
    if (most < thing.right || least > thing.left) continue;
    left = std::max<std::int32_t>(left, thing.left);
    right = std::min<std::int32_t>(right, thing.right);
  }
  if (right > left) return;
  foot.line_left = std::min(foot.line_left, left);
  foot.line_right = std::max(foot.line_right, right);
}

FootLine foot_line(const CameraModel& camera, const WaitingBlob& blob, const KnownFeet& known) {
  const FloorCamera& floor = camera.floor;
  const Box& box = blob.box;
  const Sides sides = cut_by_border(camera, box);
  const auto [left, right] = floor.at(2 * box.x1 - 1, 2 * box.x2 + 1, 2 * box.y2 + 1);
  FootLine foot;
  foot.cut = sides.bottom;
  foot.moves = blob.moves;
  foot.faint = foot.cut && box.y2 - box.y1 + 1 < kClearPixels;
  foot.signature = blob.signature;
  foot.depth = std::min(left.depth, right.depth);
  // One pixel at depth 1: kEdgePixels either side.
  const std::int32_t slack = kEdgePixels * floor.width_of_column(kSlopeOne);
  foot.left = left.slope + slack;
  foot.right = right.slope - slack;
  const std::int32_t row = floor.depth_of_row(std::min(foot.depth, kForgotten));
  foot.past = foot.depth - (kPastSlack + ((kPastRows * row) >> 2));
  const std::int32_t support = kSupportSlack + ((kSupportRows * row) >> 2);
  foot.nearest = foot.cut ? 0 : foot.depth - support;
  foot.farthest = foot.depth + support;
  if (foot.depth > kFarthest || foot.moves) return foot;
  const std::int32_t beyond = foot.cut ? 0 : kBeyondSide;
  foot.line_left = times(foot.line(), left.slope) + (sides.left ? beyond : 0);
  foot.line_right = times(foot.line(), right.slope) - (sides.right ? beyond : 0);
  keep_within(known, support, left.slope, right.slope, foot);
  if (foot.line_right <= foot.line_left) foot.wanted.add(foot.line_right, foot.line_left);
  return foot;
}

enum class Verdict : std::uint8_t { kUnknown, kSupported, kUnsure, kRefuted };

// Decides how a frame affects a point.
class Judgement {
 public:
  Judgement(const FloorCamera& floor, FootLines& feet) : floor_(floor), feet_(feet) {}

  /// `remembered`: it was supported shortly before; `seen_from_here`: since the robot is stationary.
  Verdict of(Place& place, std::uint8_t& signature, bool remembered, bool seen_from_here) {
    for (FootLine& foot : feet_) {
      if (foot.cut && remembered) guess_nothing_beside(place, foot);
      if (foot.supports(place)) return support(foot, place, signature);
    }
    return of_unsupported(place, signature, seen_from_here);
  }

 private:
  [[nodiscard]] Verdict of_unsupported(const Place& place, std::uint8_t signature, bool seen_from_here) const {
    bool hidden = false;
    bool left_behind = false;
    bool ends_before = false;
    bool unsure = feet_.full();  // the camera may have dropped a blob beyond its maximum
    for (const FootLine& foot : feet_) {
      left_behind = left_behind || (foot.signature == signature && foot.left_behind(place));
      ends_before = ends_before || (foot.signature == signature && foot.ends_before(place));
      if (place.depth < foot.past && !foot.cut) continue;
      if (hidden || !foot.covers(place)) continue;
      (place.depth > foot.depth || foot.cut ? hidden : unsure) = true;
    }
    if (left_behind) return Verdict::kRefuted;
    if (hidden) return Verdict::kUnknown;
    if (!seen_from_here && !(ends_before && inside_columns(place)) && !must_be_visible(place)) return Verdict::kUnknown;
    return unsure ? Verdict::kUnsure : Verdict::kRefuted;
  }

  // For a blob whose foot is below the image, no foot is guessed where one was seen before.
  static void guess_nothing_beside(const Place& place, FootLine& foot) {
    if (place.depth <= 0 || place.depth > foot.farthest + (foot.depth >> kCutReachLog2) ||
        !foot.covers(place, kSpacing))
      return;
    const std::int32_t left = place.left * foot.line() / place.depth;  // in the same columns, at the line's depth
    foot.wanted.remove(left - kSpacing, left + kSpacing);
  }

  static Verdict support(FootLine& foot, Place& place, std::uint8_t& signature) {
    signature = foot.signature;
    if (foot.cut) return Verdict::kSupported;
    constexpr std::int32_t kReach = 6;
    foot.wanted.remove(place.left - kReach, place.left + kReach);
    const std::int32_t step = foot.depth - place.depth;
    if (step >= kMinStep || step <= -kMinStep) place.depth += step / 2;
    return Verdict::kSupported;
  }

  [[nodiscard]] bool must_be_visible(const Place& place) const {
    return place.depth >= floor_.nearest_visible() && inside_columns(place);
  }
  [[nodiscard]] bool inside_columns(const Place& place) const {
    return place.left <= times(place.depth, floor_.leftmost_visible()) &&
           place.left >= times(place.depth, floor_.rightmost_visible());
  }

  const FloorCamera& floor_;
  FootLines& feet_;
};

// Eviction score: larger for points that are far, behind the robot, or unconfirmed.
std::int32_t uselessness(const Place& place, bool confirmed) {
  const std::int32_t aside = place.left < 0 ? -place.left : place.left;
  const std::int32_t along = place.depth < 0 ? -2 * place.depth : place.depth;
  return std::max(along, 2 * aside) + (confirmed ? 0 : kFarthest / 4);
}

}  // namespace

void GuardCore::pass_time(std::span<Front> fronts, base::Time t) {
  const base::Duration since = has_looked_ ? looked_at_.since(t) : base::Duration{0};
  const bool long_ago = since.raw > kOldest * kSeenTicks;
  elapsed_ = static_cast<std::uint8_t>(since.raw >= kMaxElapsed * kDoubtTicks ? kMaxElapsed : since.raw / kDoubtTicks);
  has_looked_ = true;
  looked_at_ = base::Stamp(t);
  now_ = static_cast<std::uint8_t>(static_cast<std::uint64_t>(t.raw) / kSeenTicks);
  ++turn_;
  for (Front& front : fronts) {
    const auto age = static_cast<std::uint8_t>(now_ - front.seen);
    if (long_ago || age > kOldest) front.seen = static_cast<std::uint8_t>(now_ - kOldest);
  }
}

// The origin stays near the robot, by whole millimetres.
void GuardCore::follow(std::span<Front> fronts, const MapPoint& robot) {
  constexpr std::int32_t kReach = 8000;  // mm
  const std::int32_t x = (robot.x - origin_.x) / kUnitsPerMillimetre;
  const std::int32_t y = (robot.y - origin_.y) / kUnitsPerMillimetre;
  if (x <= kReach && x >= -kReach && y <= kReach && y >= -kReach) return;
  origin_.x += x * kUnitsPerMillimetre;
  origin_.y += y * kUnitsPerMillimetre;
  constexpr std::int32_t kEdge = 32'000;
  for (Front& front : fronts) {
    front.x = static_cast<std::int16_t>(std::clamp(front.x - x, -kEdge, kEdge));
    front.y = static_cast<std::int16_t>(std::clamp(front.y - y, -kEdge, kEdge));
  }
}

std::size_t GuardCore::look(std::span<Front> store, const WaitingFrame& frame, const CameraModel& camera,
                            const LensPose& pose, base::Time stands_since, const KnownFeet& known) {
  if (!camera.floor.usable()) return size_;
  const base::Time t = frame.t - camera.latency;
  pass_time(store.first(size_), t);
  follow(store.first(size_), pose.anchor);
  const Lens lens = lens_of(pose, origin_);
  FootLines feet;
  for (const WaitingBlob& blob : frame.blobs) {
    if (!blob.bearing) static_cast<void>(feet.push_back(foot_line(camera, blob, known)));
  }

  const auto bit = static_cast<std::uint8_t>(1U << (turn_ % kRememberedFrames));
  // In whole counts: a point supported in the count of the stop may have been seen while the robot still moved.
  const std::int64_t stood = std::min<std::int64_t>(t.raw / kSeenTicks - stands_since.raw / kSeenTicks, kOldest);
  const bool counts_unsure = turn_ % kUnsureFrames == 0;
  Judgement judgement(camera.floor, feet);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    Front front = store[i];
    Place place = lens.see(front);
    if (std::max(std::max(place.depth, -place.depth), std::max(place.left, -place.left)) > kForgotten) continue;
    const auto age = static_cast<std::uint8_t>(now_ - front.seen);
    const std::int32_t depth = place.depth;
    switch (judgement.of(place, front.signature, age <= kUnconfirmedAge, age < stood)) {
      case Verdict::kSupported:
        front.frames |= bit;
        front.seen = now_;
        front.doubt = static_cast<std::uint8_t>(std::max(0, front.doubt - 2 * elapsed_));
        if (place.depth != depth) lens.put(place, front);
        break;
      case Verdict::kUnsure:
        if (counts_unsure) front.doubt = static_cast<std::uint8_t>(std::min(0xFF, front.doubt + elapsed_));
        break;
      case Verdict::kRefuted: front.doubt = static_cast<std::uint8_t>(std::min(0xFF, front.doubt + elapsed_)); break;
      case Verdict::kUnknown: break;
    }
    if (front.doubt >= kRefutes || (age > kUnconfirmedAge && !enough_frames(front.frames))) continue;
    store[kept++] = front;
  }

  int replaced = 0;
  for (FootLine& foot : feet) {
    while (!foot.wanted.empty()) {
      const std::int32_t left = std::clamp(foot.wanted.take(), foot.line_right, foot.line_left);
      const Place place{foot.line(), left};
      Front front;
      lens.put(place, front);
      front.frames = bit;
      front.seen = now_;
      front.signature = foot.signature;
      if (kept < store.size()) {
        store[kept++] = front;
        continue;
      }
      if (replaced == kMaxReplaced) break;
      std::size_t worst = kept;
      std::int32_t most = uselessness(place, false);
      for (std::size_t i = 0; i < kept; ++i) {
        const std::int32_t useless = uselessness(lens.see(store[i]), enough_frames(store[i].frames));
        if (useless <= most) continue;
        most = useless;
        worst = i;
      }
      if (worst == kept) continue;
      store[worst] = front;
      ++replaced;
    }
  }
  return kept;
}

void GuardCore::hash_part(base::Fnv1a64& hash, std::span<const Front> fronts, std::uint32_t turn) const {
  constexpr std::size_t kPart = 4;
  hash.u8(size_);
  hash.i32(origin_.x);
  hash.i32(origin_.y);
  if (fronts.empty()) return;
  const std::size_t parts = (fronts.size() + kPart - 1) / kPart;
  const std::size_t first = turn % parts * kPart;
  for (const Front& front : fronts.subspan(first, std::min(kPart, fronts.size() - first))) {
    hash.u16(static_cast<std::uint16_t>(front.x));
    hash.u16(static_cast<std::uint16_t>(front.y));
    hash.u8(front.frames);
    hash.u8(front.doubt);
    hash.u8(front.seen);
    hash.u8(front.signature);
  }
}

}  // namespace fencepost::recon::guard
