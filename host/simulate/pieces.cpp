#include "host/simulate/pieces.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace fencepost::host {

namespace {

/// Pixels of one object side by side in one row. Runs of one signature are joined, whichever object they belong to.
struct Run {
  int begin = 0;  ///< first column
  int end = 0;    ///< last column
  std::int16_t object = 0;
  std::size_t parent = 0;  ///< index of a run of the same piece, itself at the root; always an earlier one
};

std::size_t root_of(std::vector<Run>& runs, std::size_t i) {
  while (runs[i].parent != i) {
    runs[i].parent = runs[runs[i].parent].parent;
    i = runs[i].parent;
  }
  return i;
}

void join(std::vector<Run>& runs, std::size_t a, std::size_t b) {
  a = root_of(runs, a);
  b = root_of(runs, b);
  if (a < b) runs[b].parent = a;
  if (b < a) runs[a].parent = b;
}

void append_runs(const LabelImage& image, int v, std::vector<Run>& runs) {
  const PixelBox& area = image.touched();
  for (int u = area.x1; u <= area.x2;) {
    const std::int16_t object = image.drawn(u, v);
    int end = u;
    while (end < area.x2 && image.drawn(end + 1, v) == object) ++end;
    if (object != LabelImage::kNothing) runs.push_back({u, end, object, runs.size()});
    u = end + 1;
  }
}

/// Joins the runs [middle, end) to those of the row above, [begin, middle).
void join_rows(std::vector<Run>& runs, std::size_t begin, std::size_t middle,
               std::span<const std::uint8_t> signatures) {
  const auto alike = [&](const Run& a, const Run& b) {
    return signatures[static_cast<std::size_t>(a.object)] == signatures[static_cast<std::size_t>(b.object)];
  };
  std::size_t above = begin;
  for (std::size_t i = middle; i < runs.size(); ++i) {
    if (i > middle && runs[i - 1].end + 1 == runs[i].begin && alike(runs[i - 1], runs[i])) join(runs, i - 1, i);
    while (above < middle && runs[above].end + 1 < runs[i].begin) ++above;
    for (std::size_t k = above; k < middle && runs[k].begin <= runs[i].end + 1; ++k) {
      if (alike(runs[k], runs[i])) join(runs, k, i);
    }
  }
}

/// Four at a time: each minimum waits for the one before it.
double nearest_of(const LabelImage& image, const Run& run, int v) {
  std::array<double, 4> least;
  least.fill(image.depth(run.begin, v));
  int u = run.begin;
  for (; u + 3 <= run.end; u += 4) {
    for (int i = 0; i < 4; ++i) {
      double& one = least[static_cast<std::size_t>(i)];
      one = std::min(one, image.depth(u + i, v));
    }
  }
  for (; u <= run.end; ++u) least[0] = std::min(least[0], image.depth(u, v));
  return *std::min_element(least.begin(), least.end());
}

void add_run(Piece& piece, const Run& run, int v, const LabelImage& image) {
  const std::int64_t count = run.end - run.begin + 1;
  const double nearest = nearest_of(image, run, v);
  piece.nearest = piece.pixels == 0 ? nearest : std::min(piece.nearest, nearest);
  if (piece.pixels == 0 || run.begin < piece.box.x1) piece.left = static_cast<std::size_t>(run.object);
  if (piece.pixels == 0 || run.end > piece.box.x2) piece.right = static_cast<std::size_t>(run.object);
  piece.box.include(run.begin, v);
  piece.box.include(run.end, v);
  piece.pixels += count;
  piece.sum_u += count * (run.begin + run.end) / 2;  // exact: count and begin + end are never both odd
  piece.sum_v += count * v;
}

// The piece of an object that stands apart.
Piece whole_piece(const LabelImage& image, std::size_t object) {
  const Silhouette& silhouette = image.silhouette(object);
  Piece piece;
  piece.object = piece.left = piece.right = object;
  piece.box = silhouette.box();
  piece.nearest = silhouette.columns().front().nearest;
  int u = piece.box.x1;
  for (const ColumnRun& run : silhouette.columns()) {
    const std::int64_t count = run.last - run.first + 1;
    piece.pixels += count;
    piece.sum_u += count * u++;
    piece.sum_v += count * (run.first + run.last) / 2;  // exact, as above
    piece.nearest = std::min(piece.nearest, run.nearest);
  }
  return piece;
}

// Pixels of each object in one piece: names the owner and the others.
void name_objects(Piece& piece, const std::map<std::size_t, std::int64_t>& pixels) {
  const auto most =
      std::max_element(pixels.begin(), pixels.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  piece.object = most->first;
  for (const auto& [object, count] : pixels) {
    if (object != piece.object) piece.others.push_back(object);
  }
}

// Finds the pieces of the objects that are drawn; their others and owners are named.
void find_drawn_pieces(const LabelImage& image, std::span<const std::uint8_t> signatures, std::vector<Piece>& pieces) {
  const PixelBox& area = image.touched();
  if (area.empty()) return;
  std::vector<Run> runs;
  std::vector<int> row_of;
  std::size_t above = 0;
  for (int v = area.y1; v <= area.y2; ++v) {
    const std::size_t begin = runs.size();
    append_runs(image, v, runs);
    row_of.resize(runs.size(), v);
    join_rows(runs, above, begin, signatures);
    above = begin;
  }
  std::vector<std::size_t> piece_of(runs.size());
  std::vector<std::map<std::size_t, std::int64_t>> pixels_of;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t root = root_of(runs, i);
    if (root == i) {
      piece_of[i] = pieces.size();
      pieces.push_back({});
      pixels_of.emplace_back();
    }
    add_run(pieces[piece_of[root]], runs[i], row_of[i], image);
    pixels_of[piece_of[root]][static_cast<std::size_t>(runs[i].object)] += runs[i].end - runs[i].begin + 1;
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) name_objects(pieces[i], pixels_of[i]);
}

}  // namespace

std::vector<Piece> find_pieces(const LabelImage& image, std::span<const std::uint8_t> signatures) {
  std::vector<Piece> pieces;
  find_drawn_pieces(image, signatures, pieces);
  for (const std::size_t object : image.apart()) pieces.push_back(whole_piece(image, object));
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.object < b.object; });
  return pieces;
}

}  // namespace fencepost::host
