#include "host/models/tangent_terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "firmware/recon/models/hybrid/phase_tables.hpp"
#include "firmware/recon/models/hybrid/triangle.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"
#include "hal/base/vectors.hpp"
#include "host/models/exp_lanes.hpp"

namespace fencepost::recon {
namespace {

constexpr float kEverything = std::numeric_limits<float>::infinity();
constexpr std::size_t kBlock = 16;  // done at a time: whole vectors, whatever their size

// Sigmas as they count.
inline void widen(const TangentColumns& columns, std::size_t places, float widening, TangentRow& sigmas) {
  for (std::size_t i = 0; i < places; ++i) sigmas[i] = columns.sigma[i] * widening;
}

// exp(-x) of all places, in place. Each condition has a loop of its own: where the second follows from the first,
// compilers make a branch of both, and no vectors.
[[gnu::always_inline]] inline void exp_minus(TangentRow& x, std::size_t places) {
  alignas(64) TangentRow not_nothing;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < places; ++i) not_nothing[i] = x[i] < base::kExpUnderflow ? 1.0F : 0.0F;
  for (std::size_t i = 0; i < places; ++i) x[i] = x[i] < base::kExpUnderflow ? x[i] : base::kExpUnderflow;
  for (std::size_t i = 0; i < places; ++i) x[i] = base::exp_minus_within(x[i]) * not_nothing[i];
}

// How far each is believed: inlier_share().
[[gnu::always_inline]] inline void doubt(std::size_t places, const TangentRow& sigmas, const TangentRow& residual,
                                         TangentRow& believed) {
  alignas(64) TangentRow likely;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < places; ++i) likely[i] = inlier_exponent(residual[i], sigmas[i]);
  exp_minus(likely, places);
  for (std::size_t i = 0; i < places; ++i) {
    believed[i] *= inlier_share_by(likely[i], residual[i], sigmas[i], kFartherOutliers);
  }
}

// Residuals are known. Nothing depends on another place, so all are done, whether they count or not, and conditions
// become factors.
template <bool kTrusted>
[[gnu::always_inline]] inline void weigh(const TangentColumns& columns, std::size_t places, const TangentRow& sigmas,
                                         TangentTerms& terms) {
  const TangentRow& least = kTrusted ? columns.firm : columns.least;
  alignas(64) TangentRow believed;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < places; ++i) believed[i] = columns.counted[i];
  if constexpr (!kTrusted) doubt(places, sigmas, terms.residual, believed);
  alignas(64) TangentRow counts;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < places; ++i) counts[i] = terms.residual[i] > least[i] ? 1.0F : 0.0F;
  for (std::size_t i = 0; i < places; ++i) {
    const float sigma = sigmas[i];
    terms.weight[i] = believed[i] / (sigma * sigma) * counts[i];
    const float in_sigmas = terms.residual[i] / columns.sigma[i];
    const float share = believed[i] * columns.is_edge[i];
    terms.share[i] = share;
    terms.square[i] = share * in_sigmas * in_sigmas;
  }
}

// Eight sums at a time: of a tangent's functions times one of them, and in the last place times its residual.
using Row = float __attribute__((vector_size(sizeof(SeriesTangents::Functions))));

[[gnu::always_inline]] inline void sum_products(const SeriesTangents& tangents, const TangentTerms& terms,
                                                const std::array<TangentRow, kSeries>& weighted, SeriesSums& sums) {
  std::array<Row, kSeries> products{};
  Spread spread;
  for (std::size_t i = 0; i < tangents.count; ++i) {
    Row functions;
    std::memcpy(&functions, tangents.functions[i].at.data(), sizeof functions);
    for (std::size_t row = 0; row < kSeries; ++row) products[row] += weighted[row][i] * functions;
    spread.squares += terms.square[i];
    spread.weight += terms.share[i];
  }
  float* entry = sums.matrix.data();
  for (std::size_t row = 0; row < kSeries; ++row) {
    for (std::size_t column = 0; column <= row; ++column) *entry++ = products[row][column];
    sums.rhs[row] = products[row][kSeries];
  }
  sums.spread = spread;
}

