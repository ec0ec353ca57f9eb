#include "host/video/colours_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/scene/rgb.hpp"

namespace fencepost::host {

std::string colours_file(std::span<const NamedColour> all) {
  std::string signatures;
  std::string colours;
  const auto pair = [](base::Ratio4 low, base::Ratio4 high) {
    return fmt::format("[{:.4f}, {:.4f}]", low.to_double(), high.to_double());
  };
  for (const auto& [one, name] : all) {
    const segmenter::ColourRange& range = one.range;
    const char* const comma = signatures.empty() ? "" : ",";
    signatures += fmt::format("{}\n    {{\"id\": {}, \"name\": {}, \"rgb\": \"{}\"}}", comma, range.signature,
                              nlohmann::json(name).dump(), rgb_text(one.rgb));
    colours += fmt::format("{}\n    {{\"signature\": {}, \"red\": {}, \"green\": {}, \"brightness\": [{}, {}]}}", comma,
                           range.signature, pair(range.red_min, range.red_max), pair(range.green_min, range.green_max),
                           range.brightness_min, range.brightness_max);
  }
  return fmt::format("{{\n  \"signatures\": [{}],\n  \"colours\": [{}]\n}}\n", signatures, colours);
}

bool is_patchy(const TrainedColour& colour) {
  constexpr double kFound = 0.8;  // of a box: less, and its edges or its light are not the thing's
  return colour.found < kFound;
}

bool is_elsewhere(const TrainedColour& colour, int width, int height) {
  constexpr double kElsewhere = 0.0005;  // of a picture: as much as a blob needs
  return static_cast<double>(colour.elsewhere) > kElsewhere * width * height;
}

}  // namespace fencepost::host
