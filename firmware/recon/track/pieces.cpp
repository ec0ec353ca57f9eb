#include "firmware/recon/track/pieces.hpp"

#include <algorithm>
#include <cstdlib>

#include "firmware/recon/observe/occlusion.hpp"

namespace fencepost::recon {
namespace {

bool near(int p, int q) { return p - q <= kTouchPixels && q - p <= kTouchPixels; }

// True if `post` fills the columns between `left` and `right`, in front of both.
bool fills_gap(const Box& post, const Box& left, const Box& right) {
  return post.x1 <= left.x2 + kTouchPixels && post.x2 >= right.x1 - kTouchPixels && post.x1 >= left.x1 &&
         post.x2 <= right.x2 && post.y1 <= left.y1 + kTouchPixels && post.y2 >= left.y2 - kTouchPixels;
}

bool any_post_between(std::span<const Observation> blobs, const Observation& left, const Observation& right) {
  for (const Observation& post : blobs) {
    if (!post.bearing && &post != &left && &post != &right && fills_gap(post.box, left.box, right.box)) return true;
  }
  return false;
}

// One object is predicted at one of the blobs only, and another one at the other.
bool known_apart(const Observation& left, const Observation& right, std::span<const Prediction> predictions) {
  int only_left = 0, only_right = 0, both = 0;
  for (const Prediction& prediction : predictions) {
    if (prediction.signature != left.signature || !(prediction.depth > 0)) continue;
    const bool on_left = overlaps(prediction, left);
    const bool on_right = overlaps(prediction, right);
    only_left += on_left && !on_right ? 1 : 0;
    only_right += on_right && !on_left ? 1 : 0;
    both += on_left && on_right ? 1 : 0;
  }
  return only_left + only_right > 0 && (only_left > 0) + (only_right > 0) + both >= 2;
}

// The object was expected to reach over the middles of both.
bool explains_both(const Prediction& prediction, const Observation& left, const Observation& right) {
  Observation whole;
  whole.left = left.left;
  whole.left_column = left.left_column;
  whole.right = right.right;
  whole.right_column = right.right_column;
  if (whole.no_edge()) return false;
  return match_cost(prediction, whole) != kImpossible && has_middle_of(prediction, left) &&
         has_middle_of(prediction, right);
}

bool rows_match(const Observation& left, const Observation& right) {
  if (!near(left.box.y1, right.box.y1)) return false;
  return !is_edge(left.bottom) || !is_edge(right.bottom) || near(left.box.y2, right.box.y2);
}

// The object that should be one blob here.
std::uint8_t whole_of(const Observation& left, const Observation& right, std::span<const Prediction> predictions) {
  for (std::size_t o = 0; o < predictions.size(); ++o) {
    const Prediction& prediction = predictions[o];
    if (prediction.signature != left.signature || !(prediction.depth > 0)) continue;
    if (explains_both(prediction, left, right)) return static_cast<std::uint8_t>(o);
  }
  return kNoMatch;
}

bool cut_by_post(std::span<const Observation> blobs, const Observation& left, const Observation& right) {
  return near(left.box.y1, right.box.y1) && near(left.box.y2, right.box.y2) && any_post_between(blobs, left, right);
}

}  // namespace

PiecePair find_pieces(std::span<const Observation> blobs, std::span<const Prediction> predictions) {
  for (std::size_t a = 0; a < blobs.size(); ++a) {
    if (blobs[a].bearing) continue;
    for (std::size_t b = 0; b < blobs.size(); ++b) {
      if (blobs[b].bearing) continue;
      if (a == b || blobs[a].signature != blobs[b].signature || blobs[a].box.x2 >= blobs[b].box.x1) continue;
      if (known_apart(blobs[a], blobs[b], predictions)) continue;
      PiecePair pair{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), true};
      if (cut_by_post(blobs, blobs[a], blobs[b])) return pair;
      pair.rows_match = rows_match(blobs[a], blobs[b]);
      pair.whole = whole_of(blobs[a], blobs[b], predictions);
      if (pair.whole != kNoMatch) return pair;
    }
  }
  return {};
}

bool are_alike(const Observation& one, const Observation& other) {
  if (one.bearing || other.bearing) return false;
  const Box& left = one.box.x1 < other.box.x1 ? one.box : other.box;
  const Box& right = one.box.x1 < other.box.x1 ? other.box : one.box;
  const int both = (left.x2 - left.x1) + (right.x2 - right.x1) + 2;
  return one.signature == other.signature && near(left.y1, right.y1) && near(left.y2, right.y2) && right.x1 > left.x2 &&
         right.x1 - left.x2 <= both;
}

void join(base::FixedVector<WaitingBlob, sensor::kMaxBlobs>& blobs, const PiecePair& pair) {
  Box& joined = blobs[pair.left].box;
  const Box& other = blobs[pair.right].box;
  blobs[pair.left].moves = blobs[pair.left].moves || blobs[pair.right].moves;
  if (blobs[pair.left].track != blobs[pair.right].track) blobs[pair.left].track = 0;
  joined.x2 = other.x2;
  joined.y1 = std::min(joined.y1, other.y1);
  joined.y2 = std::max(joined.y2, other.y2);
  blobs.erase_at(pair.right);
}

}  // namespace fencepost::recon