// series_basis() at each node.
constexpr auto kRingBasis = [] {
  static_assert(kRing == kDirections);
  constexpr std::size_t kQuarter = kRing / 4;  // nodes
  std::array<std::array<float, kRing>, kSeries> basis{};
  for (std::size_t k = 0; k < kRing; ++k) {
    const float along = kQuarterCosines[k % kQuarter];
    const float across = kQuarterCosines[kQuarter - k % kQuarter];
    const std::array<float, 4> cosines{along, -across, -along, across};
    const std::array<float, 4> sines{across, along, -across, -along};
    basis[0][k] = 1;
    const float x = basis[1][k] = cosines[k / kQuarter];
    const float y = basis[2][k] = sines[k / kQuarter];
    for (std::size_t m = 1; m + 2 < kSeries; m += 2) {
      basis[m + 2][k] = basis[m][k] * x - basis[m + 1][k] * y;
      basis[m + 3][k] = basis[m + 1][k] * x + basis[m][k] * y;
    }
  }
  return basis;
}();

constexpr auto kSigmas = [] {
  std::array<float, 256> sigmas{};
  for (std::size_t code = 0; code < sigmas.size(); ++code) {
    sigmas[code] = static_cast<float>(whole_sigma(static_cast<std::uint8_t>(code))) * kSigmaUnit;
  }
  return sigmas;
}();

// unpack() and standing() of all tangents of a fit, to the same bits; the phase is left out. They are inlined for
// speed: a fit calls them for each tangent. The test of a batch compares their results.
[[gnu::always_inline]] inline Cluster unpacked(const PackedCluster& packed) {
  const auto steps =
      static_cast<std::int16_t>(static_cast<std::uint16_t>(packed.offset_low | (packed.offset_high << 8U)));
  return {static_cast<float>(steps) * kOffsetStep, 0, kSigmas[packed.sigma],
          static_cast<float>(packed.views) * kViewsStep, (packed.phase & 1U) != 0};
}
[[gnu::always_inline]] inline float standing(const Cluster& own, const PackedCluster& packed_other) {
  static_assert(kClustersPerSector == 2);
  if (own.lower_bound || packed_other.views == 0) return 1.0F;
  const Cluster other = unpacked(packed_other);
  const float enough = kOverrulingShare * own.views;
  return other.views >= enough && other.offset > own.offset + 2 * own.sigma ? kOverruled : 1.0F;
}

// encode_sigma() of all of them, without branches; the test of a batch compares these, too.
[[gnu::always_inline]] inline void encode_sigmas(const std::array<float, kRing>& sigmas,
                                                 std::array<std::uint8_t, kRing>& codes) {
  constexpr float kLargestSigma = 6.0F;
  constexpr std::int32_t kMantissa = 23;
  constexpr std::int32_t kExponentOf16 = 127 + 4;
  std::array<float, kRing> mantissas;         // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::array<std::int32_t, kRing> exponents;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t k = 0; k < kRing; ++k) {
    const float least = sigmas[k] > kSmallestSigma ? sigmas[k] : kSmallestSigma;
    mantissas[k] = (least < kLargestSigma ? least : kLargestSigma) / kSigmaUnit;
  }
  std::memcpy(exponents.data(), mantissas.data(), sizeof exponents);
  for (std::size_t k = 0; k < kRing; ++k) {
    const std::int32_t bits = exponents[k];
    exponents[k] = (bits >> kMantissa) - kExponentOf16;  // not below: the smallest sigma is 16 units
    const std::int32_t rest = bits - exponents[k] * (1 << kMantissa);
    std::memcpy(&mantissas[k], &rest, sizeof rest);
  }
  for (std::size_t k = 0; k < kRing; ++k) {
    // 31.5 and more are rounded to 32, which is 16 with the next exponent.
    const auto whole = static_cast<std::int32_t>(mantissas[k] + 0.5F);
    codes[k] = static_cast<std::uint8_t>(exponents[k] * 16 + whole - 16);
  }
}

}  // namespace

