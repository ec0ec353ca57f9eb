// All tangents of an outline side by side, for processors that handle several numbers at a time. The same bits as
// LowOrderFit::add() and SupportFit::add(), which take one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/recon/models/hybrid/cyclic_band.hpp"
#include "firmware/recon/models/hybrid/low_order_fit.hpp"
#include "firmware/recon/models/hybrid/sector_store.hpp"
#include "firmware/recon/models/inlier.hpp"

namespace fencepost::recon {

inline constexpr std::size_t kMaxTangents = kClustersPerSector * kRing;
using TangentRow = std::array<float, kMaxTangents>;

/// Per tangent, in its place: the values that are the same in every pass. Places without a tangent have no weight.
struct TangentColumns {
  alignas(64) TangentRow offset;   ///< m
  alignas(64) TangentRow sigma;    ///< m
  alignas(64) TangentRow counted;  ///< its views times its standing
  alignas(64) TangentRow is_edge;  ///< 1; 0: a lower bound
  alignas(64) TangentRow least;    ///< m: a residual that is no larger does not count
  alignas(64) TangentRow firm;     ///< m: the same in a pass that takes all as inliers

  void put(std::size_t place, const Cluster& cluster, float counts_for);
  void leave_out(std::size_t begin, std::size_t end);
};

/// Per tangent: the results of one pass.
struct TangentTerms {
  alignas(64) TangentRow residual;
  alignas(64) TangentRow weight;
  alignas(64) TangentRow share;   ///< of Spread::weight
  alignas(64) TangentRow square;  ///< of Spread::squares
};

inline constexpr std::size_t kSeries = series_size(3);

/// Support values of a ring, m, the first of which comes again at the end.
using RingOffsets = std::array<float, kRing + 1>;

/// The tangents of a series of order 3: those in use, in their order.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): gather() writes what is read
struct SeriesTangents {
  /// A tangent's functions, and its residual in the last place.
  struct alignas(32) Functions {
    std::array<float, kSeries + 1> at;
  };

  std::size_t count = 0;
  std::size_t edges = 0;
  TangentColumns columns;
  alignas(64) std::array<TangentRow, kSeries> basis;
  std::array<Functions, kMaxTangents> functions;
};

/// The sums that LowOrderFit::add() makes: packed lower triangle, right side, spread.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): sum_series() writes all of it
struct SeriesSums {
  std::array<float, packed_size(kSeries)> matrix;
  std::array<float, kSeries> rhs;
  Spread spread;
};

/// One pass over all tangents. `widening`: factor on their sigmas; `trusted`: all are inliers.
void sum_series(SeriesTangents& tangents, const std::array<float, kSeries>& x, float widening, bool trusted,
                SeriesSums& sums);

/// LowOrderFit::at() at all nodes of a ring.
void series_around(const std::array<float, kSeries>& x, const std::array<float, packed_size(kSeries)>& factor,
                   RingOffsets& offsets, std::array<std::uint8_t, kRing>& sigmas);

/// The tangents of a support polygon: place k is the first of sector k, place kRing + k its second.
struct RingTangents {
  TangentColumns columns;
  alignas(64) TangentRow first;   ///< share of the support value at the beginning of the sector
  alignas(64) TangentRow second;  ///< at its end
};

/// The tangents of 64 sectors, for both fits.
void gather(ConstClusters clusters, SeriesTangents& series, RingTangents& ring);

/// The equations of a ring.
struct RingEquations {
  using Column = std::array<float, kRing>;
  alignas(64) Column diagonal;
  alignas(64) Column first;
  alignas(64) Column second;
  alignas(64) Column rhs;
};

/// One pass over all tangents, from nothing but SupportFit's hold on its diagonal. `terms` are left for the spread.
void sum_ring(const RingTangents& tangents, const RingOffsets& offsets, float widening, RingEquations& equations,
              TangentTerms& terms);

/// Knowledge of the sides: SupportFit::add_side() for all of them.
struct RingSides {
  float round_side;  ///< m, of a round outline
  float weight;
  bool polygonal;
};
void add_sides(const RingOffsets& offsets, const RingSides& sides, RingEquations& equations);

}  // namespace fencepost::recon
