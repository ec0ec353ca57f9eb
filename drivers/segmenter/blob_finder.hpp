// Boxes of connected pixels, row by row: runs of one signature, joined with those above them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/fixed.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::segmenter {

struct BlobRules {
  /// Smaller regions are noise. 0.05 % of 320 x 240, as `fencepost segment` has it.
  std::uint32_t min_pixels = 38;
  /// px. Regions of one signature with a gap of at most this in both directions are one: a glint or a thin line.
  std::uint16_t max_gap = 3;
};

/// Memory is fixed, 45 KB: a row has at most as many runs, and so touches at most as many regions, as it has pixels.
/// Diagonal neighbours are connected. Cost: a few operations a pixel, and a few dozen a run.
class BlobFinder {
 public:
  static constexpr std::size_t kMaxWidth = 640;   ///< px
  static constexpr std::size_t kMaxHeight = 640;  ///< px

  explicit BlobFinder(const BlobRules& rules) : rules_(rules) {}

  /// An image begins; what was not finished is forgotten.
  void begin();
  /// The next row: a signature for each pixel, 0 for background. At most kMaxWidth pixels and kMaxHeight rows; all of
  /// one length.
  void add_row(std::span<const std::uint8_t> labels);
  /// The image is over. Blobs largest first, without a colour.
  sensor::BlobFrame finish();

  /// Blobs beyond the 16 of a frame, and regions beyond the 64 that are kept until its end, since construction.
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  struct Region {
    std::uint8_t signature = 0;
    std::int16_t x1 = 0;
    std::int16_t y1 = 0;
    std::int16_t x2 = 0;
    std::int16_t y2 = 0;
    std::uint32_t pixels = 0;
    std::uint32_t sum_u = 0;
    std::uint32_t sum_v = 0;
  };
  struct Run {
    std::uint8_t signature = 0;
    std::int16_t first = 0;
    std::int16_t last = 0;
    std::uint16_t region = 0;  ///< of its row
  };
  /// All that one row has.
  struct Row {
    base::FixedVector<Run, kMaxWidth> runs;
    base::FixedVector<Region, kMaxWidth> regions;
  };

  void take_row(std::span<const std::uint8_t> labels);
  void connect(Row& above, Row& row);
  void join_above(Row& above, Row& row);
  std::uint16_t root_of(std::uint16_t region);
  void unite(Row& above, std::uint16_t a, std::uint16_t b);
  void close(const Region& region);
  void merge_near();
  static void absorb(Region& into, const Region& other);
  [[nodiscard]] bool belong_together(const Region& a, const Region& b) const;

  static constexpr std::uint16_t kNone = 0xFFFF;
  static constexpr std::size_t kMaxClosed = 64;

  BlobRules rules_;
  std::array<Row, 2> rows_;
  std::size_t current_ = 0;
  std::int16_t v_ = 0;                             ///< of the next row
  std::array<std::uint16_t, kMaxWidth> parent_{};  ///< of the regions above
  std::array<std::uint16_t, kMaxWidth> below_{};   ///< the region that continues it; kNone: none does
  base::FixedVector<Region, kMaxClosed> closed_;   ///< large enough, the largest
  std::uint32_t dropped_ = 0;
};

}  // namespace fencepost::segmenter