void TangentColumns::put(std::size_t place, const Cluster& cluster, float counts_for) {
  offset[place] = cluster.offset;
  sigma[place] = cluster.sigma;
  counted[place] = counts_for;
  is_edge[place] = cluster.lower_bound ? 0.0F : 1.0F;
  least[place] = cluster.lower_bound ? 0.0F : -kEverything;
  firm[place] = cluster.lower_bound ? kEverything : -kEverything;
}

void TangentColumns::leave_out(std::size_t begin, std::size_t end) {
  const auto fill = [&](TangentRow& row, float value) {
    for (std::size_t place = begin; place < end; ++place) row[place] = value;
  };
  fill(offset, 0);
  fill(sigma, 1);
  fill(counted, 0);
  fill(is_edge, 0);
  fill(least, kEverything);
  fill(firm, kEverything);
}

FENCEPOST_FOR_EACH_PROCESSOR
void gather(ConstClusters clusters, SeriesTangents& series, RingTangents& ring) {
  ring.columns.leave_out(0, kMaxTangents);
  ring.first.fill(0);
  ring.second.fill(0);
  auto& basis = series.basis;
  std::size_t count = 0;
  std::size_t edges = 0;
  for (std::size_t index = 0; index < clusters.size(); ++index) {
    const PackedCluster& packed = clusters[index];
    if (packed.views == 0) continue;
    const Cluster cluster = unpacked(packed);
    const float counts_for = cluster.views * standing(cluster, clusters[index ^ 1U]);
    const std::size_t sector = index / kClustersPerSector;
    const std::size_t place = index % kClustersPerSector * kRing + sector;
    ring.columns.put(place, cluster, counts_for);
    const EndShares shares = kEndShares[place_in_sector(packed)];
    ring.first[place] = shares.first;
    ring.second[place] = shares.second;
    series.columns.put(count, cluster, counts_for);
    const Turn turn = kTurns<kDirections>[place_in_sector(packed)];
    const Vec2 direction = rotated({turn.cosine, turn.sine}, {kRingBasis[1][sector], kRingBasis[2][sector]});
    basis[1][count] = direction.x();
    basis[2][count] = direction.y();
    edges += cluster.lower_bound ? 0U : 1U;
    ++count;
  }
  series.count = count;
  series.edges = edges;
  const std::size_t places = (count + kBlock - 1) / kBlock * kBlock;
  series.columns.leave_out(count, places);
  for (std::size_t i = count; i < places; ++i) basis[1][i] = basis[2][i] = 0;
  for (std::size_t i = 0; i < places; ++i) basis[0][i] = 1;
  for (std::size_t m = 1; m + 2 < kSeries; m += 2) {
    for (std::size_t i = 0; i < places; ++i) {
      basis[m + 2][i] = basis[m][i] * basis[1][i] - basis[m + 1][i] * basis[2][i];
      basis[m + 3][i] = basis[m + 1][i] * basis[1][i] + basis[m][i] * basis[2][i];
    }
  }
  for (std::size_t i = 0; i < places; ++i) {
    for (std::size_t f = 0; f < kSeries; ++f) series.functions[i].at[f] = basis[f][i];
  }
}

FENCEPOST_FOR_EACH_PROCESSOR
void sum_series(SeriesTangents& tangents, const std::array<float, kSeries>& x, float widening, bool trusted,
                SeriesSums& sums) {
  const std::size_t places = (tangents.count + kBlock - 1) / kBlock * kBlock;
  TangentTerms terms;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const auto& basis = tangents.basis;
  for (std::size_t i = 0; i < places; ++i) {
    float residual = tangents.columns.offset[i] - x[0];
    residual -= basis[1][i] * x[1];
    residual -= basis[2][i] * x[2];
    residual -= basis[3][i] * x[3];
    residual -= basis[4][i] * x[4];
    residual -= basis[5][i] * x[5];
    residual -= basis[6][i] * x[6];
    terms.residual[i] = residual;
  }
  alignas(64) TangentRow sigmas;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  widen(tangents.columns, places, widening, sigmas);
  if (trusted) {
    weigh<true>(tangents.columns, places, sigmas, terms);
  } else {
    weigh<false>(tangents.columns, places, sigmas, terms);
  }
  alignas(64) std::array<TangentRow, kSeries> weighted;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t row = 0; row < kSeries; ++row) {
    for (std::size_t i = 0; i < places; ++i) weighted[row][i] = terms.weight[i] * basis[row][i];
  }
  for (std::size_t i = 0; i < tangents.count; ++i) tangents.functions[i].at[kSeries] = terms.residual[i];
  sum_products(tangents, terms, weighted, sums);
}

