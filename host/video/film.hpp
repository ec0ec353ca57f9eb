// Films as files: Y4M as it is, M-JPEG as pictures one behind the other. A JPEG file is a film of one picture.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/bus/picture_source.hpp"
#include "hal/linux/opened.hpp"
#include "host/video/jpeg.hpp"

namespace fencepost::host {

class Film {
 public:
  /// errors: a sentence: no such file, neither Y4M nor JPEG, a layout that is not known, a damaged first picture
  static linux::Opened<Film> open(const std::string& path);

  [[nodiscard]] std::uint16_t width() const { return width_; }
  [[nodiscard]] std::uint16_t height() const { return height_; }
  [[nodiscard]] double rate() const { return rate_; }  ///< pictures a second; 30 where the file does not say

  /// The next picture, borrowed until the next call; its time is 0. errors: kGone: that was the last; kBadInput: it is
  /// damaged or of another size, the next may be good
  base::Result<bus::Picture> next();

 private:
  explicit Film(std::string path) : path_(std::move(path)) {}
  [[nodiscard]] linux::Problem problem(const std::string& what, const std::string& remedy) const;
  std::string read_header(const std::string& line);
  base::Result<bus::Picture> next_planar();
  base::Result<bus::Picture> next_jpeg();
  bool read_jpeg();

  std::string path_;
  std::unique_ptr<std::ifstream> file_;
  std::uint16_t width_ = 0;
  std::uint16_t height_ = 0;
  double rate_ = 30;
  bus::PixelLayout layout_ = bus::PixelLayout::kYuyv;
  std::size_t chroma_rows_ = 1;        ///< rows of pixels to one of chroma
  std::unique_ptr<JpegDecoder> jpeg_;  ///< of M-JPEG; null: Y4M
  std::vector<std::uint8_t> read_;
  std::vector<std::uint8_t> rows_;
  std::size_t ahead_ = 0;  ///< bytes of `read_` that were given already
};

}  // namespace fencepost::host
