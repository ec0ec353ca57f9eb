#include "host/video/film.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <string_view>

namespace fencepost::host {
namespace {

constexpr std::string_view kY4m = "YUV4MPEG2";
constexpr std::string_view kConvert = "convert it with 'ffmpeg -i FILM -pix_fmt yuv420p FILM.y4m'";
constexpr std::size_t kMaxJpeg = std::size_t{16} << 20U;  // bytes of one picture

std::size_t half_up(std::size_t n) { return (n + 1) / 2; }

/// A number from 2 to 32767, or 0.
std::uint16_t side_in(std::string_view text) {
  const long value = std::strtol(std::string(text).c_str(), nullptr, 10);
  return value >= 2 && value <= 32'767 ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
}

/// "30000:1001"; 0 where it is none.
double rate_in(std::string_view text) {
  char* end = nullptr;
  const std::string word(text);
  const double pictures = std::strtod(word.c_str(), &end);
  const double seconds = *end == ':' ? std::strtod(end + 1, nullptr) : 0;
  return pictures > 0 && seconds > 0 ? pictures / seconds : 0;
}

}  // namespace

linux::Problem Film::problem(const std::string& what, const std::string& remedy) const {
  return {"the film " + path_ + " " + what + "; " + remedy};
}

linux::Opened<Film> Film::open(const std::string& path) {
  Film film(path);
  film.file_ = std::make_unique<std::ifstream>(path, std::ios::binary);
  std::array<char, kY4m.size()> start{};
  film.file_->read(start.data(), start.size());
  if (film.file_->gcount() == 0) return film.problem("cannot be read", "check its name and the permissions");
  if (std::string_view(start.data(), start.size()) == kY4m) {
    std::string line;
    std::getline(*film.file_, line);
    const std::string fault = film.read_header(line);
    if (!fault.empty()) return film.problem(fault, std::string(kConvert));
    return film;
  }
  if (std::string_view(start.data(), 3) != "\xff\xd8\xff") {
    return film.problem("is neither Y4M nor JPEG", std::string(kConvert));
  }
  if (const std::string missing = JpegDecoder::missing(); !missing.empty()) return linux::Problem{missing};
  film.jpeg_ = std::make_unique<JpegDecoder>();
  film.file_->clear();
  film.file_->seekg(0);
  const base::Result<bus::Picture> first = film.next_jpeg();
  if (!first) return film.problem("begins with a damaged picture", "copy it again");
  film.width_ = first->width;
  film.height_ = first->height;
  film.ahead_ = 0;  // it is given again
  return film;
}

/// Its fault, or nothing.
std::string Film::read_header(const std::string& line) {
  std::istringstream words(line);
  std::string colours = "420jpeg";  // where nothing is said
  for (std::string word; words >> word;) {
    const std::string_view value = std::string_view(word).substr(1);
    switch (word[0]) {
      case 'W': width_ = side_in(value); break;
      case 'H': height_ = side_in(value); break;
      case 'F': rate_ = rate_in(value); break;
      case 'C': colours = value; break;
      case 'X':
        if (value == "COLORRANGE=FULL") layout_ = bus::PixelLayout::kYuyvFull;
        break;
      default: break;
    }
  }
  if (width_ == 0 || height_ == 0 || rate_ <= 0) return "has no size or no rate in its first line";
  const bool is_420 = colours == "420" || colours == "420jpeg" || colours == "420mpeg2" || colours == "420paldv";
  if (!is_420 && colours != "422") return "has colours of the kind " + colours;
  chroma_rows_ = is_420 ? 2 : 1;
  return {};
}

base::Result<bus::Picture> Film::next() {
  base::Result<bus::Picture> picture = jpeg_ ? next_jpeg() : next_planar();
  if (picture && (picture->width != width_ || picture->height != height_)) return base::Error::kBadInput;
  return picture;
}

base::Result<bus::Picture> Film::next_planar() {
  std::string line;
  if (!std::getline(*file_, line) || !line.starts_with("FRAME")) return base::Error::kGone;
  const std::size_t columns = half_up(width_);
  const std::size_t luma = std::size_t{width_} * height_;
  const std::size_t chroma = columns * (chroma_rows_ == 2 ? half_up(height_) : std::size_t{height_});
  read_.resize(luma + 2 * chroma);
  file_->read(reinterpret_cast<char*>(read_.data()), static_cast<std::streamsize>(read_.size()));  // NOLINT
  if (static_cast<std::size_t>(file_->gcount()) != read_.size()) return base::Error::kGone;
  const std::size_t stride = 4 * columns;
  rows_.resize(stride * height_);
  std::uint8_t* out = rows_.data();
  for (std::size_t v = 0; v < height_; ++v) {
    const std::uint8_t* const y = read_.data() + v * width_;
    const std::uint8_t* const u = read_.data() + luma + v / chroma_rows_ * columns;
    for (std::size_t i = 0; i < columns; ++i) {
      *out++ = y[2 * i];
      *out++ = u[i];
      *out++ = y[std::min<std::size_t>(2 * i + 1, width_ - 1U)];
      *out++ = u[i + chroma];
    }
  }
  return bus::Picture{layout_, width_, height_, stride, rows_, {}};
}

/// Fills `read_` from the next picture's first byte until its end is in it. False at the film's end.
bool Film::read_jpeg() {
  read_.erase(read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(ahead_));
  ahead_ = 0;
  std::array<char, 65'536> portion{};
  for (std::size_t looked = 0;;) {
    // The end of a picture, and behind it another or nothing: thumbnails within have an end, too.
    for (; looked + 4 <= read_.size(); ++looked) {
      if (read_[looked] == 0xFF && read_[looked + 1] == 0xD9 && read_[looked + 2] == 0xFF &&
          read_[looked + 3] == 0xD8) {
        ahead_ = looked + 2;
        return true;
      }
    }
    if (read_.size() > kMaxJpeg) return false;
    file_->read(portion.data(), portion.size());
    const auto count = file_->gcount();
    if (count <= 0) {
      ahead_ = read_.size();
      return !read_.empty();
    }
    read_.insert(read_.end(), portion.begin(), portion.begin() + count);
  }
}

base::Result<bus::Picture> Film::next_jpeg() {
  if (!read_jpeg()) return base::Error::kGone;
  return jpeg_->decode({read_.data(), ahead_});
}

}  // namespace fencepost::host
