// Sources of pictures chosen at run time, there or waiting for their camera.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "hal/bus/picture_source.hpp"
#include "hal/linux/v4l2.hpp"
#include "host/live/open_port.hpp"
#include "host/live/port.hpp"
#include "host/video/film.hpp"
#include "host/video/jpeg.hpp"

namespace fencepost::host {

class PicturePort : public Port {
 public:
  virtual base::Result<bus::Picture> next() = 0;
};
static_assert(bus::PictureSource<PicturePort>);

/// A camera of the kernel; what it sends as JPEG is decoded.
class WebcamPort final : public AwaitedPort<PicturePort, linux::V4l2> {
 public:
  using AwaitedPort::AwaitedPort;
  base::Result<bus::Picture> next() override {
    if (bus() == nullptr) return base::Error::kGone;
    const base::Result<linux::CodedPicture> coded = bus()->next();
    if (!coded) return coded.error();
    if (coded->coding == linux::PictureCoding::kYuyv) {
      return bus::Picture{bus::PixelLayout::kYuyv, coded->width, coded->height, coded->stride, coded->bytes, coded->t};
    }
    const base::Result<bus::Picture> decoded = jpeg_.decode(coded->bytes);
    if (!decoded) return decoded.error();
    if (decoded->width != coded->width || decoded->height != coded->height) return base::Error::kBadInput;
    bus::Picture picture = *decoded;
    picture.t = coded->t;
    return picture;
  }

 private:
  JpegDecoder jpeg_;
};

/// Plays a film once, from the first `tend` on: each picture when it is due.
class FilmPort final : public PicturePort {
 public:
  explicit FilmPort(Film film) : film_(std::move(film)) {}

  void tend(base::Time now) override {
    if (!start_) start_ = now;
    now_ = now;
  }
  [[nodiscard]] bool connected() const override { return !over_; }
  [[nodiscard]] std::string problem() const override { return over_ ? "the film is over" : ""; }
  [[nodiscard]] int descriptor() const override { return -1; }

  base::Result<bus::Picture> next() override {
    if (over_) return base::Error::kGone;
    if (!start_) return base::Error::kNotReady;
    const base::Time due = *start_ + base::Duration::nearest(static_cast<double>(given_) / film_.rate());
    if (now_ < due) return base::Error::kNotReady;
    ++given_;
    const base::Result<bus::Picture> read = film_.next();
    if (!read) {
      over_ = read.error() == base::Error::kGone;
      return read.error();
    }
    bus::Picture picture = *read;
    picture.t = due;
    return picture;
  }

 private:
  Film film_;
  std::optional<base::Time> start_;
  base::Time now_;
  std::uint64_t given_ = 0;
  bool over_ = false;
};

}  // namespace fencepost::host