FENCEPOST_FOR_EACH_PROCESSOR
void series_around(const std::array<float, kSeries>& x, const std::array<float, packed_size(kSeries)>& factor,
                   RingOffsets& offsets, std::array<std::uint8_t, kRing>& sigmas) {
  using Ring = std::array<float, kRing>;
  std::array<Ring, kSeries> solved;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t k = 0; k < kRing; ++k) {
    float offset = x[0];
    for (std::size_t i = 1; i < kSeries; ++i) offset += kRingBasis[i][k] * x[i];
    offsets[k] = offset;
  }
  // b' (L L')^-1 b = |L^-1 b|^2, for all nodes at once.
  Ring variances{};
  for (std::size_t i = 0; i < kSeries; ++i) {
    const float* row = &factor[row_of(i)];
    Ring& own = solved[i];
    own = kRingBasis[i];
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < kRing; ++k) own[k] -= row[j] * solved[j][k];
    }
    for (std::size_t k = 0; k < kRing; ++k) own[k] /= row[i];
    for (std::size_t k = 0; k < kRing; ++k) variances[k] += own[k] * own[k];
  }
  for (std::size_t k = 0; k < kRing; ++k) variances[k] = std::sqrt(variances[k]);
  encode_sigmas(variances, sigmas);
}

FENCEPOST_FOR_EACH_PROCESSOR
void sum_ring(const RingTangents& tangents, const RingOffsets& offsets, float widening, RingEquations& equations,
              TangentTerms& terms) {
  static_assert(kClustersPerSector == 2);
  const TangentRow& a = tangents.first;
  const TangentRow& b = tangents.second;
  for (std::size_t begin = 0; begin < kMaxTangents; begin += kRing) {
    for (std::size_t k = 0; k < kRing; ++k) {
      const std::size_t i = begin + k;
      terms.residual[i] = tangents.columns.offset[i] - a[i] * offsets[k] - b[i] * offsets[k + 1];
    }
  }
  alignas(64) TangentRow sigmas;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  widen(tangents.columns, kMaxTangents, widening, sigmas);
  weigh<false>(tangents.columns, kMaxTangents, sigmas, terms);

  // Each tangent's terms at the beginning of its sector, and at the end.
  struct Parts {
    TangentRow diagonal;
    TangentRow rhs;
  };
  Parts begins;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  Parts ends;    // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < kMaxTangents; ++i) {
    const float at_begin = terms.weight[i] * a[i];
    const float at_end = terms.weight[i] * b[i];
    begins.diagonal[i] = at_begin * a[i];
    begins.rhs[i] = at_begin * terms.residual[i];
    ends.diagonal[i] = at_end * b[i];
    ends.rhs[i] = at_end * terms.residual[i];
  }
  constexpr float kHeld = 1.0F / (kHold * kHold);
  constexpr std::size_t kEnd = kRing - 1;
  // Sums in the order of the tangents: first those that end at the node; at the first node the last sector comes last.
  const auto sum = [](float start, const TangentRow& one, std::size_t i, const TangentRow& other, std::size_t j) {
    return start + one[i] + one[kRing + i] + other[j] + other[kRing + j];
  };
  equations.diagonal[0] = sum(kHeld, begins.diagonal, 0, ends.diagonal, kEnd);
  equations.rhs[0] = sum(0, begins.rhs, 0, ends.rhs, kEnd);
  for (std::size_t k = 1; k < kRing; ++k) {
    equations.diagonal[k] = sum(kHeld, ends.diagonal, k - 1, begins.diagonal, k);
    equations.rhs[k] = sum(0, ends.rhs, k - 1, begins.rhs, k);
  }
  for (std::size_t k = 0; k < kRing; ++k) {
    const std::size_t other = kRing + k;
    equations.first[k] = 0.0F + terms.weight[k] * a[k] * b[k] + terms.weight[other] * a[other] * b[other];
  }
}

