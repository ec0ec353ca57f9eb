#include "host/import/log_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/record/encode.hpp"
#include "host/import/table.hpp"

namespace fencepost::host {

namespace {

template <class Record>
void append(std::string& log, const Record& record) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t length = record::encode(record, line);
  if (length == 0) {
    throw ImportProblem{"the recording",
                        "has a value outside the record stream's ranges (positions +-1000 m, 999999 s)",
                        "import a shorter window, or move the origin nearer"};
  }
  log.append(line.data(), length);
}

void append_calibration(std::string& log, const LogParts& parts) {
  append(log, parts.camera);
  for (const record::Signature& signature : parts.signatures) append(log, signature);
}

/// Each frame follows the first sample at or past its exposure.
template <class Sample>
void append_samples(std::string& log, const LogParts& parts, const std::vector<Sample>& samples) {
  constexpr base::Duration kRepeatPeriod = base::milliseconds(10'000);
  base::Time repeat{kRepeatPeriod.raw};
  auto frame = parts.frames.begin();
  for (const Sample& sample : samples) {
    if (sample.t >= repeat) {
      append_calibration(log, parts);
      while (sample.t >= repeat) repeat = repeat + kRepeatPeriod;
    }
    append(log, sample);
    for (; frame != parts.frames.end() && frame->t - parts.camera.latency <= sample.t; ++frame) append(log, *frame);
  }
  // Frames past the last sample have no pose; the reader counts them.
  for (; frame != parts.frames.end(); ++frame) append(log, *frame);
}

}  // namespace

std::string build_log(const LogParts& parts) {
  std::string log;
  record::Header header;
  header.product = "fencepost";
  header.version = kImporterVersion;
  header.target = std::string_view(parts.target);
  header.profile = "full";
  append(log, header);
  for (const record::Setting& setting : parts.settings) append(log, setting);
  append_calibration(log, parts);
  if (parts.car.empty()) {
    append_samples(log, parts, parts.odometry);
  } else {
    append_samples(log, parts, parts.car);
  }
  return log;
}

bool make_box(const sensor::CameraIntrinsics& camera, double left, double right, sensor::Blob& blob) {
  const double last = camera.width - 1;
  // Pixel u covers [u - 0.5, u + 0.5]; the nearest whole pixels.
  double x1 = std::round(left + 0.5);
  double x2 = std::max(x1, std::round(right - 0.5));
  if (x2 < 0 || x1 > last) return false;
  x1 = std::max(x1, 0.0);
  x2 = std::min(x2, last);
  blob.x1 = static_cast<std::int16_t>(x1);
  blob.x2 = static_cast<std::int16_t>(x2);
  blob.y1 = 0;
  blob.y2 = static_cast<std::int16_t>(camera.height - 1);
  blob.cx = base::Pixels1::nearest((x1 + x2) / 2);
  blob.cy = base::Pixels1::nearest((camera.height - 1) / 2.0);
  return true;
}

sensor::Rgb colour_number(std::size_t index, std::size_t count) {
  const double hue = 6.0 * static_cast<double>(index) / static_cast<double>(std::max<std::size_t>(count, 1));
  const auto channel = [&](double at) {  // hue circle of full saturation, 0..6
    double distance = std::abs(hue - at);
    distance = std::min(distance, 6 - distance);
    const double share = std::clamp(2 - distance, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(40 + 180 * share));
  };
  return {channel(0), channel(2), channel(4)};
}

}  // namespace fencepost::host
