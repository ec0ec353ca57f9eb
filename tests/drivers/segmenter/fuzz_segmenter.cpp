// libFuzzer's way in; a short run of it is an ordinary test.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "drivers/segmenter/blob_finder.hpp"
#include "drivers/segmenter/colour_table.hpp"

// Whatever the pixels are: boxes lie in the image, hold their pixels and their centroid, and come largest first. No
// pixel is in two of them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fencepost;
  using bus::PixelLayout;
  if (size < 16) return 0;
  static const auto table = std::make_unique<segmenter::ColourTable>();
  static unsigned runs = 0;
  if (runs++ % 64 == 0) {
    // A table takes long to fill: the same colours for a while.
    const auto share = [&](std::size_t i) { return base::Ratio4{data[i] * 40}; };
    std::vector<segmenter::ColourRange> ranges;
    for (const std::size_t at : {0U, 4U}) {
      ranges.push_back({static_cast<std::uint8_t>(at + 1), std::min(share(at), share(at + 1)),
                        std::max(share(at), share(at + 1)), std::min(share(at + 2), share(at + 3)),
                        std::max(share(at + 2), share(at + 3)), 0, 255});
    }
    table->fill(static_cast<PixelLayout>(data[8] % 3), ranges);
  }
  const std::uint32_t min_pixels = 1U + data[9] % 8U;
  segmenter::BlobFinder finder({min_pixels, static_cast<std::uint16_t>(data[10] % 4)});
  const std::size_t width = 1U + data[11] % 64U;
  const std::size_t row_size = segmenter::row_bytes(table->layout(), width);
  const std::size_t rows = std::min((size - 12) / row_size, segmenter::BlobFinder::kMaxHeight);
  std::vector<std::uint8_t> labels(width);
  std::size_t coloured = 0;
  finder.begin();
  for (std::size_t v = 0; v < rows; ++v) {
    table->look_up({data + 12 + v * row_size, row_size}, labels);
    coloured += static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), [](auto s) { return s != 0; }));
    finder.add_row(labels);
  }
  const sensor::BlobFrame frame = finder.finish();
  std::size_t in_boxes = 0;
  std::uint32_t last = UINT32_MAX;
  for (const sensor::Blob& blob : frame.blobs) {
    if (blob.signature == 0 || blob.x1 < 0 || blob.x1 > blob.x2 || blob.x2 >= static_cast<int>(width)) std::abort();
    if (blob.y1 < 0 || blob.y1 > blob.y2 || blob.y2 >= static_cast<int>(rows)) std::abort();
    const int area = (blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1);
    if (blob.pixels < min_pixels || blob.pixels > static_cast<std::uint32_t>(area) || blob.pixels > last) std::abort();
    if (blob.cx.raw < 10 * blob.x1 || blob.cx.raw > 10 * blob.x2) std::abort();
    if (blob.cy.raw < 10 * blob.y1 || blob.cy.raw > 10 * blob.y2) std::abort();
    last = blob.pixels;
    in_boxes += blob.pixels;
  }
  if (in_boxes > coloured) std::abort();
  if (finder.dropped() == 0 && min_pixels == 1 && in_boxes != coloured) std::abort();
  return 0;
}