FENCEPOST_FOR_EACH_PROCESSOR
void add_sides(const RingOffsets& offsets, const RingSides& sides, RingEquations& equations) {
  constexpr NodeStep kStep = node_step(kRing);
  constexpr float kOuter = 1.0F / kStep.sine;
  constexpr float kMiddle = -2.0F * kStep.cosine / kStep.sine;
  // Each side between its neighbours, of which the ends of the ring have each other.
  constexpr std::size_t kPadded = kRing + 2;
  std::array<float, kPadded> around;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::copy_n(offsets.begin(), kRing, around.begin() + 1);
  around[0] = offsets[kRing - 1];
  around[kPadded - 1] = offsets[0];
  std::array<float, kPadded> weights;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::array<float, kPadded> pulls;    // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t k = 1; k <= kRing; ++k) {
    const float length = kOuter * (around[k - 1] + around[k + 1]) + kMiddle * around[k];
    const float real = length < 0 ? 0.0F : length;
    const float relative = sides.weight * (sides.round_side / (real + kSoftening * sides.round_side));
    const float shape = length > kLongSide * sides.round_side ? sides.round_side : 0.0F;
    const float weight = sides.polygonal ? relative : sides.weight;
    const float target = sides.polygonal ? shape : sides.round_side;
    weights[k] = length < 0 ? weight * kStiffness : weight;
    pulls[k] = weights[k] * ((length < 0 ? 0.0F : target) - length);
  }
  weights[0] = weights[kRing];
  weights[kPadded - 1] = weights[1];
  pulls[0] = pulls[kRing];
  pulls[kPadded - 1] = pulls[1];
  const auto add = [&](std::size_t k, float diagonal, std::array<std::size_t, 3> order, float rhs) {
    for (const std::size_t side : order) {
      const float share = side == k + 1 ? kMiddle : kOuter;
      diagonal += weights[side] * share * share;
      rhs += pulls[side] * share;
    }
    equations.diagonal[k] = diagonal;
    equations.rhs[k] = rhs;
  };
  // In the order in which sides are added one by one: at the ends of the ring it is another one.
  constexpr std::size_t kEnd = kRing - 1;
  add(0, equations.diagonal[0], {1, 2, 0}, equations.rhs[0]);
  for (std::size_t k = 1; k < kEnd; ++k) {
    equations.diagonal[k] = equations.diagonal[k] + weights[k] * kOuter * kOuter + weights[k + 1] * kMiddle * kMiddle +
                            weights[k + 2] * kOuter * kOuter;
    equations.rhs[k] = equations.rhs[k] + pulls[k] * kOuter + pulls[k + 1] * kMiddle + pulls[k + 2] * kOuter;
  }
  add(kEnd, equations.diagonal[kEnd], {kPadded - 1, kEnd, kRing}, equations.rhs[kEnd]);
  for (std::size_t k = 0; k < kEnd; ++k) {
    equations.first[k] = equations.first[k] + weights[k + 1] * kMiddle * kOuter + weights[k + 2] * kOuter * kMiddle;
  }
  equations.first[kEnd] =
      equations.first[kEnd] + weights[kPadded - 1] * kOuter * kMiddle + weights[kRing] * kMiddle * kOuter;
  for (std::size_t k = 0; k < kRing; ++k) equations.second[k] = weights[k + 2] * kOuter * kOuter;
}

}  // namespace fencepost::recon
