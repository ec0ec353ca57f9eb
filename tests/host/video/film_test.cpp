#include "host/video/film.hpp"

#include <gtest/gtest.h>

#include "host/video/picture_port.hpp"
#include "tests/host/video/files.hpp"

namespace fencepost::host {
namespace {

using base::Error;
using base::milliseconds;
using base::Time;
using testing::plain;

class FilmFile : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    const std::string path = folder_.file(name);
    test::spill(path, bytes);
    return path;
  }
  std::string problem(const std::string& bytes) {
    const linux::Opened<Film> film = Film::open(file("film", bytes));
    return film ? "none" : film.problem();
  }
  test::Folder folder_;
};

std::vector<std::uint8_t> bytes_of(const bus::Picture& picture) { return {picture.bytes.begin(), picture.bytes.end()}; }

const std::string kHeader = "YUV4MPEG2 W4 H2 F25:2 Ip A1:1 C420jpeg XYSCSS=420JPEG\n";
const std::string kFrame = "FRAME\nabcdefghUVuv";  // a chroma is of two by two pixels

TEST_F(FilmFile, ReadsY4m) {
  linux::Opened<Film> film = Film::open(file("film.y4m", kHeader + kFrame + "FRAME Ixyz\n" + std::string(12, 'z')));
  ASSERT_TRUE(film) << film.problem();
  EXPECT_EQ(film->width(), 4);
  EXPECT_EQ(film->height(), 2);
  EXPECT_DOUBLE_EQ(film->rate(), 12.5);
  const auto first = film->next();
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first->layout, bus::PixelLayout::kYuyv);
  EXPECT_EQ(first->stride, 8U);
  const std::string rows = "aUbucVdveUfugVhv";
  EXPECT_EQ(bytes_of(*first), std::vector<std::uint8_t>(rows.begin(), rows.end()));
  EXPECT_EQ(film->next()->bytes[0], 'z');
  EXPECT_EQ(film->next().error(), Error::kGone);
}

TEST_F(FilmFile, ReadsChromaOfEachRowAndFullRange) {
  linux::Opened<Film> film =
      Film::open(file("film.y4m", "YUV4MPEG2 W3 H2 F30:1 C422 XCOLORRANGE=FULL\nFRAME\nabcdefUVWXuvwx"));
  ASSERT_TRUE(film) << film.problem();
  const auto picture = film->next();
  EXPECT_EQ(picture->layout, bus::PixelLayout::kYuyvFull);
  const std::string rows = "aUbucVcvdWewfXfx";  // of an odd row the last pixel twice
  EXPECT_EQ(bytes_of(*picture), std::vector<std::uint8_t>(rows.begin(), rows.end()));
}

TEST_F(FilmFile, AFilmThatIsCutOffEnds) {
  linux::Opened<Film> film = Film::open(file("film.y4m", kHeader + kFrame + kFrame.substr(0, 12)));
  EXPECT_TRUE(film->next().ok());
  EXPECT_EQ(film->next().error(), Error::kGone);
  EXPECT_EQ(film->next().error(), Error::kGone);
}

TEST_F(FilmFile, ReadsPicturesOneBehindTheOther) {
  RgbPicture red = plain(32, 16, {200, 30, 30});
  RgbPicture blue = plain(32, 16, {30, 30, 200});
  linux::Opened<Film> film = Film::open(file("film.mjpeg", encode_jpeg(red) + encode_jpeg(blue)));
  ASSERT_TRUE(film) << film.problem();
  EXPECT_EQ(film->width(), 32);
  EXPECT_EQ(film->height(), 16);
  EXPECT_DOUBLE_EQ(film->rate(), 30);
  const auto first = film->next();
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first->layout, bus::PixelLayout::kRgb);
  EXPECT_NEAR(first->bytes[0], 200, 3);
  EXPECT_NEAR(film->next()->bytes[2], 200, 3);
  EXPECT_EQ(film->next().error(), Error::kGone);
}

TEST_F(FilmFile, ADamagedOrLargerPictureIsPassedOver) {
  const std::string good = encode_jpeg(plain(32, 16, {200, 30, 30}));
  const std::string cut = good.substr(0, good.size() / 2) + "\xff\xd9";
  const std::string larger = encode_jpeg(plain(48, 16, {200, 30, 30}));
  linux::Opened<Film> film = Film::open(file("film.mjpeg", good + cut + larger + good));
  EXPECT_TRUE(film->next().ok());
  EXPECT_EQ(film->next().error(), Error::kBadInput);
  EXPECT_EQ(film->next().error(), Error::kBadInput);
  EXPECT_TRUE(film->next().ok());
  EXPECT_EQ(film->next().error(), Error::kGone);
}

TEST_F(FilmFile, SaysWhatIsWrong) {
  EXPECT_EQ(problem(kHeader), "none");
  for (const auto& [bytes, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "cannot be read"},
           {"GIF89a.....", "is neither Y4M nor JPEG"},
           {"YUV4MPEG2 W4 C420\n", "has no size or no rate"},
           {"YUV4MPEG2 W1 H2 F1:1\n", "has no size or no rate"},
           {"YUV4MPEG2 W99999999999999999999 H2 F1:1\n", "has no size or no rate"},
           {"YUV4MPEG2 W4 H2 F0:1\n", "has no size or no rate"},
           {"YUV4MPEG2 W4 H2 F1:0\n", "has no size or no rate"},
           {"YUV4MPEG2 W4 H2 F30:1 C444\n", "has colours of the kind 444"},
           {"YUV4MPEG2 W4 H2 F30:1 C420p10\n", "ffmpeg"},
           {"\xff\xd8\xff\xe0 no more", "begins with a damaged picture"}}) {
    EXPECT_NE(problem(bytes).find(what), std::string::npos) << problem(bytes);
  }
  EXPECT_NE(Film::open(folder_.file("none.y4m")).problem().find("none.y4m cannot be read"), std::string::npos);
}

TEST_F(FilmFile, APortPlaysItAtItsRateAndOnce) {
  FilmPort port(std::move(*Film::open(file("film.y4m", kHeader + kFrame + kFrame))));
  EXPECT_EQ(port.next().error(), Error::kNotReady);
  const Time start = Time{} + milliseconds(3'000);
  port.tend(start);
  EXPECT_EQ(port.next()->t, start);
  EXPECT_EQ(port.next().error(), Error::kNotReady);
  port.tend(start + milliseconds(79));
  EXPECT_EQ(port.next().error(), Error::kNotReady);
  port.tend(start + milliseconds(95));
  EXPECT_EQ(port.next()->t, start + milliseconds(80));
  EXPECT_TRUE(port.connected());
  port.tend(start + milliseconds(200));
  EXPECT_EQ(port.next().error(), Error::kGone);
  EXPECT_FALSE(port.connected());
  EXPECT_EQ(port.problem(), "the film is over");
}

}  // namespace
}  // namespace fencepost::host
