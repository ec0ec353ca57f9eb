// Alg. 2, the plane sheaf (paper sec. II.C). Left edge rays of two views meet in the left post, right ones in the right
// post. A vertical plane joins the two, and the footprint is the convex hull of all posts.
//
// An object keeps a bounded store of views (SheafViews). The sheaf is computed from it on request (PlaneSheaf), so an
// early, ill-conditioned post is gone as soon as its view has a better partner. Two rules:
//   sheaf_paper: every pair of views whose rays cross at 5 degrees or more. The paper pairs consecutive images. From a
//     camera of 50 frames a second these cross at a fraction of a degree. Pairing all loses less of the object.
//   sheaf: one partner a view, about 15 degrees away, and posts far from the others are dropped. Wide pairs cross far
//     outside the object: without noise, from 75 views, all pairs leave 99 % of the hull empty and this rule 29 %.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/clip.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

inline constexpr float kPaperLeastSine = 0.0871557F;  ///< 5 deg: nearer to parallel, rays of sheaf_paper do not meet
inline constexpr float kSheafLeastSine = 0.0087265F;  ///< 0.5 deg: the same for the edge rays of sheaf
inline constexpr float kParallaxLeast = 0.0174531F;   ///< chord of 1 deg between the bearings of partners
inline constexpr float kParallaxWanted = 0.2610524F;  ///< chord of 15 deg
inline constexpr float kParallaxMost = 1.0F;          ///< chord of 60 deg
inline constexpr float kPostNearest = 0.02F;          ///< m along both rays: nearer ones are behind or in a lens
inline constexpr float kPostFarthest = 4.0F;          ///< m from the local origin, as far as the tables' scenes reach
inline constexpr float kTrimRadii = 2.5F;             ///< posts farther than this many median radii are dropped,
inline constexpr std::size_t kTrimPosts = 6;          ///< minimum number of posts for it
inline constexpr float kHullTolerance = kShallowestCut;  ///< m: a post outside by less does not change the hull

/// One view as the sheaf keeps it: 32 bytes. Local frame of the object, metres.
struct SheafView {
  Vec2 lens{0, 0};
  Vec2 bearing{1, 0};  ///< unit, of the interval's centre
  Vec2 left{0, 0};     ///< unit, of the left edge; zero if that end is censored: it never triangulates
  Vec2 right{0, 0};

  [[nodiscard]] int true_ends() const { return (left == Vec2{} ? 0 : 1) + (right == Vec2{} ? 0 : 1); }
};

SheafView sheaf_view(const Sighting& sighting, MapPoint origin);

/// True if `view` is less than 1 deg of bearing from `other`: no rule would pair the two.
bool repeats(const SheafView& view, const SheafView& other);

/// Float lanes: thinning columns have whole multiples of this many floats.
inline constexpr std::size_t kThinningLanes = 8;
/// Columns of ThinningColumns: bearings, true ends, and squared chords to the nearest bearings on either side.
inline constexpr std::size_t kThinningColumns = 5;
constexpr std::size_t thinning_room(std::size_t views) {
  return (views + kThinningLanes) / kThinningLanes * kThinningLanes;
}
/// A full store's views, kept from one newcomer to the next: a newcomer costs one look at each view, not one at each
/// pair. The newest view is not in it, for it may be replaced. 20 bytes a view, desk only.
struct ThinningColumns {
  std::span<float> values;  ///< kThinningColumns * thinning_room() floats; they need no first value
  std::size_t& known;       ///< number of views in it, the oldest ones; 0: none yet
};

/// The index of the full store's view that goes when `newcomer` comes: its loss leaves the smallest gap of bearings
/// between its two neighbours. A gap counts half for a view with one true end. Ties: the oldest. `columns` forgets that
/// view, so the store has to, too. Cost: n, about 5 ns each on a desk, and n^2 for the first newcomer.
std::size_t view_to_give_up(std::span<const SheafView> views, const SheafView& newcomer, ThinningColumns columns);

/// The views of one object, oldest first. Not full, it holds every view that is 1 deg or more from the one before; a
/// nearer view takes the newest one's place. Full, it thins out evenly over all bearings from which the object was
/// seen. Where the robot comes by again the new views replace the old ones. Measured over whole tours, the newest view
/// has a partner within 3.2 deg of 15 deg for N = 75, within 7.0 deg for N = 36.
template <std::size_t N>
class SheafViews {
  static_assert(N >= 8);

 public:
  static constexpr std::string_view kName = "sheaf";
  static constexpr std::size_t kViews = N;

  void start(const Sighting& /*first*/, MapPoint /*origin*/) {
    views_.clear();
    known_ = 0;
  }
  void add(const ModelView& view) { add(view.sighting, view.origin); }
  void shift(const Vec2& /*step*/) {}

  void move_origin(const Vec2& shift) {
    for (SheafView& view : views_) view.lens -= shift;
  }
  /// A view without a true end is not kept.
  void add(const Sighting& sighting, MapPoint origin) {
    const SheafView view = sheaf_view(sighting, origin);
    if (view.true_ends() == 0) return;
    if (views_.size() >= 2 && repeats(view, views_[views_.size() - 2U])) {
      SheafView& newest = views_[views_.size() - 1U];
      if (view.true_ends() >= newest.true_ends()) newest = view;
      return;
    }
    if (views_.full()) make_room_for(view);
    static_cast<void>(views_.push_back(view));
  }
  [[nodiscard]] std::span<const SheafView> view() const { return views_.view(); }

