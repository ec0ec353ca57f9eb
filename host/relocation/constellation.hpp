// Finds how one map lies in another, by the objects of both alone. Pairs alike in colour and distance propose a motion,
// all other objects judge it. For a robot that was carried, for two runs, for two robots.
//
// A motion is accepted if that many objects would hardly meet by chance, and no other motion is nearly as good. The
// chance is a contrario: the expected number of motions as good among places drawn at random (Desolneux, Moisan and
// Morel). A square of equal posts is refused: it fits in four ways.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/geometry.hpp"

namespace fencepost::recon {

/// An object as a point. Metres, in the frame of its map.
struct ConstellationPoint {
  Vec2 place{0, 0};
  float sigma = 0;  ///< of each coordinate
  float radius = 0;
  std::uint8_t signature = 0;
};

/// p -> rotation p + shift, from the frame of the seen map to that of the known one.
struct FrameMotion {
  Vec2 rotation{1, 0};  ///< cosine and sine
  Vec2 shift{0, 0};

  [[nodiscard]] Vec2 of(const Vec2& place) const { return rotated(rotation, place) + shift; }
};

enum class JoinVerdict : std::uint8_t {
  kJoined,
  kTooFew,        ///< objects of a colour that both maps have: fewer than kFewestMatches
  kNoMatch,       ///< no motion lays kFewestMatches of them on each other
  kChance,        ///< one does, but strangers might, too
  kContradicted,  ///< one does, but most objects that it predicts are missing
  kAmbiguous,     ///< several do: equal things in an equal pattern
};

/// How well a motion lays the maps on each other.
struct JoinQuality {
  float chance = 1;           ///< that its matches but two meet by chance, for one motion tried
  float misfit = 0;           ///< m^2, sum of squares
  std::uint8_t matched = 0;   ///< objects
  std::uint8_t expected = 0;  ///< seen objects inside the known map; the rest is new
};

struct JoinResult {
  JoinVerdict verdict = JoinVerdict::kTooFew;
  FrameMotion motion;
  JoinQuality quality;
  float false_alarms = 1;  ///< expected number of motions as good between maps of different places
  float lead = 0;          ///< the rival's chance by the best one's
};

namespace constellation {

inline constexpr std::uint8_t kNone = 0xFF;

/// The known map and data derived from it once.
struct Known {
  std::span<const ConstellationPoint> points;
  Vec2 middle{0, 0};
  float reach = 0;  ///< m, from the middle to the farthest
};
Known make_known(std::span<const ConstellationPoint> points);

struct PairOf {
  std::size_t a = 0;
  std::size_t b = 0;
};

/// May the seen pair be the known one, in this order?
bool alike(const Known& known, PairOf k, std::span<const ConstellationPoint> seen, PairOf s);
/// The motion that lays the pairs' middles and directions on each other, then all that it matches, twice. `partners`
/// has for each seen object the known one, or kNone.
JoinQuality judge(const Known& known, PairOf k, std::span<const ConstellationPoint> seen, PairOf s, FrameMotion& motion,
                  std::span<std::uint8_t> partners);
/// Are most of the matches the same?
bool same(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);
/// Objects of the smaller map whose colour the other has, too.
std::size_t in_common(std::span<const ConstellationPoint> a, std::span<const ConstellationPoint> b);
/// Of two motions that match mostly the same: does `a` match more, or as much and more closely?
bool sharper(const JoinQuality& a, const JoinQuality& b);
/// Of any two: is `a` less likely to be chance?
bool better(const JoinQuality& a, const JoinQuality& b);

}  // namespace constellation

/// The search, a pair of seen objects a step. No heap: 44 bytes and 2 a point. Cost of a step, with n known and m seen
/// objects of one colour: n (n - 1) comparisons of distances. Each that fits costs some 6 n m comparisons of places.
template <std::size_t kPoints>
class ConstellationSearch {
  static_assert(kPoints < constellation::kNone);

 public:
  /// Both borrowed until the end; at most kPoints seen, those behind are not used.
  ConstellationSearch(std::span<const ConstellationPoint> known, std::span<const ConstellationPoint> seen)
      : known_(constellation::make_known(known)), seen_(seen.first(std::min(seen.size(), kPoints))) {}

  /// False: all pairs are done.
  bool step() {
    if (at_.a + 1 >= seen_.size()) return false;
    ++at_.b;
    if (at_.b >= seen_.size()) at_ = {at_.a + 1, at_.a + 2};
    if (at_.b >= seen_.size()) return false;
    for (std::size_t k = 0; k < known_.points.size(); ++k) {
      for (std::size_t l = 0; l < known_.points.size(); ++l) propose({k, l});
    }
    return true;
  }

  [[nodiscard]] JoinResult result() const;
  /// For each seen object the known one by the best motion, or constellation::kNone.
  [[nodiscard]] std::span<const std::uint8_t> partners() const { return std::span(best_.partners).first(seen_.size()); }

 private:
  struct Candidate {
    JoinQuality quality;
    FrameMotion motion;
    std::array<std::uint8_t, kPoints> partners{};
  };

  void propose(constellation::PairOf pair) {
    if (pair.a == pair.b || !alike(known_, pair, seen_, at_)) return;
    Candidate next;
    const auto places = std::span(next.partners).first(seen_.size());
    next.quality = judge(known_, pair, seen_, at_, next.motion, places);
    if (next.quality.matched < 2) return;
    if (best_.quality.matched > 0 && constellation::same(places, partners())) {
      if (constellation::sharper(next.quality, best_.quality)) best_ = next;
      return;
    }
    ++strangers_;
    if (constellation::better(next.quality, best_.quality)) {
      rival_ = best_;
      best_ = next;
    } else if (constellation::better(next.quality, rival_.quality)) {
      rival_ = next;
    }
  }

  constellation::Known known_;
  std::span<const ConstellationPoint> seen_;
  constellation::PairOf at_{0, 0};
  Candidate best_;
  Candidate rival_;
  std::uint32_t strangers_ = 0;  ///< motions tried that are not the best one
};

/// Judges a finished search.
JoinResult verdict_of(std::size_t in_common, const JoinQuality& best, const JoinQuality& rival, std::uint32_t motions,
                      const FrameMotion& motion);

template <std::size_t kPoints>
JoinResult ConstellationSearch<kPoints>::result() const {
  return verdict_of(constellation::in_common(known_.points, seen_), best_.quality, rival_.quality, strangers_ + 1,
                    best_.motion);
}

}  // namespace fencepost::recon