 private:
  [[gnu::noinline]] void make_room_for(const SheafView& view) {
    views_.erase_at(view_to_give_up(views_.view(), view, {columns_, known_}));
  }

  base::FixedVector<SheafView, N> views_;
  std::array<float, kThinningColumns * thinning_room(N)> columns_{};
  std::size_t known_ = 0;
};

/// The plane of two views: a post where the left edges meet, one where the right edges meet, a vertical plane between.
struct SheafPlane {
  Vec2 left{0, 0};  ///< local frame, m
  Vec2 right{0, 0};
  bool has_left = false;
  bool has_right = false;

  [[nodiscard]] bool whole() const { return has_left && has_right; }
  [[nodiscard]] bool any() const { return has_left || has_right; }
};

/// No post where an end is censored, where the rays cross at less than `least_sine`, in or behind a lens, or farther
/// than kPostFarthest.
SheafPlane sheaf_plane(const SheafView& a, const SheafView& b, float least_sine);

/// The later view nearest to 15 deg from views[i], within 1..60 deg, that has a true end in common. An earlier one if
/// it is nearer by a degree (the last views have no good later one). views.size() if there is none.
std::size_t sheaf_partner(std::span<const SheafView> views, std::size_t i);

/// Adds a point to the convex counter-clockwise hull in vertices[0..size) and returns the new size. The last place of
/// the span is working room. A hull that would need it drops the vertex whose loss moves the outline least. So a full
/// hull is never larger than the true one. Fewer than three vertices: all points so far lie on one line.
std::size_t grow_hull(std::span<Vec2> vertices, std::size_t size, const Vec2& point);

/// Drops posts farther than kTrimRadii median radii from the posts' median. The median is taken along and across
/// `axis` (unit), so that the result turns with the scene. scratch: a float for each post.
void trim_posts(std::span<SheafPlane> planes, const Vec2& axis, std::span<float> scratch);

/// Every plane of sheaf_paper, by pair of views (i, j), i < j.
template <class Visit>
void for_each_paper_plane(std::span<const SheafView> views, Visit visit) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const SheafPlane plane = sheaf_plane(views[i], views[j], kPaperLeastSine);
      if (plane.any()) visit(plane);
    }
  }
}

enum class SheafRefusal : std::uint8_t { kNone, kNoEdges, kNoCrossing, kFewPosts, kOneLine };
std::string_view name(SheafRefusal refusal);

/// The sheaf of a store of `Views` views, its hull of at most `Posts` vertices. No part of an object: whoever wants to
/// look owns one.
template <std::size_t Views, std::size_t Posts>
class PlaneSheaf {
  static_assert(Views >= 2 && Posts >= 8);

 public:
  /// Builds by the rule of `sheaf`. The hull has at most 2 * Views posts: Posts >= 2 * Views never loses one.
  void build(std::span<const SheafView> views) {
    clear();
    for (std::size_t i = 0; i < views.size(); ++i) {
      const std::size_t partner = sheaf_partner(views, i);
      if (partner == views.size()) continue;
      if (partner < i && sheaf_partner(views, partner) == i) continue;  // this pair is in already
      const SheafPlane plane = sheaf_plane(views[i], views[partner], kSheafLeastSine);
      if (plane.any()) static_cast<void>(planes_.push_back(plane));
    }
    if (!views.empty()) trim_posts({planes_.begin(), planes_.size()}, views.back().bearing, scratch_);
    for (const SheafPlane& plane : planes_) add_posts(plane);
    finish(views);
  }

  /// Builds by the rule of `sheaf_paper`. When the store has thinned out, the widest pairs may be gone: the hull is
  /// then smaller, never larger, than that of all views. Its planes are not kept: for_each_paper_plane.
  void build_paper(std::span<const SheafView> views) {
    clear();
    for_each_paper_plane(views, [this](const SheafPlane& plane) { add_posts(plane); });
    finish(views);
  }

  /// Counter-clockwise, local frame, m. Empty: refusal() says why.
  [[nodiscard]] std::span<const Vec2> hull() const {
    return {hull_.data(), refusal_ == SheafRefusal::kNone ? size_ : 0};
  }
  /// Planes of build() only; posts that were trimmed are missing.
  [[nodiscard]] std::span<const SheafPlane> planes() const { return planes_.view(); }
  [[nodiscard]] SheafRefusal refusal() const { return refusal_; }
  [[nodiscard]] std::uint32_t posts() const { return posts_; }

 private:
  void clear() {
    planes_.clear();
    size_ = 0;
    posts_ = 0;
    refusal_ = SheafRefusal::kNoEdges;
  }
  void add_posts(const SheafPlane& plane) {
    if (plane.has_left) add_post(plane.left);
    if (plane.has_right) add_post(plane.right);
  }
  void add_post(const Vec2& post) {
    size_ = grow_hull(hull_, size_, post);
    ++posts_;
  }
  void finish(std::span<const SheafView> views) {
    if (views.empty()) return;
    if (posts_ == 0) {
      refusal_ = SheafRefusal::kNoCrossing;
    } else if (posts_ < 3) {
      refusal_ = SheafRefusal::kFewPosts;
    } else {
      refusal_ = size_ < 3 ? SheafRefusal::kOneLine : SheafRefusal::kNone;
    }
  }

  base::FixedVector<SheafPlane, Views> planes_;
  std::array<float, 2 * Views> scratch_{};
  std::array<Vec2, Posts + 1> hull_;
  std::size_t size_ = 0;
  std::uint32_t posts_ = 0;
  SheafRefusal refusal_ = SheafRefusal::kNoEdges;
};

}  // namespace fencepost::recon
